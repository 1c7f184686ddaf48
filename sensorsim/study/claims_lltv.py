"""Sections IV, 4.1, 4.3 and 4.3.1 of [Report1978]: the low-light pictures, against the thermal ones and by season."""

import numpy as np

from sensorsim.study.claims_evidence import HOSPITAL, SOUTH, WEST, Evidence, View, views_by_day
from sensorsim.study.claims_model import Claim, Numbers, more

HOUR = 10.0
LIGHTER, MUCH_LIGHTER = 1.05, 2.0  # [-] ratios of radiance
SUNLIT = 0.2  # [-] cosine from which the sun counts as facing a surface


def _winter(evidence: Evidence) -> View:
    return evidence["IIIB", "winter"]


def _contrast(evidence: Evidence) -> Numbers:
    return {day: view.contrast("lltv", HOUR) for day, view in views_by_day(evidence).items()}


def _contrast_of_both_sensors(evidence: Evidence) -> Numbers:
    """Over all pictures of both sensors: the least ratio of their contrasts, and each one's range."""
    pairs = np.array([
        [view.contrast(sensor, hour) for sensor in ("lltv", "flir")]
        for view in evidence.values()
        for hour in sorted({hour for _, hour, _ in view.pictures})
    ])  # fmt: skip
    return {
        "least ratio": float(np.min(pairs[:, 0] / pairs[:, 1])),
        "least of LLLTV": float(pairs[:, 0].min()),
        "greatest of FLIR": float(pairs[:, 1].max()),
    }


def _beam_and_sky(evidence: Evidence) -> Numbers:
    """In-band irradiance by the sun, normal to it, and by the sky, on the horizontal."""
    numbers = {}
    for day, view in views_by_day(evidence).items():
        sample = view.world.environment.at(HOUR * 3600.0)
        numbers[f"{day} sun"] = sample.nir_beam
        numbers[f"{day} sky"] = float(sample.nir_quadrant.sum())
    return numbers


def _sunlit_and_averted(evidence: Evidence) -> Numbers:
    """Visible building walls towards the sun and away from it."""
    numbers = {}
    for day, view in views_by_day(evidence).items():
        walls, cosine = view.building_walls(), view.sun_cosine(HOUR)
        numbers[f"{day} facing"] = view.shade("lltv", HOUR, walls & (cosine > SUNLIT))
        numbers[f"{day} averted"] = view.shade("lltv", HOUR, walls & (cosine <= 0.0))
        numbers[f"{day} ratio"] = numbers[f"{day} facing"] / numbers[f"{day} averted"]
    return numbers


def _hospital(evidence: Evidence) -> Numbers:
    view = _winter(evidence)
    south, west = (view.rows(HOSPITAL["IIIB"], "wall", azimuth) for azimuth in (SOUTH, WEST))
    return {"south": view.shade("lltv", HOUR, south), "west": view.shade("lltv", HOUR, west)}


def _overall_shade(evidence: Evidence) -> Numbers:
    numbers = {day: view.shade("lltv", HOUR) for day, view in views_by_day(evidence).items()}
    for day, view in views_by_day(evidence).items():
        sample = view.world.environment.at(HOUR * 3600.0)
        height = float(sample.sun_direction[2])
        numbers[f"{day} irradiance"] = sample.nir_beam * height + float(sample.nir_quadrant.sum())
    return numbers


def _sky_shade(evidence: Evidence) -> Numbers:
    numbers = {}
    for day, view in views_by_day(evidence).items():
        planes = view.pictures["lltv", HOUR, "tower"].planes
        numbers[day] = float(planes["radiance"][planes["surface_id"] < 0].mean())
    return numbers


