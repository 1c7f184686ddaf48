#version 330 core
// Provides: light as a detector with a memory holds it [W m-2 sr-1]: a bolometer that warms slowly, a tube that keeps a
// share of the last picture. Twin: sensorsim.sensor.memory.
#include "common/quantities.glsl"
#include "generated/detection_block.glsl"

uniform sampler2D focal_plane;
uniform sampler2D last_picture;

out float remembered;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    Radiance last = texelFetch(last_picture, place, 0).r;
    remembered = last + detection.renewed * (texelFetch(focal_plane, place, 0).r - last);
}
