#version 330 core
// Provides: the level to which a channel's capacitor has settled [W m-2 sr-1] at each block of a row that is swept again
// and again, from left to right. Twin: sensorsim.sensor.spill.
#include "common/quantities.glsl"
#include "generated/detection_block.glsl"

uniform sampler2D block_picture;

out float baseline;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    int count = textureSize(block_picture, 0).x;
    float weight = 1.0, total = 0.0;
    baseline = 0.0;
    for (int back = 0; back < count; ++back) {
        int column = (place.x - back + count) % count;
        baseline += weight * texelFetch(block_picture, ivec2(column, place.y), 0).r;
        total += weight;
        weight *= detection.kept;
    }
    baseline /= total;
}
