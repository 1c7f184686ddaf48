// Provides emitted_radiance() [W m-2 sr-1]: what a surface emits and reflects in an emissive band; without gloss it is
// matt_radiance(), without any reflection own_radiance().
// Kirchhoff: reflectance = 1 - emissivity, [Report1978] section 3.2. Matt surfaces reflect sky and ground by their view
// factors, glossy ones what lies in the mirror direction.
#include "common/quantities.glsl"
#include "generated/illumination_block.glsl"
#include "generated/band_radiance.glsl"
#include "radiance/mirror.glsl"

Radiance own_radiance(Kelvin temperature, Ratio emissivity) {
    return emissivity * band_radiance(temperature);
}

Radiance matt_radiance(Kelvin temperature, Ratio emissivity, Direction normal) {
    Ratio sky_view_factor = 0.5 * (1.0 + normal.z);
    Radiance surroundings = mix(illumination.ground_radiance, illumination.sky_radiance, sky_view_factor);
    return mix(surroundings, band_radiance(temperature), emissivity);
}

// view: from the sensor to the surface; gloss: kind or -1, emissivity along the normal
Radiance emitted_radiance(Kelvin temperature, Ratio emissivity, Direction normal, Direction view, vec2 gloss) {
    if (gloss.x < 0.0) return matt_radiance(temperature, emissivity, normal);
    int kind = int(gloss.x);
    Ratio directional = gloss.y * (1.0 - rise_of(kind, -dot(view, normal)));
    return mix(mirrored_radiance(kind, reflect(view, normal)), band_radiance(temperature), directional);
}
