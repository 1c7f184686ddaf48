// Provides rise_of() and mirrored_radiance() [W m-2 sr-1] of the kinds of gloss, rows of two tables.
// Twin: sensorsim.render.mirror.
#include "common/quantities.glsl"
#include "generated/mirror_size.glsl"

uniform sampler2D rise_table;    // row: kind; column: cosine from the normal, 0 to 1
uniform sampler2D mirror_table;  // row: kind; column: upward component of the mirror direction, -1 to 1

float between(sampler2D table, int row, float position, int entries) {
    float place = clamp(position, 0.0, 1.0) * float(entries - 1);
    int index = min(int(place), entries - 2);
    float low = texelFetch(table, ivec2(index, row), 0).r;
    float high = texelFetch(table, ivec2(index + 1, row), 0).r;
    return mix(low, high, place - float(index));
}

// Of the reflectance from that along the normal towards 1
Ratio rise_of(int kind, Ratio cosine) {
    return between(rise_table, kind, cosine, ANGLE_ENTRIES);
}

Radiance mirrored_radiance(int kind, Direction outward) {
    return between(mirror_table, kind, 0.5 + 0.5 * outward.z, MIRROR_ENTRIES);
}
