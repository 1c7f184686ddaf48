// Provides surface_texel(): the surfaces of the scene as records of six texels, and their layout.
//   0: normal xyz, wall type          1: standard orientations i j k, emissivity
//   2: weights of i j k, reflectance  3: view factors of the N E S W quarter of the sky
//   4: reflectance in 0.8-1.1 um, feature, offset of near surfaces from the tables [K], spare
//   5: kind of gloss or -1, emissivity along the normal, a facet's reflectance there in 0.8-1.1 um, spare
uniform sampler2D surface_table;

const int SURFACE_TEXELS = 6;
const int SURFACES_PER_ROW = 1024;

vec4 surface_texel(int surface, int texel) {
    int column = (surface % SURFACES_PER_ROW) * SURFACE_TEXELS + texel;
    return texelFetch(surface_table, ivec2(column, surface / SURFACES_PER_ROW), 0);
}
