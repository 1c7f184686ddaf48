// Provides normal_deviate(): a normally distributed number for a place, frame and seed, the same on every device.
// Hash pcg4d of [Jarzynski2020]; the top 12 bits choose one of 4096 equally likely deviates.
// Twin: sensorsim.sensor.random_field.
uniform sampler2D deviate_table;

float normal_deviate(uint column, uint row, uint frame, uint seed) {
    uvec4 v = uvec4(column, row, frame, seed) * 1664525u + 1013904223u;
    v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
    v ^= v >> 16u;
    v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
    return texelFetch(deviate_table, ivec2(int(v.x >> 20u), 0), 0).r;
}
