"""Sections 4.2.3 and 4.3.3 of [Report1978]: the pictures of levels IA and IIA on the winter day, by both sensors."""

from functools import partial

import numpy as np

from sensorsim.study.claims_evidence import (
    CEMENT_PLANT,
    HEATING_PLANT,
    HOSPITAL,
    SOUTH,
    SOUTH_EAST,
    SOUTH_WEST,
    WEST,
    Evidence,
)
from sensorsim.study.claims_lltv import LIGHTER, MUCH_LIGHTER
from sensorsim.study.claims_model import NOTICEABLE, SIGNIFICANT, Claim, Numbers, more

LEVELS = ("IA", "IIA", "IIIB")
DAYTIME = {"flir": (10.0, 13.0, 17.0), "lltv": (10.0, 13.0, 16.0)}
MAJOR = {  # at level IIA: feature numbers, and the azimuths that face more to the south and more to the west
    "hospital": (HOSPITAL["IIA"], SOUTH, WEST),
    "heating plant": (HEATING_PLANT["IIA"], SOUTH, WEST),
    "cement plant": (CEMENT_PLANT["IIA"], SOUTH_EAST, SOUTH_WEST),
}
SEEN_FROM_BOTH_SIDES = ("hospital", "heating plant")  # the tower sees their south and west walls


def _wall_share(evidence: Evidence) -> Numbers:
    """Share of the surfaces' pixels that lie on walls, and on the one wall that has most of them."""
    numbers = {}
    for level in LEVELS:
        view = evidence[level, "winter"]
        surface = view.pictures["flir", 10.0, "tower"].planes["surface_id"]
        pixels = np.bincount(surface[surface >= 0], minlength=view.rows().size)
        walls = pixels[view.rows(role="wall")]
        numbers[f"{level} walls"] = float(walls.sum() / pixels.sum())
        numbers[f"{level} largest wall"] = float(walls.max() / pixels.sum())
    return numbers


def _sun_seen_in_walls(evidence: Evidence, sensor: str) -> Numbers:
    """Spread of the shades of building walls by level, the mean over the daytime pictures."""
    numbers = {}
    for level in LEVELS:
        view = evidence[level, "winter"]
        spreads = [view.spread(sensor, hour, view.building_walls()) for hour in DAYTIME[sensor]]
        numbers[level] = float(np.mean(spreads))
    return numbers


def _overall_and_walls(evidence: Evidence) -> Numbers:
    """At level IA: how the whole picture changes from 7 to 13 h, and how far walls differ at one time."""
    view = evidence["IA", "winter"]
    walls = view.building_walls()
    return {
        "overall change": view.shade("flir", 13.0) - view.shade("flir", 7.0),
        "greatest wall spread": max(view.spread("flir", hour, walls) for hour in (7.0, 10.0, 13.0)),
    }


def _overall(evidence: Evidence, level: str, sensor: str) -> Numbers:
    view = evidence[level, "winter"]
    hours = (7.0, *DAYTIME[sensor])
    numbers = {f"{hour:g} h": view.shade(sensor, hour) for hour in hours}
    walls, flat = view.rows(role="wall"), view.rows(role="plane") | view.rows(role="roof")
    numbers |= {f"walls {hour:g} h": view.shade(sensor, hour, walls) for hour in hours}
    return numbers | {f"flat {hour:g} h": view.shade(sensor, hour, flat) for hour in hours}


def _south_and_west_at_iia(evidence: Evidence) -> Numbers:
    """By how much walls that face more to the south are warmer than those that face more to the west."""
    view = evidence["IIA", "winter"]
    numbers = {}
    for name, (features, first, second) in MAJOR.items():
        south, west = (view.rows(features, "wall", azimuth) for azimuth in (first, second))
        for hour in (10.0, 13.0, 17.0):
            numbers[f"{name} {hour:g} h"] = view.temperature(hour, south) - view.temperature(hour, west)
    return numbers


def _lltv_south_over_west_at_iia(evidence: Evidence) -> Numbers:
    """Radiance of south walls over that of west walls, of the features that show both."""
    view = evidence["IIA", "winter"]
    numbers = {}
    for name in SEEN_FROM_BOTH_SIDES:
        features, first, second = MAJOR[name]
        south, west = (view.rows(features, "wall", azimuth) for azimuth in (first, second))
        for hour in DAYTIME["lltv"]:
            numbers[f"{name} {hour:g} h"] = view.shade("lltv", hour, south) / view.shade("lltv", hour, west)
    return numbers


def _features_by_level(evidence: Evidence) -> Numbers:
    """Features that the tower's picture shows."""
    counts = {}
    for level in LEVELS:
        planes = evidence[level, "winter"].pictures["lltv", 10.0, "tower"].planes
        counts[level] = float(np.unique(planes["feature"][planes["feature"] >= 0]).size)
    return counts


