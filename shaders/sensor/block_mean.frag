#version 330 core
// Provides: means of blocks of a picture: of light [W m-2 sr-1], and of what lies above the detector's full signal.
// BLOCK_WIDTH, BLOCK_HEIGHT: size of a block. Twin: sensorsim.sensor.spill.
#include "common/quantities.glsl"
#include "generated/detection_block.glsl"

uniform sampler2D focal_plane;

out vec2 means;  // light, excess

void main() {
    ivec2 size = textureSize(focal_plane, 0);
    ivec2 start = ivec2(gl_FragCoord.xy) * ivec2(BLOCK_WIDTH, BLOCK_HEIGHT);
    ivec2 end = min(start + ivec2(BLOCK_WIDTH, BLOCK_HEIGHT), size);
    means = vec2(0.0);
    for (int y = start.y; y < end.y; ++y) {
        for (int x = start.x; x < end.x; ++x) {
            Radiance light = texelFetch(focal_plane, ivec2(x, y), 0).r;
            means += vec2(light, max(light - detection.full, 0.0));
        }
    }
    ivec2 extent = end - start;
    means /= float(extent.x * extent.y);
}
