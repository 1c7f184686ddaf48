// Provides glossy_radiance() [W m-2 sr-1]: what a surface of facets that mirror sends on in a reflective band: sky and
// ground along the mirror direction, the glint of the sun or moon, and what lies below the facets scatters.
// Energy: of a direction's light it reflects R + (1 - R) rise, R its reflectance along the normal, rise that of the
// facets; the scattered part, (R - facet) (1 - rise) (1 - rise') / mean(1 - rise), is what is left, the same both ways.
// Twins: tests/gloss_twin.py, sensorsim.materials.facets. Rows of rise_table, k kinds: 0 rise of the surface, last its
// mean left for scattering; k share of facets seen, last the variance of slopes; 2 k rise of one facet. Rows of
// mirror_table: 0 sky and ground, k the glow's gradation, both by the upward component; 2 k by the angle from the sun.
#include "common/quantities.glsl"
#include "generated/constants.glsl"
#include "generated/illumination_block.glsl"
#include "radiance/mirror.glsl"
#include "radiance/reflected.glsl"

const float LEAST_COSINE = 1e-4;

float last_of(int row) {
    return texelFetch(rise_table, ivec2(ANGLE_ENTRIES, row), 0).r;
}

Radiance mirrored_sky(int kind, Direction outward) {
    Radiance glow = mirrored_radiance(GLOSS_KINDS + kind, outward);
    Ratio leaning = between(
        mirror_table, 2 * GLOSS_KINDS + kind, 0.5 + 0.5 * dot(outward, illumination.sun_direction), MIRROR_ENTRIES);
    return mirrored_radiance(kind, outward) + glow * leaning;
}

// [CookTorrance1982] with slopes of [BeckmannSpizzichino1963]. The sun's disc widens them so that a flat mirror shows
// the middle of its image as bright as the disc: in the plane of the light, and by 1 / cosine more across it. At angles
// as flat as the disc itself that is too wide, and so no glint is brighter than the disc.
Radiance glint(int kind, Ratio facet, Direction normal, Direction to_eye, Ratio sun, Ratio eye) {
    Direction half_way = normalize(illumination.sun_direction + to_eye);
    Ratio upright = dot(half_way, normal), incidence = dot(half_way, to_eye);
    vec3 slope = half_way / upright - normal;
    vec3 along = illumination.sun_direction - to_eye;
    along -= dot(along, normal) * normal;
    Ratio in_plane = dot(slope, along) / max(length(along), 1e-6);
    float variance = last_of(GLOSS_KINDS + kind);
    vec2 widened = vec2(variance) + DISC_VARIANCE / vec2(1.0, incidence * incidence);
    float across = max(dot(slope, slope) - in_plane * in_plane, 0.0);
    float density = exp(-in_plane * in_plane / widened.x - across / widened.y)
                  / (PI * sqrt(widened.x * widened.y) * upright * upright * upright * upright);
    Ratio mirrored = mix(facet, 1.0, rise_of(2 * GLOSS_KINDS + kind, incidence));
    Ratio seen = rise_of(GLOSS_KINDS + kind, sun) * rise_of(GLOSS_KINDS + kind, eye);
    return illumination.beam * mirrored * min(density * seen / (4.0 * eye), 0.25 / (PI * DISC_VARIANCE));
}

// gloss: kind, reflectance of a facet along its normal; view: from the sensor to the surface
Radiance glossy_radiance(
    vec2 gloss, Ratio reflectance, Direction normal, Direction view, vec4 quadrant_view_factor) {
    int kind = int(gloss.x);
    Ratio eye = max(-dot(view, normal), LEAST_COSINE), sun = dot(normal, illumination.sun_direction);
    Ratio rise = rise_of(kind, eye);
    Irradiance scattered = diffuse_irradiance(normal, quadrant_view_factor);
    Radiance seen = mix(gloss.y, 1.0, rise) * mirrored_sky(kind, reflect(view, normal));
    if (sun > 0.0 && illumination.beam > 0.0) {
        scattered += illumination.beam * sun * (1.0 - rise_of(kind, sun)) / last_of(kind);
        seen += glint(kind, gloss.y, normal, -view, sun, eye);
    }
    return seen + (reflectance - gloss.y) * (1.0 - rise) * scattered / PI;
}
