#version 330 core
// Provides: a triangle that covers the picture, at the far plane; picture coordinates from 0 to 1.
out vec2 picture_position;

void main() {
    vec2 corner = vec2(float((gl_VertexID & 1) << 2) - 1.0, float((gl_VertexID & 2) << 1) - 1.0);
    picture_position = 0.5 * (corner + 1.0);
    gl_Position = vec4(corner, 1.0, 1.0);
}
