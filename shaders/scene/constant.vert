#version 330 core
// Provides: triangles where the camera sees them, and nothing else.
#include "generated/view_frame_block.glsl"

in vec3 position;  // [m] east, north, up of the scene's origin

void main() {
    gl_Position = view_frame.clip_from_camera * vec4(position - view_frame.camera_position, 1.0);
}