CLAIMS = (
    Claim(
        id="flir-IA-no-large-walls",
        section="4.2.3",
        content="at level IA no large surfaces face the observer",
        unit="-",
        measure=_wall_share,
        relations=(more("IIIB walls", than="IA walls"), more("IIIB largest wall", than="IA largest wall")),
        reason="At level IA a cluster of family houses is one block 25 ft high and hundreds of metres long, and the "
        "nearest one's long side faces the tower. Outlines are reconstructed; the report's view may have missed it.",
        instead=(more("IA largest wall", than="IIIB largest wall", times=2.0),),
    ),
    Claim(
        id="flir-IA-sun-hard-to-tell",
        section="4.2.3",
        content="at level IA the sun's position cannot be told as easily through the day as at higher levels",
        unit="K",
        measure=partial(_sun_seen_in_walls, sensor="flir"),
        relations=(more("IIA", than="IA"), more("IIIB", than="IA", times=1.5)),
    ),
    Claim(
        id="flir-IA-only-overall-change",
        section="4.2.3",
        content="only the overall change of the environment can be followed through the day at level IA",
        unit="K",
        measure=_overall_and_walls,
        relations=(more("overall change", than="greatest wall spread", times=2.0),),
    ),
    Claim(
        id="flir-IA-brighter-as-sun-rises",
        section="4.2.3",
        content="at level IA surfaces get progressively warmer, and the pictures brighter, as the sun rises",
        unit="K",
        measure=partial(_overall, level="IA", sensor="flir"),
        relations=(more("10 h", than="7 h", by=SIGNIFICANT), more("13 h", than="10 h", by=SIGNIFICANT)),
    ),
    Claim(
        id="flir-IIA-south-walls-warmer-than-west",
        section="4.2.3",
        content="at level IIA the sun's position is apparent: the south walls of hospital, heating plant and cement "
        "plant are warmer than the walls that face more to the west (10 and 13 h)",
        unit="K",
        measure=_south_and_west_at_iia,
        relations=tuple(more(f"{name} {hour} h", than=SIGNIFICANT) for name in MAJOR for hour in (10, 13)),
    ),
    Claim(
        id="flir-IIA-lighter-towards-midday",
        section="4.2.3",
        content="at level IIA the pictures become gradually lighter as the day goes on (7, 10, 13 h)",
        unit="K",
        measure=partial(_overall, level="IIA", sensor="flir"),
        relations=(more("10 h", than="7 h", by=SIGNIFICANT), more("13 h", than="10 h", by=SIGNIFICANT)),
    ),
    Claim(
        id="flir-IIA-lighter-towards-evening",
        section="4.2.3",
        content="and they go on becoming lighter to the last picture, of 17 h",
        unit="K",
        measure=partial(_overall, level="IIA", sensor="flir"),
        relations=(more("17 h", than="13 h"),),
        reason="Ground and roofs follow the sinking sun down from early afternoon on, under a clear sky and in wind. "
        "Only walls keep their warmth to 17 h.",
        instead=(
            more("flat 13 h", than="flat 17 h", by=SIGNIFICANT),
            more("walls 17 h", than="walls 13 h", by=-NOTICEABLE),
            more("17 h", than="10 h", by=NOTICEABLE),
        ),
    ),
    Claim(
        id="lltv-IA-little-of-sun",
        section="4.3.3",
        content="at level IA the low-light pictures tell little of the sun's position, less than at level IIIB",
        unit="W m-2 sr-1",
        measure=partial(_sun_seen_in_walls, sensor="lltv"),
        relations=(more("IIIB", than="IA", times=2.0),),
    ),
    Claim(
        id="lltv-IA-horizontal-lighter-as-sun-rises",
        section="4.3.3",
        content="at level IA the large horizontal surfaces become lighter as the sun rises",
        unit="W m-2 sr-1",
        measure=partial(_overall, level="IA", sensor="lltv"),
        relations=(
            more("flat 10 h", than="flat 7 h", times=LIGHTER),
            more("flat 13 h", than="flat 10 h", times=LIGHTER),
        ),
    ),
    Claim(
        id="lltv-IIA-more-features",
        section="4.3.3",
        content="at level IIA there are more individual features than at IA",
        unit="-",
        measure=_features_by_level,
        relations=(more("IIA", than="IA"),),
    ),
    Claim(
        id="lltv-IIA-sun-not-told-by-surfaces",
        section="4.3.3",
        content="at level IIA the sun's position cannot be told from individual surfaces",
        unit="-",
        measure=_lltv_south_over_west_at_iia,
        relations=tuple(more(LIGHTER, than=f"{name} {hour} h") for name in SEEN_FROM_BOTH_SIDES for hour in (10, 13)),
        reason="Hospital and heating plant show the tower a south and a west wall at level IIA as well, and what tells "
        "the sun at IIIB tells it here. Of the same outlines section 4.2.3 says that the sun is quite apparent.",
        instead=tuple(
            more(f"{name} {hour} h", than=MUCH_LIGHTER) for name in SEEN_FROM_BOTH_SIDES for hour in (10, 13)
        ),
    ),
)
