#version 330 core
// Provides: the picture blurred along its rows, one channel for each product of the kernel, columns as the sensor
// places them. Twin: sensorsim.sensor.focal_plane.
#include "common/quantities.glsl"

uniform sampler2D radiance_picture;
uniform sampler2D kernel_table;    // row 0: weights along rows, row 1: along columns; a channel for each product
uniform sampler2D column_table;    // sample of the picture that each column of the sensor looks at

out vec4 products;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    int reach = textureSize(kernel_table, 0).x / 2;
    int last = textureSize(radiance_picture, 0).x - 1;
    int centre = int(texelFetch(column_table, ivec2(place.x, 0), 0).r + 0.5);
    products = vec4(0.0);
    for (int tap = -reach; tap <= reach; ++tap) {
        Radiance sample_radiance = texelFetch(radiance_picture, ivec2(clamp(centre + tap, 0, last), place.y), 0).r;
        products += sample_radiance * texelFetch(kernel_table, ivec2(tap + reach, 0), 0);
    }
}
