#version 330 core
// Provides: one colour everywhere: the least that drawing triangles can cost.
out vec4 colour;

void main() {
    colour = vec4(0.25, 0.5, 0.75, 1.0);
}
