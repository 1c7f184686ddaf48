"""Sections IV, 4.1 and 4.2.1 of [Report1978]: the thermal pictures of the three days at 10 h, side by side."""

import numpy as np

from sensorsim.study.claims_evidence import EAST, HOSPITAL, NORTH, SOUTH, WEST, Evidence, views_by_day
from sensorsim.study.claims_model import NOTICEABLE, SIGNIFICANT, UNIFORM, Claim, Numbers, more

HOUR = 10.0


def _picture_spread(evidence: Evidence) -> Numbers:
    views = views_by_day(evidence)
    numbers = {day: view.spread("flir", HOUR) for day, view in views.items()}
    return numbers | {f"{day} walls": view.spread("flir", HOUR, view.building_walls()) for day, view in views.items()}


def _walls_of_figure_19c(evidence: Evidence) -> Numbers:
    view = evidence["IIIB", "fall"]
    return {
        "wall spread": view.spread("flir", HOUR, view.building_walls()),
        "walls": view.shade("flir", HOUR, view.building_walls()),
        "all surfaces": view.shade("flir", HOUR),
    }


def _range_over_sides(evidence: Evidence) -> Numbers:
    """Warmest less coldest of the hospital's four sides."""
    ranges = {}
    for day, view in views_by_day(evidence).items():
        sides = [view.rows(HOSPITAL["IIIB"], "wall", azimuth) for azimuth in (NORTH, EAST, SOUTH, WEST)]
        ranges[day] = float(np.ptp([view.temperature(HOUR, rows) for rows in sides]))
    return ranges


def _wall_spread(evidence: Evidence) -> Numbers:
    return {day: view.spread("flir", HOUR, view.building_walls()) for day, view in views_by_day(evidence).items()}


def _diffuse_light(evidence: Evidence) -> Numbers:
    views = views_by_day(evidence)
    return {
        day: float(view.world.environment.at(HOUR * 3600.0).quadrant_irradiance.sum()) for day, view in views.items()
    }


def _roofs_and_walls(evidence: Evidence) -> Numbers:
    numbers = {}
    for day, view in views_by_day(evidence).items():
        roofs = view.rows(role="roof") & (view.world.scene.surfaces.interior != "none")
        numbers[f"{day} roofs"] = view.shade("flir", HOUR, roofs)
        numbers[f"{day} walls"] = view.shade("flir", HOUR, view.building_walls())
        numbers[f"{day} difference"] = abs(numbers[f"{day} roofs"] - numbers[f"{day} walls"])
    return numbers


def _overall_shade(evidence: Evidence) -> Numbers:
    return {day: view.shade("flir", HOUR) for day, view in views_by_day(evidence).items()}


def _wall_shade(evidence: Evidence) -> Numbers:
    views = views_by_day(evidence)
    numbers = {day: view.shade("flir", HOUR, view.building_walls()) for day, view in views.items()}
    air = {f"{day} air": view.world.environment.at(HOUR * 3600.0).air_temperature for day, view in views.items()}
    return numbers | air


CLAIMS = (
    Claim(
        id="flir-winter-best-contrast",
        section="IV",
        content="of the three days, the winter day gives the pictures with the best contrast (thermal pictures)",
        unit="K",
        measure=_picture_spread,
        relations=(more("winter", than="summer"), more("winter", than="fall")),
        reason="Walls do stand out most in winter. The whole picture does not: in the fall day's sun and still air "
        "roofs and grass part from walls, trees and streets by more than the windy winter day lets them. The overcast "
        "summer day draws about level with it.",
        instead=(
            more("fall", than="winter", by=NOTICEABLE),
            more("winter", than="summer", by=-NOTICEABLE),
            more("winter walls", than="summer walls", by=NOTICEABLE),
            more("winter walls", than="fall walls", by=NOTICEABLE),
        ),
    ),
    Claim(
        id="flir-walls-bright-and-uniform",
        section="4.1",
        content="the simulated thermal picture (figure 19c) has all walls quite bright and of one shade",
        unit="K",
        measure=_walls_of_figure_19c,
        relations=(more(UNIFORM, than="wall spread"), more("walls", than="all surfaces")),
        reason="Under the fall day's partial sun the walls differ with their direction, and ground and roofs in still "
        "air are warmer than walls. For the clear day the report's own section 4.2.1 says the contrary.",
        instead=(more("wall spread", than=UNIFORM), more("all surfaces", than="walls", by=SIGNIFICANT)),
    ),
    Claim(
        id="winter-walls-most-sensitive-to-sun",
        section="4.2.1",
        content="in winter the walls depend more on the sun's position than on the other two days",
        unit="K",
        measure=_range_over_sides,
        relations=(more("winter", than="summer", by=SIGNIFICANT), more("winter", than="fall", by=NOTICEABLE)),
    ),
    Claim(
        id="summer-walls-insensitive-to-sun",
        section="4.2.1",
        content="under the summer cloud the walls depend far less on the sun's position than in winter",
        unit="K",
        measure=_range_over_sides,
        relations=(more("winter", than="summer", times=2.0),),
    ),
    Claim(
        id="summer-walls-uniform",
        section="4.2.1",
        content="all walls have fairly one shade in summer",
        unit="K",
        measure=_wall_spread,
        relations=(more(UNIFORM, than="summer"), more("winter", than="summer", times=2.0)),
    ),
    Claim(
        id="summer-diffuse-light-above-winter",
        section="4.2.1",
        content="the sky's diffuse sunlight is stronger in summer than in winter",
        unit="W m-2",
        measure=_diffuse_light,
        relations=(more("summer", than="winter", times=1.5),),
    ),
    Claim(
        id="summer-roofs-warmer-than-walls",
        section="4.2.1",
        content="in summer roofs are significantly warmer than walls",
        unit="K",
        measure=_roofs_and_walls,
        relations=(more("summer roofs", than="summer walls", by=SIGNIFICANT),),
    ),
    Claim(
        id="summer-roof-wall-difference-above-winter",
        section="4.2.1",
        content="roofs and walls differ more in summer than in winter",
        unit="K",
        measure=_roofs_and_walls,
        relations=(more("summer difference", than="winter difference", by=NOTICEABLE),),
    ),
    Claim(
        id="summer-warmest-of-the-three",
        section="4.2.1",
        content="summer is warmer than fall and winter all over: its picture is the brightest",
        unit="K",
        measure=_overall_shade,
        relations=(more("summer", than="fall"), more("summer", than="winter", by=SIGNIFICANT)),
    ),
    Claim(
        id="fall-walls-cooler-than-summer",
        section="4.2.1",
        content="the fall air is slightly cooler than in summer, and so are the walls in general",
        unit="K",
        measure=_wall_shade,
        relations=(more("summer air", than="fall air"), more("summer", than="fall", by=NOTICEABLE)),
    ),
    Claim(
        id="fall-warmer-than-winter",
        section="4.2.1",
        content="walls in fall are still warmer than in winter",
        unit="K",
        measure=_wall_shade,
        relations=(more("fall", than="winter", by=SIGNIFICANT),),
    ),
)
