#version 330 core
// Provides: band radiance at the sensor [W m-2 sr-1], surface temperature [K], range [m] and surface id of a surface.
// EMISSIVE 1: thermal bands, 0: reflective bands.
#include "radiance/path.glsl"
#include "radiance/emitted.glsl"
#include "radiance/reflected.glsl"

in vec3 from_camera;
in vec4 extinction;
flat in vec4 record[4];
flat in vec4 last_record;
#if EMISSIVE
flat in vec4 gloss_record;
#endif
flat in int surface_id;
flat in float temperature;

layout(location = 0) out vec4 quantities;  // band radiance, surface temperature, range, spare
layout(location = 1) out int id;

void main() {
    Direction normal = record[0].xyz;
    Metre range = length(from_camera);
#if EMISSIVE
    Radiance source = emitted_radiance(temperature, record[1].w, normal, from_camera / range, gloss_record.xy);
#else
    Radiance source = reflected_radiance(last_record.x, normal, record[3]);
#endif
    Radiance seen = apparent_radiance(source, range, from_camera.z, extinction, from_camera / range);
    quantities = vec4(seen, temperature, range, 0.0);
    id = surface_id;
}