CLAIMS = (
    Claim(
        id="lltv-winter-best-contrast",
        section="IV",
        content="of the three days, the winter day gives the pictures with the best contrast (low-light pictures)",
        unit="-",
        measure=_contrast,
        relations=(more("winter", than="summer", times=1.5), more("winter", than="fall", times=1.5)),
    ),
    Claim(
        id="lltv-winter-hospital-tells-sun",
        section="4.1",
        content="as in the real picture of a clear cool day, the hospital's walls towards the observer tell clearly "
        "where the sun is",
        unit="W m-2 sr-1",
        measure=_hospital,
        relations=(more("south", than="west", times=MUCH_LIGHTER),),
    ),
    Claim(
        id="lltv-sun-a-magnitude-above-sky",
        section="4.3",
        content="direct sunlight counts most; the sky's light is a magnitude smaller (winter)",
        unit="W m-2",
        measure=_beam_and_sky,
        relations=(more("winter sun", than="winter sky", times=10.0),),
    ),
    Claim(
        id="lltv-contrast-above-flir",
        section="4.3",
        content="low-light pictures have in general more contrast than the thermal ones",
        unit="-",
        measure=_contrast_of_both_sensors,
        relations=(more("least ratio", than=1.0),),
    ),
    Claim(
        id="lltv-winter-high-contrast",
        section="4.3.1",
        content="the sun being the main light, the winter picture has high contrast",
        unit="-",
        measure=_contrast,
        relations=(more("winter", than=0.3),),
    ),
    Claim(
        id="lltv-winter-averted-walls-darker",
        section="4.3.1",
        content="in winter surfaces away from the sun are significantly darker than those towards it",
        unit="W m-2 sr-1",
        measure=_sunlit_and_averted,
        relations=(more("winter facing", than="winter averted", times=MUCH_LIGHTER),),
    ),
    Claim(
        id="lltv-winter-hospital-south-lighter-than-west",
        section="4.3.1",
        content="in winter the hospital's south walls are lighter than its west walls",
        unit="W m-2 sr-1",
        measure=_hospital,
        relations=(more("south", than="west", times=LIGHTER),),
    ),
    Claim(
        id="lltv-summer-insensitive-to-sun",
        section="4.3.1",
        content="under the summer cloud the scene depends less on the sun's position than on a clear day",
        unit="W m-2 sr-1",
        measure=_sunlit_and_averted,
        relations=(more("winter ratio", than="summer ratio", times=2.0), more("fall ratio", than="summer ratio")),
    ),
    Claim(
        id="lltv-summer-sun-not-above-sky",
        section="4.3.1",
        content="in summer the direct light is no longer significantly above the sky's",
        unit="W m-2",
        measure=_beam_and_sky,
        relations=(more("summer sky", than="summer sun", times=0.5),),
    ),
    Claim(
        id="lltv-summer-contrast-reduced",
        section="4.3.1",
        content="the summer picture's contrast is lower for it",
        unit="-",
        measure=_contrast,
        relations=(more("winter", than="summer", times=1.5),),
    ),
    Claim(
        id="lltv-summer-darker-than-winter",
        section="4.3.1",
        content="the summer scene is less lit in all and its picture darker than on the clear winter day",
        unit="W m-2 sr-1",
        measure=_overall_shade,
        relations=(more("winter", than="summer"), more("winter irradiance", than="summer irradiance")),
    ),
    Claim(
        id="lltv-fall-sun-between-summer-and-winter",
        section="4.3.1",
        content="the direct light of the fall day is above summer's and below winter's",
        unit="W m-2",
        measure=_beam_and_sky,
        relations=(
            more("fall sun", than="summer sun", times=LIGHTER),
            more("winter sun", than="fall sun", times=LIGHTER),
        ),
    ),
    Claim(
        id="lltv-cloudy-skies-brighter-than-winter",
        section="4.3.1",
        content="clouds spread sunlight: the sky is brighter in fall, and in summer, than on the clear winter day",
        unit="W m-2 sr-1",
        measure=_sky_shade,
        relations=(
            more("fall", than="winter", times=MUCH_LIGHTER),
            more("summer", than="winter", times=MUCH_LIGHTER),
        ),
    ),
    Claim(
        id="lltv-fall-low-contrast",
        section="4.3.1",
        content="that gives the fall picture its low contrast",
        unit="-",
        measure=_contrast,
        relations=(more("winter", than="fall", times=1.5),),
    ),
)
