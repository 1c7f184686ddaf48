#version 330 core
// Provides: triangles where the camera sees them, each with the number of its surface plus one.
#include "generated/view_frame_block.glsl"

in vec3 position;  // [m] east, north, up of the scene's origin
in int surface;

flat out float place;

void main() {
    place = float(surface + 1);
    gl_Position = view_frame.clip_from_camera * vec4(position - view_frame.camera_position, 1.0);
}
