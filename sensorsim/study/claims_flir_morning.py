"""Section 4.2.2 of [Report1978]: the thermal pictures of the winter morning, 7 and 10 h."""

from functools import partial

import numpy as np

from sensorsim.study.claims_evidence import EAST, FOREGROUND, HOSPITAL, NORTH, SOUTH, WEST, Evidence, View
from sensorsim.study.claims_model import NOTICEABLE, SIGNIFICANT, UNIFORM, Claim, Numbers, more

NEAR = 30.0  # [deg] from the sun's azimuth up to which walls count as pointing to it


def _view(evidence: Evidence) -> View:
    return evidence["IIIB", "winter"]


def _wall_spread(evidence: Evidence) -> Numbers:
    view = _view(evidence)
    walls = view.building_walls()
    return {f"{hour:g} h": view.spread("flir", hour, walls) for hour in (7.0, 10.0)}


def _foreground(evidence: Evidence, hour: float) -> Numbers:
    """Roofs and walls of the foreground, and what the sky does to them."""
    view = _view(evidence)
    sample = view.world.environment.at(hour * 3600.0)
    walls, lit = view.rows(FOREGROUND, "wall"), view.sun_cosine(hour) > 0.0
    return {
        "roofs": view.shade("flir", hour, view.rows(FOREGROUND, "roof")),
        "walls": view.shade("flir", hour, walls),
        "walls away from the sun": view.shade("flir", hour, walls & ~lit),
        "air": sample.air_temperature,
        "sky": sample.sky_temperature,
        "cosine of the sun to roofs": float(sample.sun_direction[2]),
    }


def _picture_spread(evidence: Evidence) -> Numbers:
    view = _view(evidence)
    return {f"{hour:g} h": view.spread("flir", hour) for hour in (7.0, 10.0)}


def _direction_of_warmth(evidence: Evidence) -> Numbers:
    """Azimuths of the sun and of the first harmonic of the temperatures of the hospital's four sides."""
    view = _view(evidence)
    azimuths = (NORTH, EAST, SOUTH, WEST)
    warmth = [view.temperature(10.0, view.rows(HOSPITAL["IIIB"], "wall", azimuth)) for azimuth in azimuths]
    angle = np.radians(azimuths)
    sun = view.world.environment.at(36000.0).sun_direction
    warm = float(np.degrees(np.arctan2(np.sin(angle) @ warmth, np.cos(angle) @ warmth))) % 360.0
    sunny = float(np.degrees(np.arctan2(sun[0], sun[1]))) % 360.0
    return {"walls": warm, "sun": sunny, "difference": abs(warm - sunny)}


def _hospital_south_and_west(evidence: Evidence) -> Numbers:
    view = _view(evidence)
    numbers = {}
    for side, azimuth in (("south", SOUTH), ("west", WEST)):
        walls = view.rows(HOSPITAL["IIIB"], "wall", azimuth)
        numbers[side] = view.shade("flir", 10.0, walls)
        numbers[f"cosine of the sun to {side}"] = float(view.sun_cosine(10.0)[walls].mean())
    return numbers


CLAIMS = (
    Claim(
        id="7h-walls-of-one-shade",
        section="4.2.2",
        content="at 7 h, with the sun below the horizon, all walls have nearly one shade",
        unit="K",
        measure=_wall_spread,
        relations=(more(UNIFORM, than="7 h"), more("10 h", than="7 h", times=4.0)),
    ),
    Claim(
        id="7h-foreground-roofs-colder-than-walls",
        section="4.2.2",
        content="at 7 h the roofs of the buildings in the foreground are significantly colder than their walls, for "
        "the cold sky that they radiate to",
        unit="K",
        measure=partial(_foreground, hour=7.0),
        relations=(more("walls", than="roofs", by=SIGNIFICANT), more("air", than="sky", by=10.0)),
    ),
    Claim(
        id="10h-high-contrast",
        section="4.2.2",
        content="by 10 h the sun is the main load and the picture has high contrast",
        unit="K",
        measure=_picture_spread,
        relations=(more("10 h", than="7 h", times=1.5),),
    ),
    Claim(
        id="10h-hospital-walls-point-to-sun",
        section="4.2.2",
        content="at 10 h the shades of walls, the hospital's above all, tell where the sun is",
        unit="deg",
        measure=_direction_of_warmth,
        relations=(more(NEAR, than="difference"),),
    ),
    Claim(
        id="10h-hospital-south-warmer-than-west",
        section="4.2.2",
        content="at 10 h the hospital's south walls are significantly warmer than its west walls: the sun lights the "
        "one and not the other",
        unit="K",
        measure=_hospital_south_and_west,
        relations=(
            more("south", than="west", by=SIGNIFICANT),
            more("cosine of the sun to south", than=0.0),
            more(0.0, than="cosine of the sun to west"),
        ),
    ),
    Claim(
        id="10h-roofs-and-walls-reversed",
        section="4.2.2",
        content="at 10 h the sun also lights the roofs in the foreground, and they have become warmer than walls: than "
        "those that the sun does not reach",
        unit="K",
        measure=partial(_foreground, hour=10.0),
        relations=(
            more("roofs", than="walls away from the sun", by=NOTICEABLE),
            more("cosine of the sun to roofs", than=0.0),
        ),
    ),
)
