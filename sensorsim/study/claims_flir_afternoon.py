"""Section 4.2.2 of [Report1978]: the thermal pictures of the winter afternoon, 13 and 17 h."""

from functools import partial

import numpy as np

from sensorsim.study.claims_evidence import (
    CEMENT_PLANT,
    FOREGROUND,
    HEATING_PLANT,
    HOSPITAL,
    SOUTH,
    SOUTH_EAST,
    SOUTH_WEST,
    WEST,
    Evidence,
    View,
)
from sensorsim.study.claims_flir_winter import block_and_metal
from sensorsim.study.claims_model import NOTICEABLE, SIGNIFICANT, Claim, Numbers, more

HOURS = (7.0, 10.0, 13.0, 17.0)


def _view(evidence: Evidence) -> View:
    return evidence["IIIB", "winter"]


def _wall_spread(evidence: Evidence) -> Numbers:
    view = _view(evidence)
    walls = view.building_walls()
    return {f"{hour:g} h": view.spread("flir", hour, walls) for hour in HOURS}


def _sun_and_hospital(evidence: Evidence) -> Numbers:
    """Elevation of the sun, and the angle between it and the hospital's walls."""
    view = _view(evidence)
    numbers = {f"elevation at {hour:g} h": view.world.environment.at(hour * 3600.0).sun_elevation for hour in HOURS}
    for side, azimuth in (("south", SOUTH), ("west", WEST)):
        walls = view.rows(HOSPITAL["IIIB"], "wall", azimuth)
        for hour in (10.0, 13.0):
            angle = np.degrees(np.arccos(view.sun_cosine(hour)[walls]))
            numbers[f"{side} at {hour:g} h"] = float(angle.mean())
    return numbers


def _morning_to_midday(evidence: Evidence) -> Numbers:
    """By how much shades rise from 10 to 13 h."""
    view = _view(evidence)
    groups = {
        "ground": view.rows(role="plane"),
        "roofs": view.rows(role="roof") & (view.world.scene.surfaces.interior != "none"),
        "hospital south": view.rows(HOSPITAL["IIIB"], "wall", SOUTH),
        "hospital west": view.rows(HOSPITAL["IIIB"], "wall", WEST),
    }
    return {name: view.shade("flir", 13.0, rows) - view.shade("flir", 10.0, rows) for name, rows in groups.items()}


def _cement_walls(evidence: Evidence) -> Numbers:
    view = _view(evidence)
    walls = view.rows(CEMENT_PLANT["IIIB"], "wall", SOUTH_WEST)
    numbers = {}
    for hour in (10.0, 13.0):
        numbers[f"{hour:g} h"] = view.shade("flir", hour, walls)
        numbers[f"cosine of the sun at {hour:g} h"] = float(view.sun_cosine(hour)[walls].max())
    return numbers


def _evening_and_morning(evidence: Evidence) -> Numbers:
    view = _view(evidence)
    numbers = {f"{hour:g} h": view.shade("flir", hour) for hour in (7.0, 10.0, 17.0)}
    for role in ("wall", "roof", "plane"):
        for hour in (10.0, 17.0):
            numbers[f"{role}s {hour:g} h"] = view.shade("flir", hour, view.rows(role=role))
    return numbers


def _first_over_second(evidence: Evidence, features: tuple[str, ...], first: float, second: float) -> Numbers:
    """By how much walls of one azimuth are warmer than those of another, through the day."""
    view = _view(evidence)
    a, b = (view.rows(features, "wall", azimuth) for azimuth in (first, second))
    return {f"{hour:g} h": view.temperature(hour, a) - view.temperature(hour, b) for hour in (10.0, 13.0, 17.0)}


