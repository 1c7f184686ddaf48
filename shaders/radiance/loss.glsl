// Provides bend_back() [K]: the temperature of a straightened value, by Newton's steps from a slope of about one.
// Twin: sensorsim.tables.straighten; value and slope there, tilts of the free film as in thermal.convection.
#include "common/quantities.glsl"

const int NEWTON_STEPS = 5;

// Cube of the free film of a face whose warm or cold air rises by its cosine to the vertical, over a vertical one's
// [Walton1983 eq. 89 and 90].
Ratio tilt_term(Ratio rising) {
    float tilt = abs(rising);
    float more = rising >= 0.0 ? 7.238 / (7.238 - tilt) : 1.382 / (1.382 + tilt);
    return more * more * more;
}

// level: of the air; loss: own part, radiation [K-3], leeward film, what a face into the wind has more; free: its film
// cubed [K-1]; towards: where the wind comes from
Kelvin bend_back(Kelvin value, Kelvin level, vec4 loss, float free, vec2 towards, Direction normal) {
    Ratio share = clamp(0.5 * (1.0 + dot(towards, normal.xy) + abs(normal.z)), 0.0, 1.0);
    float forced = loss.z + share * loss.w;
    float warmer = free * tilt_term(normal.z), colder = free * tilt_term(-normal.z);
    Kelvin above = value;
    for (int k = 0; k < NEWTON_STEPS; ++k) {
        float radiated = 4.0 * level * level * level + above * (6.0 * level * level + above * (4.0 * level + above));
        float steeper = above * (6.0 * level * level + above * (8.0 * level + 3.0 * above));
        float rising = (above >= 0.0 ? warmer : colder) * abs(above);
        float film = pow(forced * forced * forced + rising + 1e-30, 1.0 / 3.0);
        float per_kelvin = loss.x + loss.y * radiated + film;
        float slope = per_kelvin + loss.y * steeper + rising / (3.0 * film * film);
        above -= (above * per_kelvin - value) / slope;
    }
    return level + above;
}
