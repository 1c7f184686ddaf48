// Provides reflected_radiance() [W m-2 sr-1]: light that a Lambertian surface reflects in a reflective band: direct
// sun, four quarters of the sky, sunlit ground. [Report1978] sections 3.3 and 4.3.
#include "common/quantities.glsl"
#include "generated/constants.glsl"
#include "generated/illumination_block.glsl"

Radiance reflected_radiance(Ratio reflectance, Direction normal, vec4 quadrant_view_factor) {
    Irradiance direct = illumination.beam * max(dot(normal, illumination.sun_direction), 0.0);
    Irradiance diffuse = 4.0 * dot(illumination.quadrant, quadrant_view_factor);
    Irradiance from_ground = PI * illumination.ground_radiance * 0.5 * (1.0 - normal.z);
    return reflectance * (direct + diffuse + from_ground) / PI;
}
