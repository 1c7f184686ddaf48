// Provides apparent_radiance() [W m-2 sr-1]: a surface's radiance through an air path that thins out with height and
// glows, as a sum of exponentials. Twin: sensorsim.environment.air_path.
#include "common/quantities.glsl"
#include "generated/air_block.glsl"

const float SMALL_ARGUMENT = 1e-2;  // below it the quotients come from their series

// (1 - exp(-x)) / x: mean density of air along a path that rises by x scale heights
vec4 mean_decay(vec4 x) {
    vec4 series = 1.0 + x * (x / 6.0 - 0.5);
    bvec4 small = lessThan(abs(x), vec4(SMALL_ARGUMENT));
    vec4 safe = mix(x, vec4(1.0), vec4(small));
    return mix((1.0 - exp(-safe)) / safe, series, vec4(small));
}

// Weight of the target's source against the sensor's: (1 - t) / d - t with t = exp(-d)
vec4 source_lag(vec4 depth, vec4 part) {
    vec4 small = vec4(lessThan(depth, vec4(SMALL_ARGUMENT)));
    vec4 safe = mix(depth, vec4(1.0), small);
    return mix((1.0 - part) / safe - part, depth * (0.5 - depth / 3.0), small);
}

// [HenyeyGreenstein1941] relative to a right angle; sunlight that goes on forward reaches who looks into the sun
Ratio phase(Ratio sun_cosine) {
    float whole = 1.0 + air.asymmetry * air.asymmetry;
    float part = whole / (whole - 2.0 * air.asymmetry * sun_cosine);
    return part * sqrt(part);
}

// Extinction of each term along a path that rises by so much, mean over it [m-1]; smooth enough for vertices
vec4 mean_extinction(Metre rise) {
    return air.extinction * mean_decay(air.inverse_scale_height * rise);
}

// rise [m]: of the surface above the camera; view: from the camera to the surface
Radiance apparent_radiance(Radiance source, Metre range, Metre rise, vec4 extinction, Direction view) {
    vec4 depth = extinction * range;
    vec4 part = exp(-depth);
    vec4 near = air.source + air.beam_source * phase(dot(view, air.sun_direction));
    vec4 seen = near + part * (vec4(source) - near) + source_lag(depth, part) * air.source_slope * rise;
    return dot(air.weight, seen);
}
