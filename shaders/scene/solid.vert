#version 330 core
// Provides: what a moving thing's triangle sends, to its fragments, and the position for the range.
#include "generated/view_frame_block.glsl"
#include "radiance/path.glsl"

in vec3 position;  // [m] east, north, up of the scene's origin
in vec2 nature;    // radiance that leaves it [W m-2 sr-1], temperature [K]
in int surface;

out vec3 from_camera;  // [m]
out vec4 extinction;
flat out vec2 face;
flat out int surface_id;

void main() {
    face = nature;
    surface_id = surface;
    from_camera = position - view_frame.camera_position;
    extinction = mean_extinction(from_camera.z);
    gl_Position = view_frame.clip_from_camera * vec4(from_camera, 1.0);
}
