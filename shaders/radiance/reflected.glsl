// Provides reflected_radiance() [W m-2 sr-1]: light that a Lambertian surface reflects in a reflective band: direct
// sun, four quarters of the sky, sunlit ground; and diffuse_irradiance() [W m-2], what of it is not the sun's.
// [Report1978] sections 3.3 and 4.3.
#include "common/quantities.glsl"
#include "generated/constants.glsl"
#include "generated/illumination_block.glsl"

Irradiance diffuse_irradiance(Direction normal, vec4 quadrant_view_factor) {
    Irradiance from_sky = 4.0 * dot(illumination.quadrant, quadrant_view_factor);
    return from_sky + PI * illumination.ground_radiance * 0.5 * (1.0 - normal.z);
}

Radiance reflected_radiance(Ratio reflectance, Direction normal, vec4 quadrant_view_factor) {
    Irradiance direct = illumination.beam * max(dot(normal, illumination.sun_direction), 0.0);
    return reflectance * (direct + diffuse_irradiance(normal, quadrant_view_factor)) / PI;
}
