#version 330 core
// Provides: the picture that lines of a raster make [W m-2 sr-1]; rows that the frame does not bring stay as they are in
// the target. Twin: sensorsim.sensor.raster.
#include "common/quantities.glsl"

uniform sampler2D reported_picture;
uniform sampler2D raster_table;  // of each row, from the top: the row of the report that it shows, below 0 where it stays

out float woven;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    int rows = textureSize(reported_picture, 0).y;
    float source = texelFetch(raster_table, ivec2(rows - 1 - place.y, 0), 0).r;
    if (source < 0.0) discard;
    woven = texelFetch(reported_picture, ivec2(place.x, rows - 1 - int(source + 0.5)), 0).r;
}
