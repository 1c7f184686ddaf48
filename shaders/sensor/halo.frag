#version 330 core
// Provides: the halo of lights beyond saturation [W m-2 sr-1]: their excess spread over a disc. Twin:
// sensorsim.sensor.spill.
#include "common/quantities.glsl"
#include "generated/detection_block.glsl"

uniform sampler2D block_picture;

out float halo;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    ivec2 size = textureSize(block_picture, 0);
    int reach = int(detection.halo_radius);
    float count = 0.0;
    halo = 0.0;
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            if (float(x * x + y * y) > detection.halo_radius * detection.halo_radius) continue;
            ivec2 other = place + ivec2(x, y);
            count += 1.0;
            if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, size))) continue;
            halo += texelFetch(block_picture, other, 0).g;
        }
    }
    halo *= detection.halo_share / count;
}
