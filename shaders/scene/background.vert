#version 330 core
// Provides: a triangle that covers the picture, at the far plane; picture coordinates from 0 to 1; the extinction of the
// air down to the ground plane [m-1], the same for every pixel.
#include "generated/view_frame_block.glsl"
#include "radiance/path.glsl"

out vec2 picture_position;
flat out vec4 extinction;

void main() {
    vec2 corner = vec2(float((gl_VertexID & 1) << 2) - 1.0, float((gl_VertexID & 2) << 1) - 1.0);
    picture_position = 0.5 * (corner + 1.0);
    extinction = mean_extinction(-max(view_frame.camera_position.z, 0.0));
    gl_Position = vec4(corner, 1.0, 1.0);
}
