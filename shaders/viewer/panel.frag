#version 330 core
// Provides: colour of the viewer's panels, letters and pictures: a texture times a tint.

uniform sampler2D panel_picture;

in vec2 seen_place;
in vec4 seen_tint;

out vec4 colour;

void main() {
    colour = seen_tint * texture(panel_picture, seen_place);
}
