// Provides surface_temperature() [K]: coefficients of three standard orientations interpolated, polynomial evaluated,
// the sun's lobes added where the tables have any. [Report1978] section 3.6.2. Twin: sensorsim.tables.shade.
#include "common/quantities.glsl"
#include "generated/coefficients.glsl"
#include "radiance/lobes.glsl"

Kelvin surface_temperature(int wall_type, ivec3 corner, vec3 weight, Ratio reflectance, Direction normal) {
    Kelvin value = 0.0;
    for (int group = COEFFICIENT_GROUPS - 1; group >= 0; --group) {
        vec4 power = weight.x * coefficient_group(wall_type, corner.x, group)
                   + weight.y * coefficient_group(wall_type, corner.y, group)
                   + weight.z * coefficient_group(wall_type, corner.z, group);
        value = (((value * reflectance + power.w) * reflectance + power.z) * reflectance + power.y) * reflectance
              + power.x;
    }
#if LOBES
    return with_sun(value, wall_type, normal, reflectance);
#else
    return value;
#endif
}
