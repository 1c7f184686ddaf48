// Provides emitted_radiance() [W m-2 sr-1]: what a surface emits and reflects in an emissive band.
// Kirchhoff: reflectance = 1 - emissivity, [Report1978] section 3.2. Matt surfaces reflect sky and ground by their view
// factors, glossy ones what lies in the mirror direction.
#include "common/quantities.glsl"
#include "generated/illumination_block.glsl"
#include "generated/band_radiance.glsl"
#include "radiance/mirror.glsl"

// view: from the sensor to the surface; gloss: kind or -1, emissivity along the normal
Radiance emitted_radiance(Kelvin temperature, Ratio emissivity, Direction normal, Direction view, vec2 gloss) {
    Radiance surroundings;
    if (gloss.x < 0.0) {
        Ratio sky_view_factor = 0.5 * (1.0 + normal.z);
        surroundings = mix(illumination.ground_radiance, illumination.sky_radiance, sky_view_factor);
    } else {
        int kind = int(gloss.x);
        emissivity = gloss.y * (1.0 - rise_of(kind, -dot(view, normal)));
        surroundings = mirrored_radiance(kind, reflect(view, normal));
    }
    return mix(surroundings, band_radiance(temperature), emissivity);
}
