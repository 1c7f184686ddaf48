#version 330 core
// Provides: band radiance at the sensor [W m-2 sr-1], surface temperature [K], range [m] and surface id of a surface.
// EMISSIVE 1: thermal bands, 0: reflective bands. By the effects that a frame calls for, 1 or 0: MIRRORED surroundings
// in thermal bands, SUN in reflective bands, PATH through the air.
#include "radiance/path.glsl"
#include "radiance/emitted.glsl"
#include "radiance/reflected.glsl"

in vec3 from_camera;
flat in vec4 record[4];
flat in vec4 last_record;
flat in int surface_id;
flat in float temperature;

layout(location = 0) out vec4 quantities;  // band radiance, surface temperature, range, spare
layout(location = 1) out int id;

void main() {
    Direction normal = record[0].xyz;
    Metre range = length(from_camera);
#if EMISSIVE && MIRRORED
    Radiance source = emitted_radiance(temperature, record[1].w, normal);
#elif EMISSIVE
    Radiance source = own_radiance(temperature, record[1].w);
#elif SUN
    Radiance source = reflected_radiance(last_record.x, normal, record[3]);
#else
    Radiance source = skylit_radiance(last_record.x, normal, record[3]);
#endif
#if PATH
    source = apparent_radiance(source, range);
#endif
    quantities = vec4(source, temperature, range, 0.0);
    id = surface_id;
}
