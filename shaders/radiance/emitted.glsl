// Provides emitted_radiance() [W m-2 sr-1]: what a grey Lambertian surface emits and reflects in an emissive band, and
// own_radiance() [W m-2 sr-1]: what it emits of that.
// Kirchhoff: reflectance = 1 - emissivity, [Report1978] section 3.2; sky and ground by their view factors.
#include "common/quantities.glsl"
#include "generated/illumination_block.glsl"
#include "generated/band_radiance.glsl"

Radiance own_radiance(Kelvin temperature, Ratio emissivity) {
    return emissivity * band_radiance(temperature);
}

Radiance emitted_radiance(Kelvin temperature, Ratio emissivity, Direction normal) {
    Ratio sky_view_factor = 0.5 * (1.0 + normal.z);
    Radiance surroundings = mix(illumination.ground_radiance, illumination.sky_radiance, sky_view_factor);
    return own_radiance(temperature, emissivity) + (1.0 - emissivity) * surroundings;
}
