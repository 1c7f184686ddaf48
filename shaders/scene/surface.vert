#version 330 core
// Provides: the surface's record and temperature [K] to its fragments, unchanged across the surface, and the position
// for the range. TEMPERATURE 0: it stays 0. PATH 1: with the extinction of the air in between, MIRRORED 2: the gloss.
#include "generated/view_frame_block.glsl"
#include "radiance/path.glsl"
#include "scene/surface_record.glsl"
#include "radiance/shade.glsl"

in vec3 position;  // [m] east, north, up of the scene's origin
in int surface;

out vec3 from_camera;  // [m]
#if PATH
out vec4 extinction;  // [m-1]
#endif
flat out vec4 record[4];
flat out vec4 last_record;
#if MIRRORED == 2
flat out vec4 gloss_record;
#endif
flat out int surface_id;
flat out float temperature;  // [K]

void main() {
    for (int texel = 0; texel < 4; ++texel) record[texel] = surface_texel(surface, texel);
    last_record = surface_texel(surface, 4);
#if MIRRORED == 2
    gloss_record = surface_texel(surface, 5);
#endif
    surface_id = surface;
    temperature = 0.0;
#if TEMPERATURE
    temperature = surface_temperature(
        int(record[0].w), ivec3(record[1].xyz), record[2].xyz, record[2].w, record[0].xyz) + last_record.z;
#endif
    from_camera = position - view_frame.camera_position;
#if PATH
    extinction = mean_extinction(from_camera.z);
#endif
    gl_Position = view_frame.clip_from_camera * vec4(from_camera, 1.0);
}
