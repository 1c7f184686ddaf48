#version 330 core
// Provides: corners of the viewer's panels, from window pixels (right and down of the upper left corner) to clip space.
#include "generated/panel_block.glsl"

in vec2 place;
in vec2 texture_place;
in vec4 tint;

out vec2 seen_place;
out vec4 seen_tint;

void main() {
    seen_place = texture_place;
    seen_tint = tint;
    gl_Position = vec4(place * panel.scale.xy + panel.scale.zw, 0.0, 1.0);
}
