#version 330 core
// Provides: band radiance where no surface is: the sky by its elevation, and below the horizon the infinite ground
// plane of [Report1978] section 3.1.3 through its air path. In reflective bands the sky glows around the sun
// [ISO15469]; in thermal ones the tables of that are zero.
// PATH 1: with the air in between, 0: without.
#include "common/quantities.glsl"
#include "generated/view_frame_block.glsl"
#include "generated/illumination_block.glsl"
#include "generated/sky_radiance.glsl"
#include "generated/sky_gradation.glsl"
#include "generated/sky_indicatrix.glsl"
#include "radiance/path.glsl"

const Metre FARTHEST = 1e9;  // along the horizon; all air is opaque before

in vec2 picture_position;
flat in vec4 extinction;

layout(location = 0) out vec4 quantities;
layout(location = 1) out int id;

Radiance sky(Direction view) {
    return sky_radiance(view.z) + sky_gradation(view.z) * sky_indicatrix(dot(view, illumination.sun_direction));
}

Radiance background_radiance(Direction view) {
    if (view.z >= 0.0) return sky(view);
#if PATH
    Metre height = max(view_frame.camera_position.z, 0.0);
    Metre range = min(height / -view.z, FARTHEST);
    return apparent_radiance(illumination.ground_radiance, range, -height, extinction, view);
#else
    return illumination.ground_radiance;
#endif
}

void main() {
    vec3 view = view_frame.view_corner
              + picture_position.x * view_frame.view_right + picture_position.y * view_frame.view_up;
    quantities = vec4(background_radiance(normalize(view)), 0.0, 0.0, 0.0);
    id = -1;
}
