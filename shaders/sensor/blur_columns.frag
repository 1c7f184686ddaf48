#version 330 core
// Provides: band radiance on the focal plane [W m-2 sr-1], the products of the row pass blurred along the columns and
// summed; there may be several rows of them to one of the sensor. Twin: sensorsim.sensor.focal_plane.
#include "common/quantities.glsl"

uniform sampler2D product_picture;
uniform sampler2D kernel_table;

out float focal_plane;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    int reach = textureSize(kernel_table, 0).x / 2;
    int last = textureSize(product_picture, 0).y - 1;
    int centre = ROWS_PER_ELEMENT * place.y + ROWS_PER_ELEMENT / 2;
    focal_plane = 0.0;
    for (int tap = -reach; tap <= reach; ++tap) {
        vec4 product = texelFetch(product_picture, ivec2(place.x, clamp(centre + tap, 0, last)), 0);
        focal_plane += dot(product, texelFetch(kernel_table, ivec2(tap + reach, 1), 0));
    }
}
