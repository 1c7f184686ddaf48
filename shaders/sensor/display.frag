#version 330 core
// Provides: grey from band radiance by level, span and polarity, rounded to display codes as the twin
// sensorsim.sensor.display rounds them, since OpenGL leaves halves to the driver; a tone curve may bend the line.
#include "common/quantities.glsl"
#include "generated/display_block.glsl"
#include "generated/tone.glsl"

uniform sampler2D radiance_picture;

out float grey;

void main() {
    Radiance signal = texelFetch(radiance_picture, ivec2(gl_FragCoord.xy), 0).r;
    Ratio white_hot = tone(clamp((signal - display.level) / display.span + 0.5, 0.0, 1.0));
    grey = floor(255.0 * mix(white_hot, 1.0 - white_hot, display.black_hot) + 0.5) / 255.0;
}
