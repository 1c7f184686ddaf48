#version 330 core
// Provides: the surface's record and temperature [K] to its fragments, unchanged across the surface, and the position
// for the range. LOBES 1: tables with lobes of the sun, 0: without. TEMPERATURE 0: it stays 0.
#include "generated/view_frame_block.glsl"
#include "scene/surface_record.glsl"
#include "radiance/shade.glsl"

in vec3 position;  // [m] east, north, up of the scene's origin
in int surface;

out vec3 from_camera;  // [m]
flat out vec4 record[4];
flat out vec4 last_record;
flat out int surface_id;
flat out float temperature;  // [K]

void main() {
    for (int texel = 0; texel < 4; ++texel) record[texel] = surface_texel(surface, texel);
    last_record = surface_texel(surface, 4);
    surface_id = surface;
    temperature = 0.0;
#if TEMPERATURE
    temperature = surface_temperature(
        int(record[0].w), ivec3(record[1].xyz), record[2].xyz, record[2].w, record[0].xyz) + last_record.z;
#endif
    from_camera = position - view_frame.camera_position;
    gl_Position = view_frame.clip_from_camera * vec4(from_camera, 1.0);
}
