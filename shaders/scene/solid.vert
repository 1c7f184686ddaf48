#version 330 core
// Provides: a moving thing's nature to its fragments, unchanged across each triangle, and the position for the range.
#include "generated/view_frame_block.glsl"
#include "radiance/path.glsl"

in vec3 position;  // [m] east, north, up of the scene's origin
in vec3 normal;
in vec4 sky_quarters;
in vec3 nature;
in int surface;

out vec3 from_camera;  // [m]
out vec4 extinction;
flat out vec3 face_normal;
flat out vec4 quarters;
flat out vec3 face;  // temperature [K], emissivity, low-light reflectance
flat out int surface_id;

void main() {
    face_normal = normal;
    quarters = sky_quarters;
    face = nature;
    surface_id = surface;
    from_camera = position - view_frame.camera_position;
    extinction = mean_extinction(from_camera.z);
    gl_Position = view_frame.clip_from_camera * vec4(from_camera, 1.0);
}
