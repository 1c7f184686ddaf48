"""Section 4.2.1 of [Report1978], winter: the thermal picture of 7 February at 10 h."""

from functools import partial

from sensorsim.study.claims_evidence import (
    BLOCK_WALL,
    CEMENT_PLANT,
    HOSPITAL,
    METAL_WALL,
    SOUTH,
    SOUTH_WEST,
    WEST,
    Evidence,
    View,
)
from sensorsim.study.claims_model import NOTICEABLE, SIGNIFICANT, Claim, Numbers, more

HOUR = 10.0
SUNLIT = 0.2  # [-] cosine from which the sun counts as facing a wall


def _winter(evidence: Evidence) -> View:
    return evidence["IIIB", "winter"]


def _sunward_and_averted_walls(evidence: Evidence) -> Numbers:
    view = _winter(evidence)
    walls, cosine = view.building_walls(), view.sun_cosine(HOUR)
    return {
        "facing the sun": view.temperature(HOUR, walls & (cosine > SUNLIT)),
        "facing away": view.temperature(HOUR, walls & (cosine <= 0.0)),
    }


def _hospital_south_and_west(evidence: Evidence) -> Numbers:
    view = _winter(evidence)
    south, west = (view.rows(HOSPITAL["IIIB"], "wall", azimuth) for azimuth in (SOUTH, WEST))
    return {
        "south": view.shade("flir", HOUR, south),
        "west": view.shade("flir", HOUR, west),
        "south surface": view.temperature(HOUR, south),
        "west surface": view.temperature(HOUR, west),
        "air": view.world.environment.at(HOUR * 3600.0).air_temperature,
        "cosine of the sun to west": float(view.sun_cosine(HOUR)[west].max()),
    }


def _unlit_cement_walls(evidence: Evidence) -> Numbers:
    view = _winter(evidence)
    walls = view.rows(CEMENT_PLANT["IIIB"], "wall", SOUTH_WEST)
    return {
        "warmest": float(view.temperatures(HOUR)[walls].max()),
        "coldest": float(view.temperatures(HOUR)[walls].min()),
        "cosine of the sun": float(view.sun_cosine(HOUR)[walls].max()),
    }


def block_and_metal(evidence: Evidence, hour: float) -> Numbers:
    """The cement plant's left-most and right-most wall: surface, shade in the picture, and where they stand in it."""
    view = _winter(evidence)
    block, metal = (view.rows(feature, "wall", SOUTH_WEST) for feature in (BLOCK_WALL, METAL_WALL))
    others = view.rows(CEMENT_PLANT["IIIB"], "wall") & ~block & ~metal
    emissivity = view.world.assignment.emissivity
    return {
        "metal surface": view.temperature(hour, metal),
        "block surface": view.temperature(hour, block),
        "metal": view.shade("flir", hour, metal),
        "block": view.shade("flir", hour, block),
        "metal emissivity": float(emissivity[metal].mean()),
        "block emissivity": float(emissivity[block].mean()),
        "block column": view.column(hour, block),
        "metal column": view.column(hour, metal),
        "column of the others": view.column(hour, others),
    }


BLOCK_AND_METAL = partial(block_and_metal, hour=HOUR)

CLAIMS = (
    Claim(
        id="winter-sunward-walls-warmer",
        section="4.2.1",
        content="in winter walls towards the sun are significantly warmer than walls away from it",
        unit="K",
        measure=_sunward_and_averted_walls,
        relations=(more("facing the sun", than="facing away", by=SIGNIFICANT),),
    ),
    Claim(
        id="winter-hospital-south-warm-west-cold",
        section="4.2.1",
        content="the hospital's south wall is quite warm, its west wall, without direct sun, still quite cold",
        unit="K",
        measure=_hospital_south_and_west,
        relations=(
            more("south", than="west", by=SIGNIFICANT),
            more("south surface", than="air", by=SIGNIFICANT),
            more("air", than="west surface", by=-SIGNIFICANT),
            more(0.0, than="cosine of the sun to west"),
        ),
    ),
    Claim(
        id="winter-unlit-cement-walls-differ",
        section="4.2.1",
        content="the cement plant's south-west walls have no direct sun and yet noticeably different temperatures",
        unit="K",
        measure=_unlit_cement_walls,
        relations=(more("warmest", than="coldest", by=NOTICEABLE), more(0.0, than="cosine of the sun")),
    ),
    Claim(
        id="winter-metal-wall-warmer-than-block",
        section="4.2.1",
        content="the cement plant's left-most wall, block, insulates and is cold outside; the right-most, metal, lets "
        "the heat of the inside through and is warmer (as surface temperature, the report's shade)",
        unit="K",
        measure=BLOCK_AND_METAL,
        relations=(
            more("metal surface", than="block surface", by=NOTICEABLE),
            more("column of the others", than="block column"),
            more("metal column", than="column of the others"),
        ),
    ),
    Claim(
        id="winter-metal-wall-lighter-than-block",
        section="4.2.1",
        content="the same in the picture: the metal wall has a light shade, the block wall a dark one",
        unit="K",
        measure=BLOCK_AND_METAL,
        relations=(more("metal", than="block"),),
    ),
)
