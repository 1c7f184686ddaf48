#version 330 core
// Provides: from means along the rows, those along the columns too. BASE 0: slope and offset of the base as a line in the
// picture around each element; BASE 1: the picture [W m-2 sr-1] with `detail` times what differs from its base.
// Twin: sensorsim.sensor.detail.
#include "common/quantities.glsl"
#include "generated/display_block.glsl"
#include "generated/edge.glsl"

uniform sampler2D means_picture;

#if BASE
uniform sampler2D radiance_picture;
out float enhanced;
#else
out vec2 line;
#endif

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    int last = textureSize(means_picture, 0).y - 1;
    vec2 means = vec2(0.0);
    for (int tap = -REACH; tap <= REACH; ++tap) {
        means += texelFetch(means_picture, ivec2(place.x, clamp(place.y + tap, 0, last)), 0).rg;
    }
    means /= float(2 * REACH + 1);
#if BASE
    Radiance signal = texelFetch(radiance_picture, place, 0).r;
    float share = (signal - display.level) / display.span;
    float base = means.x * share + means.y;
    enhanced = signal + display.span * (display.detail - 1.0) * (share - base);
#else
    float variance = max(means.y - means.x * means.x, 0.0);
    line.x = variance / (variance + EDGE * EDGE);
    line.y = means.x * (1.0 - line.x);
#endif
}
