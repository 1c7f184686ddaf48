#version 330 core
// Provides: band radiance where no surface is: the sky by its elevation, and below the horizon the infinite ground
// plane of [Report1978] section 3.1.3 through its air path.
// EMISSIVE 1: thermal bands, 0: reflective bands, whose sky glows around the sun [ISO15469].
// HORIZON 1: of pixels that all look above it, 2: below it, 0: of any.
// MARKED 1: radiance alone, its sign set: no surface is seen here.
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

#if MARKED
out float radiance;
#else
layout(location = 0) out vec4 quantities;
layout(location = 1) out int id;
#endif

Radiance sky(Direction view) {
#if EMISSIVE
    return sky_radiance(view.z);
#else
    return sky_radiance(view.z) + sky_gradation(view.z) * sky_indicatrix(dot(view, illumination.sun_direction));
#endif
}

Radiance background_radiance(Direction view) {
#if HORIZON == 1
    return sky(view);
#else
#if HORIZON == 0
    if (view.z >= 0.0) return sky(view);
#endif
    Metre height = max(view_frame.camera_position.z, 0.0);
    Metre range = min(height / -view.z, FARTHEST);
    return apparent_radiance(illumination.ground_radiance, range, -height, extinction, view);
#endif
}

void main() {
    vec3 view = view_frame.view_corner
              + picture_position.x * view_frame.view_right + picture_position.y * view_frame.view_up;
#if MARKED
    radiance = -background_radiance(normalize(view));
#else
    quantities = vec4(background_radiance(normalize(view)), 0.0, 0.0, 0.0);
    id = -1;
#endif
}
