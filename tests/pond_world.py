"""Water, glass and a lawn in a reflective band, and a light from the south that they may mirror."""

from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from small_world import DAY, SETTINGS, box, feature, write_town

from sensorsim.environment import read_weather
from sensorsim.render import World, build_world, look_at
from sensorsim.render.illumination import SKY_ENTRIES, Illumination, dark
from sensorsim.scene import load_scene
from sensorsim.sensor import load_sensor

NORTH = look_at([0.0, 90.0, 30.0], [0.0, 0.0, 0.0], 60.0)  # into the sun of `southern`


@cache
def pond() -> World:
    """Water and a hall of glass on a lawn, 0.05 m of it above the ground."""
    features = [
        feature(box(0.0, 0.0, 500.0, 500.0), 0.0, word="9420"),
        feature(box(0.0, 0.0, 200.0, 200.0), 0.05, word="9805"),
        feature(box(0.0, 140.0, 40.0, 30.0), 14.0, roof_word="4008", wall_word="4008", interior="heated"),
    ]
    with TemporaryDirectory() as folder:
        scene = load_scene(write_town(Path(folder), features))
    return build_world(scene, read_weather("winter"), image_day=DAY, settings=SETTINGS, sensor=load_sensor("lltv"))


def southern(beam: float, height: float = 0.35, wind: float = 0.0) -> Illumination:
    """Light from the south, `height` its upward component, under an even sky."""
    return replace(
        dark(), sun_direction=np.array([0.0, -np.sqrt(1.0 - height**2), height]), beam=beam,
        quadrant=np.full(4, np.pi / 4.0 * 10.0), sky=np.full(SKY_ENTRIES, 10.0), ground_radiance=3.0, wind_speed=wind,
    )  # fmt: skip
