#version 330 core
// Provides: what the detector reports, as band radiance [W m-2 sr-1]: noise in three dimensions, fixed pattern,
// elements that do not see, counts. STREAKS 1: less the level that each channel has settled to; HALO 1: with the halo of
// bright lights. Twin: sensorsim.sensor.read_out.
#include "common/quantities.glsl"
#include "common/random.glsl"
#include "common/blocks.glsl"
#include "generated/detection_block.glsl"

uniform sampler2D focal_plane;
uniform sampler2D pattern_table;  // of each element: fixed deviate, gain, 1 where it sees
uniform sampler2D row_table;      // of each row of this frame: deviate
uniform sampler2D line_table;     // of each column of this frame: deviate

#if STREAKS
uniform sampler2D baseline_picture;
#endif
#if HALO
uniform sampler2D halo_picture;
#endif

out float reported;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    int row = textureSize(focal_plane, 0).y - 1 - place.y;  // counted from the top, as the sensor reads
    Radiance light = texelFetch(focal_plane, place, 0).r;
#if STREAKS
    light += detection.level - block_value(baseline_picture, place, vec2(STREAK_BLOCK, 1.0));
#endif
#if HALO
    light += block_value(halo_picture, place, vec2(HALO_BLOCK));
#endif
    vec4 pattern = texelFetch(pattern_table, ivec2(place.x, row), 0);
    float deviate = normal_deviate(uint(place.x), uint(row), detection.frame, detection.seed) + pattern.x
                  + texelFetch(row_table, ivec2(row, 0), 0).r + texelFetch(line_table, ivec2(place.x, 0), 0).r;
    Radiance signal = light + pattern.y * (light - detection.corrected_at)
                    + sqrt(detection.constant + detection.shot * max(light, 0.0)) * deviate;
    float count = clamp(floor(signal * pattern.z / detection.count_step + 0.5), 0.0, detection.highest);
    reported = count * detection.count_step;
}
