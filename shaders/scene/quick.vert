#version 330 core
// Provides: what the moment has made of the surface, unchanged across it, and the position for the range.
// EMISSIVE 1: thermal bands, 0: reflective bands. MIRRORS 1: surfaces with a gloss, 0: matt ones.
#include "generated/view_frame_block.glsl"
#include "radiance/path.glsl"
#include "scene/surface_record.glsl"

uniform sampler2D settled_table;

in vec3 position;  // [m] east, north, up of the scene's origin
in int surface;

out vec3 from_camera;  // [m]
out vec4 extinction;   // [m-1]
flat out vec2 settled;
#if MIRRORS
flat out vec3 normal;
flat out vec4 gloss;  // kind, emissivity and a facet's reflectance along the normal, reflectance in 0.8-1.1 um
#if !EMISSIVE
flat out vec4 quarters;
#endif
#endif

void main() {
    settled = texelFetch(settled_table, ivec2(surface % SURFACES_PER_ROW, surface / SURFACES_PER_ROW), 0).rg;
#if MIRRORS
    normal = surface_texel(surface, 0).xyz;
    gloss = vec4(surface_texel(surface, 5).xyz, surface_texel(surface, 4).x);
#if !EMISSIVE
    quarters = surface_texel(surface, 3);
#endif
#endif
    from_camera = position - view_frame.camera_position;
    extinction = mean_extinction(from_camera.z);
    gl_Position = view_frame.clip_from_camera * vec4(from_camera, 1.0);
}
