#version 330 core
// Provides: band radiance at the sensor [W m-2 sr-1] of a surface whose own is known.
// MIRRORS 1: surfaces with a gloss in a thermal band, 0: matt ones.
#include "common/quantities.glsl"
#include "radiance/path.glsl"
#include "radiance/emitted.glsl"

in vec3 from_camera;
in vec4 extinction;
flat in vec2 settled;  // temperature [K], band radiance
#if MIRRORS
flat in vec3 normal;
flat in vec2 gloss;
#endif

out float radiance;

void main() {
    Metre range = length(from_camera);
    Direction view = from_camera / range;
    Radiance source = settled.y;
#if MIRRORS
    source = emitted_radiance(settled.x, gloss.y, normal, view, gloss);
#endif
    radiance = apparent_radiance(source, range, from_camera.z, extinction, view);
}
