// Provides with_sun() [K]: what the direct sun of the last hours adds, each lobe as far as the surface saw it, and the
// temperature that this is. Twins: sensorsim.tables.shade, sensorsim.tables.straighten. Layout of the table, RGBA:
//   row 0:              number of lobes, 0 for tables without any, wind's direction east and north; nothing; nothing;
//                       direction xyz of each
//   row 1 + wall type:  level [K], own part, radiation, free film; leeward film, windward's more, gain, gain by |up|;
//                       gain by east, north, up; weight of each lobe, powers 0 and 1 of the reflectance [K]
#include "common/quantities.glsl"
#include "radiance/loss.glsl"

const int HEAD = 3;

uniform sampler2D lobe_table;

Ratio lobe_visibility(int lobe) {
    return 1.0;
}

Kelvin with_sun(Kelvin straight, int wall_type, Direction normal, Ratio reflectance) {
    vec4 alike = texelFetch(lobe_table, ivec2(0, 0), 0);
    vec4 first = texelFetch(lobe_table, ivec2(0, 1 + wall_type), 0);
    vec4 second = texelFetch(lobe_table, ivec2(1, 1 + wall_type), 0);
    vec3 sideways = texelFetch(lobe_table, ivec2(2, 1 + wall_type), 0).xyz;
    Kelvin sunlit = 0.0;
    for (int lobe = 0; lobe < int(alike.x); ++lobe) {
        Direction sun = texelFetch(lobe_table, ivec2(HEAD + lobe, 0), 0).xyz;
        vec2 weight = texelFetch(lobe_table, ivec2(HEAD + lobe, 1 + wall_type), 0).rg;
        sunlit += lobe_visibility(lobe) * max(dot(normal, sun), 0.0) * (weight.x + weight.y * reflectance);
    }
    straight += sunlit * (second.z + second.w * abs(normal.z) + dot(sideways, normal));
    return bend_back(straight, first.x, vec4(first.yz, second.xy), first.w, alike.yz, normal);
}