CLAIMS = (
    Claim(
        id="13h-sun-near-its-highest",
        section="4.2.2",
        content="at 13 h the sun is close to its highest",
        unit="deg",
        measure=_sun_and_hospital,
        relations=tuple(more("elevation at 13 h", than=f"elevation at {hour:g} h") for hour in (7.0, 10.0, 17.0)),
    ),
    Claim(
        id="13h-sun-further-from-hospital-normals",
        section="4.2.2",
        content="at 13 h the sun stands at larger angles to the normals of the hospital's walls than at 10 h",
        unit="deg",
        measure=_sun_and_hospital,
        relations=(more("south at 13 h", than="south at 10 h"), more("west at 13 h", than="west at 10 h")),
        reason="The sun's true path has it south by 13 h: both walls seen from the tower face it more than at 10 h.",
        instead=(
            more("south at 10 h", than="south at 13 h", by=10.0),
            more("west at 10 h", than="west at 13 h", by=10.0),
        ),
    ),
    Claim(
        id="13h-ground-and-roofs-lighter",
        section="4.2.2",
        content="from 10 to 13 h ground and roofs become lighter",
        unit="K",
        measure=_morning_to_midday,
        relations=(more("ground", than=SIGNIFICANT), more("roofs", than=SIGNIFICANT)),
    ),
    Claim(
        id="13h-hospital-walls-unchanged",
        section="4.2.2",
        content="from 10 to 13 h the shades of the hospital's walls change insignificantly",
        unit="K",
        measure=_morning_to_midday,
        relations=(more(SIGNIFICANT, than="hospital south"), more(SIGNIFICANT, than="hospital west")),
        reason="The south wall faces the sun better at 13 h than at 10 h and has been in it for longer: it warms as "
        "much as the ground. The west wall warms with the air, by about half of that.",
        instead=(
            more("hospital south", than=SIGNIFICANT),
            more("hospital south", than="ground", times=0.8),
            more("ground", than="hospital west", times=1.5),
        ),
    ),
    Claim(
        id="13h-cement-walls-lighter-than-at-10h",
        section="4.2.2",
        content="the cement plant's walls face the sun by 13 h and not at 10 h, and so are lighter at 13 h",
        unit="K",
        measure=_cement_walls,
        relations=(
            more("13 h", than="10 h", by=SIGNIFICANT),
            more("cosine of the sun at 13 h", than=0.0),
            more(0.0, than="cosine of the sun at 10 h"),
        ),
    ),
    Claim(
        id="13h-metal-wall-warmer-than-block",
        section="4.2.2",
        content="at 13 h the cement plant's metal wall is warmer than its block wall, by the conductivities (as "
        "surface temperature, the report's shade)",
        unit="K",
        measure=partial(block_and_metal, hour=13.0),
        relations=(more("metal surface", than="block surface", by=SIGNIFICANT),),
    ),
    Claim(
        id="13h-metal-wall-lighter-than-block",
        section="4.2.2",
        content="the same in the picture of 13 h",
        unit="K",
        measure=partial(block_and_metal, hour=13.0),
        relations=(more("metal", than="block"),),
    ),
    Claim(
        id="17h-washed-out",
        section="4.2.2",
        content="by 17 h the picture is washed out: walls depend less on the sun's position than at midday",
        unit="K",
        measure=_wall_spread,
        relations=(more("13 h", than="17 h", by=NOTICEABLE), more("10 h", than="17 h")),
    ),
    Claim(
        id="17h-lighter-than-morning",
        section="4.2.2",
        content="at 17 h shades are in general lighter than in the morning hours, for the heat of the day kept",
        unit="K",
        measure=_evening_and_morning,
        relations=(more("17 h", than="7 h", by=SIGNIFICANT), more("17 h", than="10 h", by=NOTICEABLE)),
    ),
    Claim(
        id="17h-heating-plant-reversed",
        section="4.2.2",
        content="by 17 h the heating plant's south and west walls have changed places: west is the warmer",
        unit="K",
        measure=partial(_first_over_second, features=HEATING_PLANT["IIIB"], first=SOUTH, second=WEST),
        relations=(
            more("10 h", than=SIGNIFICANT),
            more("13 h", than=SIGNIFICANT),
            more(-NOTICEABLE, than="17 h"),
        ),
    ),
    Claim(
        id="17h-houses-reversed",
        section="4.2.2",
        content="so have walls that face more to the south and more to the west elsewhere: the houses' south-east and "
        "south-west walls",
        unit="K",
        measure=partial(_first_over_second, features=FOREGROUND, first=SOUTH_EAST, second=SOUTH_WEST),
        relations=(
            more("10 h", than=SIGNIFICANT),
            more("13 h", than=SIGNIFICANT),
            more(-SIGNIFICANT, than="17 h"),
        ),
    ),
)
