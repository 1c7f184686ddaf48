"""One look for each effect that calls for it: weather, hour, sensor, camera, and what an engineer should see change."""

from collections.abc import Mapping
from dataclasses import dataclass

from sensorsim.effects import EFFECTS


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One effect in one band. The scene is the hospital, level IIIB."""

    effect: str
    sensor: str  # of effects_sensors
    weather: str  # of effects_weather
    hour: float
    camera: str  # of the scene, or 'behind' and 'into the sun': see effects_pairs
    look_for: str
    sky: str = "perez"
    turn: float = 0.0  # [deg] that the camera has turned by since the frame before, for what remembers it


def _warm(effect: str, weather: str, hour: float, camera: str, look_for: str, sky: str = "perez") -> Case:
    return Case(
        effect=effect, sensor="flir", weather=weather, hour=hour, camera=camera, look_for=look_for, sky=sky
    )  # fmt: skip


def _light(effect: str, weather: str, hour: float, camera: str, look_for: str) -> Case:
    return Case(effect=effect, sensor="lltv", weather=weather, hour=hour, camera=camera, look_for=look_for)


def _part(effect: str, sensor: str, hour: float, look_for: str, camera: str = "tower", turn: float = 0.0) -> Case:
    return Case(
        effect=effect, sensor=sensor, weather="winter", hour=hour, camera=camera, look_for=look_for, turn=turn
    )  # fmt: skip


CASES = (
    _warm("direct_sun", "winter", 13.0, "hospital",
          "The wall that faces the sun falls to the warmth of the one in its own shade; the ground cools less."),
    _light("reflected_sun", "winter", 13.0, "hospital",
           "Sunlit wall, roofs and ground lose their light; what is left is the sky's, nearly even all around."),
    _warm("sky_dome", "summer", 13.0, "hospital",
          "Under a closed sky all surfaces cool, level ones most: they see all of the dome, walls half of it."),
    _warm("sky_glow", "fall", 10.0, "hospital",
          "Surfaces turned to the sun cool, as with the sun itself but less; walls turned away stay as they are."),
    _warm("sky_horizon", "winter", 13.0, "hospital",
          "Walls cool by the light of the bright rim of a clear sky; level ground and roofs do not change."),
    _warm("sky_north", "fall", 12.0, "behind", "The north wall cools most, roofs and ground a little.", "quadrants"),
    _warm("sky_east", "fall", 12.0, "behind", "The east wall cools most, roofs and ground a little.", "quadrants"),
    _warm("sky_south", "fall", 12.0, "hospital", "The south wall cools most, roofs and ground a little.", "quadrants"),
    _warm("sky_west", "fall", 12.0, "hospital", "The west wall cools most, roofs and ground a little.", "quadrants"),
    _warm("ground_sun", "winter", 13.0, "hospital",
          "Walls cool by the sunlight that the ground throws at them; roofs and the ground do not change."),
    _warm("thermal_sky", "winter", 7.0, "tower",
          "Before dawn roofs and open ground are colder than the air under a clear sky: without it all warm to it."),
    _warm("ground_exchange", "winter", 13.0, "hospital",
          "Walls lose what the sunlit ground, warmer than the air, sends to them; roofs do not see it."),
    _warm("forced_convection", "winter", 13.0, "hospital",
          "Without the wind's film sunlit surfaces heat up by tens of kelvin and shaded ones drift from the air."),
    _warm("free_convection", "still winter", 13.0, "cement_plant",
          "With no wind warm sheds and pavement are cooled by air that they raise themselves: without it they glow."),
    _warm("rain", "rain", 12.0, "tower", "Rain cools roofs most, walls and grass a little."),
    _warm("evaporation", "summer", 13.0, "tower", "Grass and trees lose their coolness; dry walls stay as they are."),
    _warm("snow", "snow", 13.0, "tower", "Ground under snow is colder than 273 K and even; bare ground has patterns."),
    _light("snow", "snow", 13.0, "tower", "Snow makes the ground brighter than any wall, and lights walls from below."),
    _warm("exchange", "winter", 7.0, "tower",
          "Walls that stand close to others are warmer before dawn: they see each other in place of sky and ground."),
    _warm("interior", "winter", 7.0, "hospital", "Heated walls leak: with no rooms behind them they are a bit colder."),
    _warm("reflected_sky", "winter", 7.0, "cement_plant",
          "Without what they mirror surfaces look colder by their reflectance; bare metal sheds by far the most."),
    _warm("specular", "winter", 13.0, "cement_plant",
          "Metal sheds mirror the low sky, warmer than the mean of sky and ground; matt ones do not."),
    _light("specular", "winter", 13.0, "cement_plant",
           "Metal sheds mirror the dark sky away from the sun; matt ones scatter its light here and are brighter."),
    _warm("atmosphere", "summer", 13.0, "tower", "Far surfaces lose contrast and take on the air's temperature."),
    _light("atmosphere", "winter", 10.0, "tower", "Far surfaces lose contrast under a veil of scattered sunlight."),
    _part("blur", "flir1977", 10.0, "Edges are soft over about two pixels; thin masts fade."),
    _part("blur", "sit1977", 10.0, "The tube's spot makes a soft picture; thin masts fade."),
    _part("noise", "flir1977", 10.0, "Rows of unequal channels and grain over all; nothing else changes."),
    _part("noise", "sit1977", 7.25, "Before sunrise few electrons are counted: grain over all, most in dark parts."),
    _part("memory", "uncooled", 10.0, "The frame before still shows: double edges along the turn.", turn=0.3),
    _part("memory", "sit1977", 10.0, "The tube still holds a share of the frame before: double edges.", turn=0.3),
    _part("streaks", "flir1977", 13.0,
          "Rows that hold hot walls are darkened, to their right most; the cold sky comes to the ground's level."),
    _part("blooming", "emccd, blooming", 16.5, "Bright haze below the low sun spills up and down its columns.",
          "into the sun"),
    _part("interlace", "sit1977", 10.0, "Every other line is of the frame before: a comb along the turn.", turn=0.3),
    _part("interlace", "flir1977", 10.0, "Every other line is of the frame before: a comb along the turn.", turn=0.3),
    _part("raster_lines", "sit1977, coarse", 10.0, "Lines three rows high: steps along slanted edges."),
    _part("dead_elements", "uncooled, blind", 10.0, "Black points all over, in the same places in every frame."),
    _part("replacement", "uncooled, repaired", 10.0, "The black points are gone: their neighbours stand for them."),
    _part("halo", "sit1977", 16.5, "Light of the haze below the low sun, which saturates the tube, spills over roofs.",
          "into the sun"),
)  # fmt: skip

WITHOUT_PICTURE: Mapping[str, str] = {
    "temperature": "a low-light picture is the same with and without it",
    "spare_orientations": "histories that no surface of the scene shows: pictures are the same",
    "spare_reflectances": "histories that no surface shows: pictures are the same to what a polynomial misses",
}


def all_cases() -> tuple[Case, ...]:
    """CASES, and for an effect that has none of its own and calls for no part of a sensor the tower at noon."""
    known = {case.effect for case in CASES} | set(WITHOUT_PICTURE)
    plain = [effect for effect in EFFECTS if effect.name not in known and not effect.part]
    looks = {effect.name: _light if effect.mode == "reflective" else _warm for effect in plain}
    return CASES + tuple(
        looks[effect.name](effect.name, "winter", 13.0, "tower", f"{effect.meaning[0].upper()}{effect.meaning[1:]}.")
        for effect in plain
    )
