#version 330 core
// Provides: band radiance at the sensor [W m-2 sr-1] of a surface whose own is known.
// EMISSIVE 1: thermal bands, 0: reflective bands. MIRRORS 1: surfaces with a gloss, 0: matt ones.
#include "common/quantities.glsl"
#include "radiance/path.glsl"
#include "radiance/emitted.glsl"
#include "radiance/glossy.glsl"

in vec3 from_camera;
in vec4 extinction;
flat in vec2 settled;  // temperature [K], band radiance
#if MIRRORS
flat in vec3 normal;
flat in vec4 gloss;
#if !EMISSIVE
flat in vec4 quarters;
#endif
#endif

out float radiance;

void main() {
    Metre range = length(from_camera);
    Direction view = from_camera / range;
    Radiance source = settled.y;
#if MIRRORS && EMISSIVE
    source = emitted_radiance(settled.x, gloss.y, normal, view, gloss.xy);
#elif MIRRORS
    source = glossy_radiance(gloss.xz, gloss.w, normal, view, quarters);
#endif
    radiance = apparent_radiance(source, range, from_camera.z, extinction, view);
}
