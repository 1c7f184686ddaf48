// Provides block_value(): a picture of blocks at a place of the whole one, straight between the blocks' middles.
// Twin: sensorsim.sensor.spill.spread_blocks.
float block_value(sampler2D blocks, ivec2 place, vec2 block) {
    vec2 last = vec2(textureSize(blocks, 0) - 1);
    vec2 position = clamp((vec2(place) + 0.5) / block - 0.5, vec2(0.0), last);
    ivec2 low = min(ivec2(position), max(ivec2(last) - 1, ivec2(0)));
    ivec2 high = min(low + 1, ivec2(last));
    vec2 share = position - vec2(low);
    float lower = mix(texelFetch(blocks, low, 0).r, texelFetch(blocks, ivec2(high.x, low.y), 0).r, share.x);
    float upper = mix(texelFetch(blocks, ivec2(low.x, high.y), 0).r, texelFetch(blocks, high, 0).r, share.x);
    return mix(lower, upper, share.y);
}
