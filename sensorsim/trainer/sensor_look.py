"""One look of a renderer with the host's knobs on its sensor."""

from collections.abc import Collection, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import PI
from sensorsim.render import Camera, Illumination, Renderer
from sensorsim.render.picture import exposed
from sensorsim.render.solids import Solids
from sensorsim.trainer.host_state import SensorState
from sensorsim.trainer.sensor_knobs import WHITE, Knobs, display_settings, sensor_picture

COLDEST, WARMEST = 223.0, 343.0  # [K]: the range of level and gain in emissive bands
DARK_SHARE = 1e-6  # of the brightest radiance in reflective bands, so that the night has a range too
LEAST_BRIGHT = 1e-9  # [W m-2 sr-1]


def look(
    renderer: Renderer,
    camera: Camera,
    time_of_day: float,
    around: Illumination,
    control: SensorState,
    frame: int,
    *,
    planes: Collection[str] | None = ("display",),
    solids: Solids | None = None,
) -> Mapping[str, NDArray[Any]]:
    """Planes of the frame of that number, all for None, with display codes as the host's knobs have them."""
    knobs = sensor_range(renderer, around)
    window = replace(display_settings(control, knobs), polarity="white-hot")
    spoilt = control.ac_coupling > 0.0 or control.noise > 0.0 or control.line_dropout
    wanted = None if spoilt else planes
    seen = renderer.render(
        camera, time_of_day, display=window, illumination=around, frame=frame, planes=wanted, solids=solids
    ).planes
    if spoilt:
        codes = sensor_picture(seen.get("signal", seen["radiance"]), control, knobs, frame, seen=exposed(seen))
    else:
        codes = np.asarray(WHITE - seen["display"] if control.black_hot else seen["display"], dtype=np.uint8)
    return {**seen, "display": codes}


def sensor_range(renderer: Renderer, around: Illumination) -> Knobs:
    """What level and gain span: blackbodies in emissive bands, white under the light of the moment in others."""
    if renderer.band_table is not None:
        darkest, brightest = renderer.band_table.radiance_at((COLDEST, WARMEST))
        return Knobs(darkest=float(darkest), brightest=float(brightest))
    received = around.beam * max(float(around.sun_direction[2]), 0.0) + float(np.sum(around.quadrant))
    brightest = max(received / PI, LEAST_BRIGHT)
    return Knobs(darkest=DARK_SHARE * brightest, brightest=brightest)
