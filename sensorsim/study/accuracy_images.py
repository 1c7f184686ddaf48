"""Error of pictures: frames from tables against frames of the full solve, through the same renderer.

The full solve is drawn by tables of its own: every surface is a wall type of one temperature, whatever its orientation
and reflectance.
"""

import statistics
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date

import numpy as np

from sensorsim.constants import SECONDS_PER_HOUR
from sensorsim.render import Camera, Picture, Renderer, World, station_camera
from sensorsim.sensor import Sensor
from sensorsim.study.accuracy_measure import TIMES, StudyDay
from sensorsim.tables import ShadeTables, preset
from sensorsim.tables.coefficients import lookup_orientations
from sensorsim.tables.orientations import FloatArray
from sensorsim.tables.straighten import COLUMNS, UNBENT

HOURS = (7.0, 10.0, 13.0, 17.0)  # of section IV of [Report1978]
SIZE = (640, 480)
FEWEST_PIXELS = 20  # of a surface that counts among the contrasts
ROUNDS = 9  # frames that are timed


@dataclass(frozen=True, slots=True, kw_only=True)
class ImageScore:
    """One preset's frame against the full solve's."""

    name: str
    day: date
    hour: float
    rms: float  # of apparent temperature, over pixels that see a measured surface [K]
    max: float  # [K]
    spearman: float  # correlation of the ranks of surfaces by mean apparent temperature [-]
    kendall: float  # pairs of surfaces in the right order less those in the wrong one, over all [-]
    surfaces: int  # with FEWEST_PIXELS in the frame


def look(world: World, sensor: Sensor, *, timed: bool, backend: str = "auto") -> tuple[dict[float, Picture], float]:
    """Pictures of a world at HOURS from the tower or its first camera; where `timed` the median of a frame [ms]."""
    camera, spent = _camera(world), []
    with Renderer(world, sensor, size=SIZE, backend=backend) as renderer:
        pictures = {hour: renderer.render(camera, hour * SECONDS_PER_HOUR) for hour in HOURS}
        for round_ in range(ROUNDS if timed else 0):
            begin = time.perf_counter()
            renderer.render(camera, HOURS[round_ % len(HOURS)] * SECONDS_PER_HOUR)
            spent.append(1e3 * (time.perf_counter() - begin))
    return pictures, statistics.median(spent) if spent else 0.0


def true_world(world: World, day: StudyDay, temperature: FloatArray) -> World:
    """A world whose measured surfaces have the temperatures (t, m) [K] of the full solve at TIMES."""
    plain = preset("report")  # no lobes, no splines
    orientations = lookup_orientations(plain)
    copies = (1, 1, orientations.normal.shape[0], 1)
    tables = ShadeTables(
        day=day.day,
        time_of_day=TIMES,
        wall_types=tuple(day.sample.surfaces.wall_types[row] for row in day.sample.surfaces.wall_type),
        orientations=orientations,
        coefficients=np.tile(temperature[:, :, None, None], copies).astype(np.float32),
        level=np.zeros(temperature.shape),
        loss=np.broadcast_to(UNBENT, (*temperature.shape, COLUMNS)),
        towards=np.zeros((TIMES.size, 2)),
        lobes=None,
        ground_temperature=np.interp(TIMES, world.tables.time_of_day, world.tables.ground_temperature),
        settings=plain,
        lead_in=(),
    )
    row_of = np.maximum(day.sample.row_of, 0)
    return replace(
        world, tables=tables, assignment=replace(world.assignment, wall_types=tables.wall_types, wall_type=row_of)
    )


def compare(
    name: str, day: StudyDay, pictures: Mapping[float, Picture], truth: Mapping[float, Picture]
) -> list[ImageScore]:
    """Scores of the pictures of one day, hour by hour."""
    return [_compare(name, day, hour, pictures[hour], truth[hour]) for hour in HOURS]


def _compare(name: str, day: StudyDay, hour: float, picture: Picture, truth: Picture) -> ImageScore:
    surface = truth.planes["surface_id"]
    seen = (surface >= 0) & (day.sample.row_of[np.maximum(surface, 0)] >= 0)
    shown, right = (each.planes["apparent_temperature"].astype(np.float64)[seen] for each in (picture, truth))
    count = np.bincount(surface[seen], minlength=1)
    large = count >= FEWEST_PIXELS
    means = [np.bincount(surface[seen], weights=kelvin)[large] / count[large] for kelvin in (shown, right)]
    miss = shown - right
    from scipy.stats import kendalltau, spearmanr  # take longer to load than most commands take to work

    return ImageScore(
        name=name,
        day=day.day,
        hour=hour,
        rms=float(np.sqrt(np.mean(miss**2))) if miss.size else 0.0,
        max=float(np.abs(miss).max(initial=0.0)),
        spearman=_rank(spearmanr, means),
        kendall=_rank(kendalltau, means),
        surfaces=int(large.sum()),
    )


def _rank(measure: object, means: Sequence[FloatArray]) -> float:
    """Rank correlation of surfaces' means; 1 where fewer than two surfaces, or all alike, leave no order to miss."""
    if means[0].size < 2 or any(np.ptp(mean) == 0.0 for mean in means):
        return 1.0
    return float(measure(*means).statistic)  # type: ignore[operator]


def _camera(world: World) -> Camera:
    names = [station.name for station in world.scene.cameras]
    return station_camera(world.scene, "tower" if "tower" in names else names[0])
