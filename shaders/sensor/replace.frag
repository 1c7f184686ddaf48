#version 330 core
// Provides: the report [W m-2 sr-1] with the median of the living neighbours in place of each dead element, of the lower
// of two in the middle; where none around lives it looks farther. REACH: how far. Twin: sensorsim.sensor.dead_elements.
#include "common/quantities.glsl"

uniform sampler2D reported_picture;
uniform sampler2D pattern_table;  // of each element: fixed deviate, gain, 1 where it sees

out float replaced;

bool lives(ivec2 place, ivec2 size) {
    if (any(lessThan(place, ivec2(0))) || any(greaterThanEqual(place, size))) return false;
    return texelFetch(pattern_table, ivec2(place.x, size.y - 1 - place.y), 0).z != 0.0;
}

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy), size = textureSize(reported_picture, 0);
    replaced = texelFetch(reported_picture, place, 0).r;
    if (lives(place, size)) return;
    Radiance living[(2 * REACH + 1) * (2 * REACH + 1)];
    int count = 0;
    for (int reach = 1; reach <= REACH && count == 0; ++reach) {
        for (int y = -reach; y <= reach; ++y) {
            for (int x = -reach; x <= reach; ++x) {
                if (!lives(place + ivec2(x, y), size)) continue;
                living[count++] = texelFetch(reported_picture, place + ivec2(x, y), 0).r;
            }
        }
    }
    for (int one = 0; one < count; ++one) {  // the one that has fewer than half below it, and half not above
        int below = 0, alike = 0;
        for (int other = 0; other < count; ++other) {
            below += int(living[other] < living[one]);
            alike += int(living[other] == living[one]);
        }
        if (below <= (count - 1) / 2 && (count - 1) / 2 < below + alike) replaced = living[one];
    }
}
