// Provides surface_temperature() [K]: coefficients of three standard orientations interpolated, polynomial evaluated.
// [Report1978] section 3.6.2. Twin: sensorsim.tables.shade.
#include "common/quantities.glsl"
#include "generated/coefficients.glsl"

Kelvin surface_temperature(int wall_type, ivec3 corner, vec3 weight, Ratio reflectance) {
    Kelvin value = 0.0;
    for (int group = COEFFICIENT_GROUPS - 1; group >= 0; --group) {
        vec4 power = weight.x * coefficient_group(wall_type, corner.x, group)
                   + weight.y * coefficient_group(wall_type, corner.y, group)
                   + weight.z * coefficient_group(wall_type, corner.z, group);
        value = (((value * reflectance + power.w) * reflectance + power.z) * reflectance + power.y) * reflectance
              + power.x;
    }
    return value;
}
