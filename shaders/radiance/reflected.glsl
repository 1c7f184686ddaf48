// Provides reflected_radiance() [W m-2 sr-1]: light that a Lambertian surface reflects in a reflective band: direct
// sun, four quarters of the sky, sunlit ground; and skylit_radiance(), the same without the sun. [Report1978] sections
// 3.3 and 4.3.
#include "common/quantities.glsl"
#include "generated/constants.glsl"
#include "generated/illumination_block.glsl"

Irradiance sky_irradiance(vec4 quadrant_view_factor) {
    return 4.0 * dot(illumination.quadrant, quadrant_view_factor);
}

Irradiance ground_irradiance(Direction normal) {
    return PI * illumination.ground_radiance * 0.5 * (1.0 - normal.z);
}

Radiance reflected_radiance(Ratio reflectance, Direction normal, vec4 quadrant_view_factor) {
    Irradiance direct = illumination.beam * max(dot(normal, illumination.sun_direction), 0.0);
    return reflectance * (direct + sky_irradiance(quadrant_view_factor) + ground_irradiance(normal)) / PI;
}

Radiance skylit_radiance(Ratio reflectance, Direction normal, vec4 quadrant_view_factor) {
    return reflectance * (sky_irradiance(quadrant_view_factor) + ground_irradiance(normal)) / PI;
}
