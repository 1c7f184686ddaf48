"""Section 4.3.2 of [Report1978]: the low-light pictures of the winter day at 7, 10, 13 and 16 h."""

from functools import partial

import numpy as np

from sensorsim.study.claims_evidence import CEMENT_PLANT, EAST, HOSPITAL, SOUTH, SOUTH_WEST, WEST, Evidence, View
from sensorsim.study.claims_lltv import LIGHTER, MUCH_LIGHTER
from sensorsim.study.claims_model import Claim, Numbers, more

HOURS = (7.0, 10.0, 13.0, 16.0)
ALIKE = 1.25  # [-] ratio of radiance up to which walls count as alike


def _view(evidence: Evidence) -> View:
    return evidence["IIIB", "winter"]


def _washout(evidence: Evidence) -> Numbers:
    """Contrasts through the day, and what the direction of the hospital's walls makes of their shade."""
    view = _view(evidence)
    numbers = {f"contrast at {hour:g} h": view.contrast("lltv", hour) for hour in HOURS}
    south, west = (view.rows(HOSPITAL["IIIB"], "wall", azimuth) for azimuth in (SOUTH, WEST))
    for hour in (7.0, 10.0):
        numbers[f"south over west at {hour:g} h"] = view.shade("lltv", hour, south) / view.shade("lltv", hour, west)
    return numbers | {"elevation of the sun at 7 h": view.world.environment.at(25200.0).sun_elevation}


def _hospital(evidence: Evidence, hour: float) -> Numbers:
    """The hospital's walls: south and west from the tower, east and west alike from their own sides."""
    view = _view(evidence)
    rows = {side: view.rows(HOSPITAL["IIIB"], "wall", azimuth) for side, azimuth in _SIDES.items()}
    numbers = {side: view.shade("lltv", hour, rows[side]) for side in ("south", "west")}
    numbers["east"] = view.shade("lltv", hour, rows["east"], camera="behind")
    cosine = view.sun_cosine(hour)
    return numbers | {f"cosine of the sun to {side}": float(cosine[walls].mean()) for side, walls in rows.items()}


def _hospital_upper_section(evidence: Evidence) -> Numbers:
    """The two visible sides of the walls that rise highest."""
    view = _view(evidence)
    surfaces, mesh = view.world.scene.surfaces, view.world.scene.mesh
    top = np.zeros(surfaces.area.size)
    np.maximum.at(top, mesh.surface, mesh.position[:, 2])
    walls = view.rows(HOSPITAL["IIIB"], "wall")
    upper = walls & (top > top[walls].max() - 0.1)
    south, west = (upper & view.rows(azimuth=azimuth) for azimuth in (SOUTH, WEST))
    return {"south": view.shade("lltv", 10.0, south), "west": view.shade("lltv", 10.0, west)}


def _cement_walls(evidence: Evidence) -> Numbers:
    """The cement plant's south-west walls through the day."""
    view = _view(evidence)
    walls = view.rows(CEMENT_PLANT["IIIB"], "wall", SOUTH_WEST)
    numbers = {f"{hour:g} h": view.shade("lltv", hour, walls) for hour in HOURS}
    cosines = {f"cosine of the sun at {hour:g} h": float(view.sun_cosine(hour)[walls].mean()) for hour in HOURS}
    return numbers | cosines


def _through_the_day(evidence: Evidence, role: str) -> Numbers:
    """Shades through the day of the hospital's south walls ('wall') or of all planes and roofs ('flat')."""
    view = _view(evidence)
    south = view.rows(HOSPITAL["IIIB"], "wall", SOUTH)
    rows = south if role == "wall" else view.rows(role="plane") | view.rows(role="roof")
    return {f"{hour:g} h": view.shade("lltv", hour, rows) for hour in HOURS}


def _light_of_the_day(evidence: Evidence) -> Numbers:
    """Irradiance of the horizontal in the band, and the sun's elevation [deg], through the day."""
    view = _view(evidence)
    numbers = {}
    for hour in HOURS:
        sample = view.world.environment.at(hour * 3600.0)
        height = max(float(sample.sun_direction[2]), 0.0)
        numbers[f"light at {hour:g} h"] = sample.nir_beam * height + float(sample.nir_quadrant.sum())
        numbers[f"elevation at {hour:g} h"] = sample.sun_elevation
    return numbers


_SIDES = {"south": SOUTH, "west": WEST, "east": EAST}

