#version 330 core
// Provides: band radiance at the sensor [W m-2 sr-1], surface temperature [K], range [m] and id of a moving thing.
// EMISSIVE 1: thermal bands, 0: reflective bands.
#include "radiance/path.glsl"
#include "radiance/emitted.glsl"
#include "radiance/reflected.glsl"

in vec3 from_camera;
in vec4 extinction;
flat in vec3 face_normal;
flat in vec4 quarters;
flat in vec3 face;
flat in int surface_id;

layout(location = 0) out vec4 quantities;  // band radiance, surface temperature, range, spare
layout(location = 1) out int id;

void main() {
    Metre range = length(from_camera);
    Direction view = from_camera / range;
#if EMISSIVE
    Radiance source = emitted_radiance(face.x, face.y, face_normal, view, vec2(-1.0, 0.0));
#else
    Radiance source = reflected_radiance(face.z, face_normal, quarters);
#endif
    quantities = vec4(apparent_radiance(source, range, from_camera.z, extinction, view), face.x, range, 0.0);
    id = surface_id;
}
