#version 330 core
// Provides: band radiance at the sensor [W m-2 sr-1], surface temperature [K], range [m] and id of a moving thing, matt
// and flat, in any band: what it sends is told with its triangles.
#include "radiance/path.glsl"

in vec3 from_camera;
in vec4 extinction;
flat in vec2 face;
flat in int surface_id;

layout(location = 0) out vec4 quantities;  // band radiance, surface temperature, range, spare
layout(location = 1) out int id;

void main() {
    Metre range = length(from_camera);
    Direction view = from_camera / range;
    quantities = vec4(apparent_radiance(face.x, range, from_camera.z, extinction, view), face.y, range, 0.0);
    id = surface_id;
}
