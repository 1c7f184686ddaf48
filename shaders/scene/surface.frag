#version 330 core
// Provides: band radiance at the sensor [W m-2 sr-1], surface temperature [K], range [m] and surface id of a surface.
// EMISSIVE 1: thermal bands, 0: reflective bands. By the effects that a frame calls for: MIRRORED 0: no surroundings, 1:
// reflected by matt surfaces, 2: by glossy ones too, in reflective bands where the light says so; PATH 1: through the
// air, 0: as it leaves.
#include "radiance/path.glsl"
#include "radiance/emitted.glsl"
#include "radiance/glossy.glsl"

in vec3 from_camera;
flat in vec4 record[4];
flat in vec4 last_record;
#if PATH
in vec4 extinction;
#endif
#if MIRRORED == 2
flat in vec4 gloss_record;
#endif
flat in int surface_id;
flat in float temperature;

layout(location = 0) out vec4 quantities;  // band radiance, surface temperature, range, spare
layout(location = 1) out int id;

Radiance leaving(Direction normal, Direction view) {
#if !EMISSIVE
    if (gloss_record.x >= 0.0 && illumination.mirrors > 0.0)
        return glossy_radiance(gloss_record.xz, last_record.x, normal, view, record[3]);
    return reflected_radiance(last_record.x, normal, record[3]);
#elif MIRRORED == 0
    return own_radiance(temperature, record[1].w);
#elif MIRRORED == 1
    return matt_radiance(temperature, record[1].w, normal);
#else
    return emitted_radiance(temperature, record[1].w, normal, view, gloss_record.xy);
#endif
}

void main() {
    Metre range = length(from_camera);
    Direction view = from_camera / range;
    Radiance seen = leaving(record[0].xyz, view);
#if PATH
    seen = apparent_radiance(seen, range, from_camera.z, extinction, view);
#endif
    quantities = vec4(seen, temperature, range, 0.0);
    id = surface_id;
}
