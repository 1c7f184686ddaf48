#version 330 core
// Provides: means along the rows over 2 REACH + 1 columns: of the picture in shares of the window and of its square, or,
// where BASE is 1, of slope and offset of the base. Twin: sensorsim.sensor.detail.
#include "common/quantities.glsl"
#include "generated/display_block.glsl"

#if BASE
uniform sampler2D means_picture;
#else
uniform sampler2D radiance_picture;
#endif

out vec2 means;

vec2 value(int column, int row) {
#if BASE
    return texelFetch(means_picture, ivec2(column, row), 0).rg;
#else
    float share = (texelFetch(radiance_picture, ivec2(column, row), 0).r - display.level) / display.span;
    return vec2(share, share * share);
#endif
}

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
#if BASE
    int last = textureSize(means_picture, 0).x - 1;
#else
    int last = textureSize(radiance_picture, 0).x - 1;
#endif
    means = vec2(0.0);
    for (int tap = -REACH; tap <= REACH; ++tap) means += value(clamp(place.x + tap, 0, last), place.y);
    means /= float(2 * REACH + 1);
}
