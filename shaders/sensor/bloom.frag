#version 330 core
// Provides: light with its wells filled up to the detector's full signal, and in others what spills along the columns
// [W m-2 sr-1]. Columns without any excess are left as they are. Twin: sensorsim.sensor.bloom.
#include "common/quantities.glsl"
#include "generated/detection_block.glsl"

uniform sampler2D focal_plane;
uniform sampler2D block_picture;  // of each column as a whole: g is above zero where one of its wells is full

out float bloomed;

Radiance caught(int column, int from, int to, int step_to) {
    Radiance carried = 0.0, here = 0.0;
    for (int row = from; row != to + step_to; row += step_to) {
        Radiance light = texelFetch(focal_plane, ivec2(column, row), 0).r;
        here = min(carried, max(detection.full - light, 0.0));
        carried += 0.5 * detection.blooming * max(light - detection.full, 0.0) - here;
    }
    return here;
}

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    bloomed = texelFetch(focal_plane, place, 0).r;
    if (texelFetch(block_picture, ivec2(place.x, 0), 0).g <= 0.0) return;
    bloomed = min(bloomed, detection.full) + caught(place.x, 0, place.y, 1)
            + caught(place.x, textureSize(focal_plane, 0).y - 1, place.y, -1);
}
