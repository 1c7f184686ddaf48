// Provides with_sun() [K]: what the direct sun of the last hours adds, each lobe as far as the surface saw it.
// Twins: sensorsim.tables.shade, sensorsim.tables.straighten. Layout of the table, RGBA:
//   row 0:              number of lobes, 0 for tables without any; nothing; direction xyz of each
//   row 1 + wall type:  level [K], bend [K-1], gain, gain by |up|; gain by east, north, up;
//                       weight of each, powers 0 and 1 of the reflectance [K]
#include "common/quantities.glsl"

uniform sampler2D lobe_table;

Ratio lobe_visibility(int lobe) {
    return 1.0;
}

Kelvin with_sun(Kelvin straight, int wall_type, Direction normal, Ratio reflectance) {
    int count = int(texelFetch(lobe_table, ivec2(0, 0), 0).r);
    vec4 scale = texelFetch(lobe_table, ivec2(0, 1 + wall_type), 0);
    vec3 sideways = texelFetch(lobe_table, ivec2(1, 1 + wall_type), 0).xyz;
    Kelvin sunlit = 0.0;
    for (int lobe = 0; lobe < count; ++lobe) {
        Direction sun = texelFetch(lobe_table, ivec2(2 + lobe, 0), 0).xyz;
        vec2 weight = texelFetch(lobe_table, ivec2(2 + lobe, 1 + wall_type), 0).rg;
        sunlit += lobe_visibility(lobe) * max(dot(normal, sun), 0.0) * (weight.x + weight.y * reflectance);
    }
    straight += sunlit * (scale.z + scale.w * abs(normal.z) + dot(sideways, normal));
    return scale.x + 2.0 * straight / (1.0 + sqrt(max(1.0 + 4.0 * scale.y * straight, 0.0)));
}
