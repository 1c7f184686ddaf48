// Provides apparent_radiance() [W m-2 sr-1]: a surface's radiance through an air path. [Report1978] eq. 15.
#include "common/quantities.glsl"
#include "generated/illumination_block.glsl"

Radiance apparent_radiance(Radiance source, Metre range) {
    Ratio path_transmittance = exp(-illumination.attenuation * range);
    return source * path_transmittance + illumination.air_radiance * (1.0 - path_transmittance);
}