CLAIMS = (
    Claim(
        id="lltv-7h-washed-out",
        section="4.3.2",
        content="at 7 h, before sunrise, only the sky gives light: surfaces have much the same shades, the picture is "
        "washed out",
        unit="-",
        measure=_washout,
        relations=(
            more(0.0, than="elevation of the sun at 7 h"),
            *(more(f"contrast at {hour} h", than="contrast at 7 h", times=1.5) for hour in (10, 13, 16)),
            more(ALIKE, than="south over west at 7 h"),
            more("south over west at 7 h", than=1.0 / ALIKE),
        ),
    ),
    Claim(
        id="lltv-10h-upper-hospital-tells-sun",
        section="4.3.2",
        content="at 10 h the walls of the hospital's upper section tell clearly where the sun is",
        unit="W m-2 sr-1",
        measure=_hospital_upper_section,
        relations=(more("south", than="west", times=MUCH_LIGHTER),),
    ),
    Claim(
        id="lltv-10h-east-brighter-than-west",
        section="4.3.2",
        content="at 10 h surfaces facing east are substantially brighter than those facing west",
        unit="W m-2 sr-1",
        measure=partial(_hospital, hour=10.0),
        relations=(more("east", than="west", times=MUCH_LIGHTER),),
    ),
    Claim(
        id="lltv-10h-cement-walls-unlit",
        section="4.3.2",
        content="the cement plant's south-west walls face too far west to be lit at 10 h",
        unit="W m-2 sr-1",
        measure=_cement_walls,
        relations=(more(0.0, than="cosine of the sun at 10 h"), more("13 h", than="10 h", times=MUCH_LIGHTER)),
    ),
    Claim(
        id="lltv-13h-most-light",
        section="4.3.2",
        content="at 13 h the sun is at its highest and gives the most light",
        unit="W m-2",
        measure=_light_of_the_day,
        relations=tuple(
            more(f"{what} at 13 h", than=f"{what} at {hour} h")
            for what in ("light", "elevation")
            for hour in (7, 10, 16)
        ),
    ),
    Claim(
        id="lltv-13h-hospital-south-lightest-of-day",
        section="4.3.2",
        content="the hospital's south walls are at their lightest of the day at 13 h",
        unit="W m-2 sr-1",
        measure=partial(_through_the_day, role="wall"),
        relations=tuple(more("13 h", than=f"{hour} h", times=LIGHTER) for hour in (7, 10, 16)),
    ),
    Claim(
        id="lltv-13h-horizontal-lightest-of-day",
        section="4.3.2",
        content="so are all surfaces parallel to the ground",
        unit="W m-2 sr-1",
        measure=partial(_through_the_day, role="flat"),
        relations=tuple(more("13 h", than=f"{hour} h", times=LIGHTER) for hour in (7, 10, 16)),
    ),
    Claim(
        id="lltv-13h-cement-walls-lit",
        section="4.3.2",
        content="by 13 h the sun lights the cement plant's south-west walls",
        unit="W m-2 sr-1",
        measure=_cement_walls,
        relations=(more("cosine of the sun at 13 h", than=0.0), more("13 h", than="10 h", times=MUCH_LIGHTER)),
    ),
    Claim(
        id="lltv-13h-hospital-west-lit",
        section="4.3.2",
        content="by 13 h the sun also lights the hospital's west walls",
        unit="W m-2 sr-1",
        measure=partial(_hospital, hour=13.0),
        relations=(more("cosine of the sun to west", than=0.0), more(0.0, than="cosine of the sun to east")),
    ),
    Claim(
        id="lltv-16h-cement-walls-face-sun",
        section="4.3.2",
        content="at 16 h the cement plant's south-west walls almost face the sun and are at their brightest of the day",
        unit="W m-2 sr-1",
        measure=_cement_walls,
        relations=(
            more("cosine of the sun at 16 h", than=0.9),
            *(more("16 h", than=f"{hour} h", times=LIGHTER) for hour in (7, 10, 13)),
        ),
    ),
    Claim(
        id="lltv-16h-hospital-south-below-west",
        section="4.3.2",
        content="at 16 h the hospital's south walls are lit less than its west walls",
        unit="W m-2 sr-1",
        measure=partial(_hospital, hour=16.0),
        relations=(
            more("west", than="south", times=LIGHTER),
            more("cosine of the sun to west", than="cosine of the sun to south"),
        ),
    ),
    Claim(
        id="lltv-hospital-reversed-from-10h-to-16h",
        section="4.3.2",
        content="the hospital's walls change places between 10 and 16 h",
        unit="W m-2 sr-1",
        measure=lambda evidence: {
            f"{side} at {hour:g} h": _hospital(evidence, hour)[side] for hour in (10.0, 16.0) for side in _SIDES
        },
        relations=(
            more("south at 10 h", than="west at 10 h", times=LIGHTER),
            more("west at 16 h", than="south at 16 h", times=LIGHTER),
            more("east at 10 h", than="west at 10 h", times=LIGHTER),
            more("west at 16 h", than="east at 16 h", times=LIGHTER),
        ),
    ),
)
