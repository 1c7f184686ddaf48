"""The effects by name: each is one term of the model that can be left out, and what is no term of it at all."""

from dataclasses import dataclass

SURFACE, FRAME = "surface", "frame"


@dataclass(frozen=True, slots=True, kw_only=True)
class Effect:
    """One term of the model. Without it: see `without`."""

    name: str
    stage: str  # SURFACE: decided once for a bake; FRAME: for each frame
    meaning: str
    without: str  # what the model does then
    sky: str | None = None  # needs this model of the sky
    mode: str | None = None  # needs a sensor of this mode
    part: bool = False  # needs a sensor that has this in its chain
    optional: bool = False  # computed where asked for, and not by its bound


def _surface(name: str, meaning: str, without: str, sky: str | None = None, mode: str | None = None) -> Effect:
    return Effect(name=name, stage=SURFACE, meaning=meaning, without=without, sky=sky, mode=mode)


def _frame(name: str, meaning: str, without: str, mode: str | None = None) -> Effect:
    return Effect(name=name, stage=FRAME, meaning=meaning, without=without, mode=mode)


def _part(name: str, meaning: str, without: str) -> Effect:
    return Effect(name=name, stage=FRAME, meaning=meaning, without=without, part=True)


_DARK = "no light from there"
EFFECTS = (
    _surface("temperature", "temperature of surfaces", "no wall is solved", mode="reflective"),
    _surface("direct_sun", "sunlight straight from the sun", _DARK),
    _surface("sky_dome", "daylight of the uniform dome", _DARK, "perez"),
    _surface("sky_glow", "daylight of the glow around the sun", _DARK, "perez"),
    _surface("sky_horizon", "daylight of the bright or dark horizon", _DARK, "perez"),
    _surface("sky_north", "daylight of the northern quarter of the sky", _DARK, "quadrants"),
    _surface("sky_east", "daylight of the eastern quarter of the sky", _DARK, "quadrants"),
    _surface("sky_south", "daylight of the southern quarter of the sky", _DARK, "quadrants"),
    _surface("sky_west", "daylight of the western quarter of the sky", _DARK, "quadrants"),
    _surface("ground_sun", "sunlight from the ground", _DARK),
    _surface("thermal_sky", "long waves of a sky colder than the air", "a sky as warm as the air"),
    _surface("ground_exchange", "long waves of a ground warmer or colder than the air", "a ground as warm as the air"),
    _surface("forced_convection", "the wind's film of air", "no film but the free one"),
    _surface("free_convection", "the film that a warm or cold surface raises itself", "no film but the forced one"),
    _surface("rain", "rain on surfaces: its heat, and the film that stays", "surfaces that no rain hits"),
    _surface("evaporation", "water that evaporates or comes down as dew", "dry surfaces"),
    _surface("snow", "snow on the ground and its melting", "bare ground"),
    Effect(
        name="exchange", stage=SURFACE, meaning="long waves and light between near surfaces",
        without="each surface alone under its sky", optional=True,
    ),
    _surface("interior", "heat from or to what lies behind the wall", "an inner face that no heat passes"),
    _surface("spare_orientations", "walls of orientations that no surface has", "orientations in the scene alone"),
    _surface("spare_reflectances", "walls of reflectances that no surface has", "reflectances in the scene alone"),
    _frame("reflected_sky", "sky and ground mirrored by surfaces", "no mirrored part", "emissive"),
    _frame("specular", "mirrors: sky, ground and glint of the sun, by the angle", "matt surfaces"),
    _frame("reflected_sun", "light in band straight from sun or moon, from surfaces", _DARK, "reflective"),
    _frame("atmosphere", "what the air takes from a surface's radiance and adds of its own", "a path through nothing"),
    _part("blur", "optics, motion and size of the detector", "each pixel sees its middle"),
    _part("noise", "noise and fixed pattern of the detector", "light and counts alone"),
    _part("memory", "what the detector keeps of the last picture", "each picture on its own"),
    _part("streaks", "a channel's level, lost by coupling", "all levels as they are"),
    _part("halo", "discs of light around bright lights", "none"),
    _part("blooming", "charge of full wells in the others of their column", "it is drained"),
    _part("dead_elements", "elements that do not see", "all see"),
    _part("replacement", "neighbours in place of dead elements", "dead elements show nothing"),
    _part("interlace", "fields that come in turn: a comb on what moves", "whole frames"),
    _part("raster_lines", "lines of a raster wider than a row", "a line for each row"),
)  # fmt: skip
SUNLIGHT = ("direct_sun", *(effect.name for effect in EFFECTS if effect.sky is not None), "ground_sun")
NAMES = tuple(effect.name for effect in EFFECTS)
BY_NAME = {effect.name: effect for effect in EFFECTS}

# What no setting can switch on.
NOT_MODELLED = (
    "cast shadows, and surfaces in each other's way, except by the optional exchange",
    "surfaces in each other's mirrors, and the sun in those of emissive bands",
    "sunlight that surfaces reflect in emissive bands, which counts by day in 3 to 5 um",
    "conduction along a wall, and across its edges",
    "differences within a surface: texture, wear, dirt and damp",
    "what lies behind windows, as seen through them",
    "relief: the ground is level all around",
    "blur by motion of the camera or of what it sees, beyond the sensor's own jitter and drift",
    "scattering of sunlight along the path in emissive bands, turbulence, and polarisation",
    "clouds of any shape: cover is the same all over the sky, and no shadow of a cloud passes",
    "weather aloft: above the station the air thins out and cools as in the standard atmosphere",
    "lamps, fires and the light of cities",
    "plumes and people, and vehicles but those that a trainer's host places, which shade and warm nothing around them",
    "wind that buildings turn aside",
    "water that runs, ponds or freezes on surfaces, and snow on roofs and trees",
)
