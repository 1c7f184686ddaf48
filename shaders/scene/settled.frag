#version 330 core
// Provides: temperature [K] and band radiance [W m-2 sr-1] of whole surfaces at a moment, a texel each: what does not
// vary within a surface is computed once. Of surfaces with a gloss only the temperature holds: what they mirror goes
// with the view. EMISSIVE 1: thermal bands, 0: reflective bands; LOBES 1: tables with lobes of the sun.
#include "radiance/shade.glsl"
#include "radiance/emitted.glsl"
#include "radiance/reflected.glsl"
#include "scene/surface_record.glsl"

out vec2 settled;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    int surface = place.y * SURFACES_PER_ROW + place.x;
    vec4 record[4];
    for (int texel = 0; texel < 4; ++texel) record[texel] = surface_texel(surface, texel);
    vec4 last_record = surface_texel(surface, 4);
    Direction normal = record[0].xyz;
    Kelvin temperature = surface_temperature(
        int(record[0].w), ivec3(record[1].xyz), record[2].xyz, record[2].w, normal) + last_record.z;
#if EMISSIVE
    settled = vec2(temperature, emitted_radiance(temperature, record[1].w, normal, normal, vec2(-1.0, 0.0)));
#else
    settled = vec2(temperature, reflected_radiance(last_record.x, normal, record[3]));
#endif
}
