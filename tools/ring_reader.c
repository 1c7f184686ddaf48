/* Reads the newest picture of a ring that sensorsim writes (layout: sensorsim/trainer/ring.py) and prints one line:
 *     frame TIME KIND WIDTHxHEIGHT least greatest mean
 * Build:  cc -O2 -o ring_reader tools/ring_reader.c        Run:  ./ring_reader /dev/shm/NAME
 * Exit status: 0 a picture, 1 none yet or always overwritten, 2 no ring.
 */
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

static uint32_t u32(const volatile unsigned char *at) { return *(const volatile uint32_t *)at; }
static uint64_t u64(const volatile unsigned char *at) { return *(const volatile uint64_t *)at; }

static double pixel(const unsigned char *slot, uint32_t kind, size_t i)
{
    uint16_t counts;
    float value;
    if (kind == 1)
        return slot[32 + i];
    if (kind == 2) {
        memcpy(&counts, slot + 32 + 2 * i, sizeof counts);
        return 0.01 * counts;
    }
    memcpy(&value, slot + 32 + 4 * i, sizeof value);
    return value;
}

static int show(const volatile unsigned char *ring, unsigned char *copy)
{
    static const char *const names[] = {"", "display", "kelvin", "W/m2/sr"};
    uint32_t slots = u32(ring + 12), stride = u32(ring + 16), width = u32(ring + 20), height = u32(ring + 24);
    uint32_t kind = u32(ring + 28);
    for (int attempt = 0; attempt < 3; ++attempt) {
        uint64_t count = u64(ring + 32);
        if (count == 0)
            return 1;
        const volatile unsigned char *slot = ring + 64 + (size_t)((count - 1) % slots) * stride;
        if (u64(slot) != 2 * count)
            continue;
        memcpy(copy, (const unsigned char *)slot, stride);
        if (u64(slot) != 2 * count)
            continue;
        size_t pixels = (size_t)width * height;
        double least = pixel(copy, kind, 0), greatest = least, sum = 0.0, time;
        for (size_t i = 0; i < pixels; ++i) {
            double value = pixel(copy, kind, i);
            least = value < least ? value : least;
            greatest = value > greatest ? value : greatest;
            sum += value;
        }
        memcpy(&time, copy + 16, sizeof time);
        printf("%llu %.6f %s %ux%u %.6g %.6g %.6g\n", (unsigned long long)u64(copy + 8), time, names[kind], width, height,
               least, greatest, sum / pixels);
        return 0;
    }
    return 1;
}

int main(int argc, char **argv)
{
    static const uint32_t bytes[] = {0, 1, 2, 4};
    struct stat about;
    int file = argc == 2 ? open(argv[1], O_RDONLY) : -1;
    if (file < 0 || fstat(file, &about) != 0 || about.st_size < 64) {
        fprintf(stderr, "usage: ring_reader FILE of a running writer\n");
        return 2;
    }
    const unsigned char *ring = mmap(NULL, (size_t)about.st_size, PROT_READ, MAP_SHARED, file, 0);
    if (ring == MAP_FAILED || memcmp(ring, "SSRING01", 8) != 0 || u32(ring + 28) < 1 || u32(ring + 28) > 3) {
        fprintf(stderr, "%s is no ring\n", argv[1]);
        return 2;
    }
    uint64_t slots = u32(ring + 12), stride = u32(ring + 16), pixels = (uint64_t)u32(ring + 20) * u32(ring + 24);
    if (slots < 1 || pixels < 1 || stride < 32 + pixels * bytes[u32(ring + 28)] ||
        64 + slots * stride > (uint64_t)about.st_size) {
        fprintf(stderr, "%s is shorter than its header says\n", argv[1]);
        return 2;
    }
    unsigned char *copy = malloc(stride);
    return copy == NULL ? 2 : show(ring, copy);
}
