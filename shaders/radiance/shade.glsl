// Provides surface_temperature() [K]: coefficients of three standard orientations interpolated, polynomial evaluated,
// whose last power may begin at a knot, the sun's lobes added where the tables have any. [Report1978] section 3.6.2.
// Twin: sensorsim.tables.shade.
#include "common/quantities.glsl"
#include "generated/coefficients.glsl"
#include "radiance/lobes.glsl"

Kelvin surface_temperature(int wall_type, ivec3 corner, vec3 weight, Ratio reflectance, Direction normal) {
    Kelvin value = 0.0, knotted = 0.0;
    for (int group = COEFFICIENT_GROUPS - 1; group >= 0; --group) {
        vec4 power = weight.x * coefficient_group(wall_type, corner.x, group)
                   + weight.y * coefficient_group(wall_type, corner.y, group)
                   + weight.z * coefficient_group(wall_type, corner.z, group);
        int last = KNOTTED - 4 * group;
        if (last >= 0 && last < 4) {
            knotted = power[last];
            power[last] = 0.0;
        }
        value = (((value * reflectance + power.w) * reflectance + power.z) * reflectance + power.y) * reflectance
              + power.x;
    }
    for (int power = 0; power < KNOTTED; ++power) knotted *= max(reflectance - KNOT, 0.0);
    return with_sun(value + knotted, wall_type, normal, reflectance);
}
