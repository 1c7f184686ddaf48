"""What a city costs: each step of its build, memory, and frames of views that see little of it, much of it and all."""

import math
import resource
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from datetime import date
from pathlib import Path
from typing import TypeVar

import numpy as np

from sensorsim.environment import read_weather
from sensorsim.render import Camera, Renderer, build_world, look_at
from sensorsim.render.tiles import Tiles, build_tiles, visible_tiles
from sensorsim.scene import load_scene
from sensorsim.sensor import Sensor
from sensorsim.study.bench_timing import measure
from sensorsim.study.city import PITCH, write_city
from sensorsim.tables import BakeSettings

DAY = date(1976, 2, 7)
MORNING = 36000.0  # [s]
Made = TypeVar("Made")
EYE = 2.0  # [m] above the street


@dataclass(frozen=True, slots=True, kw_only=True)
class Span:
    """How long a step of the build took."""

    wall: float  # [s]
    processor: float  # [s] of all threads


@dataclass(frozen=True, slots=True, kw_only=True)
class CityView:
    """One view: what it draws and what a frame for display alone costs."""

    triangles: int  # in tiles that may be in the picture
    tiles: int
    frame_ms: float  # median
    processor_ms: float


@dataclass(frozen=True, slots=True, kw_only=True)
class CityBench:
    """Figures of one city."""

    buildings: int
    surfaces: int
    triangles: int
    tiles: int
    renderer: str
    size: tuple[int, int]
    build: dict[str, Span]
    peak_mib: float  # of the process, at its end
    views: dict[str, CityView]

    def to_dict(self) -> dict[str, object]:
        """As plain values."""
        return asdict(self)


def city_views(buildings: int) -> dict[str, Camera]:
    """Cameras from which ever more of such a city is seen."""
    across = math.ceil(math.sqrt(buildings))
    side, street = across * PITCH, (across // 2 - 0.5 * across) * PITCH
    return {
        "outward": look_at([0.0, 0.5 * side, 60.0], [0.0, side, 60.0], 40.0),
        "down": look_at([0.0, -1.0, 400.0], [0.0, 0.0, 0.0], 40.0),
        "oblique": look_at([0.0, 0.0, 250.0], [300.0, 300.0, 0.0], 40.0),
        "street": look_at([street, 0.0, EYE], [street, 100.0, EYE], 40.0),
        "far": look_at([-0.9 * side, -0.9 * side, 0.4 * side], [0.0, 0.0, 0.0], 70.0),
    }


def run_city(
    buildings: int, sensor: Sensor, folder: Path, *, size: tuple[int, int], frames: int, settings: BakeSettings,
    backend: str = "auto",
) -> CityBench:  # fmt: skip
    """Build a city in `folder`, through the same files and steps as any scene, and draw it."""
    path, build = folder / f"city_{buildings}.geojson", dict[str, Span]()
    _timed(build, "write", lambda: write_city(path, buildings))
    scene = _timed(build, "load", lambda: load_scene(path))
    world = _timed(build, "bake", lambda: build_world(scene, read_weather("winter"), image_day=DAY, settings=settings))
    renderer = _timed(build, "renderer", lambda: Renderer(world, sensor, size=size, backend=backend))
    triangles = len(scene.mesh.triangle)
    tiles = build_tiles(scene.mesh, np.zeros(triangles))
    with renderer:
        cameras = city_views(buildings)
        _timed(build, "first frame", _frame(renderer, cameras["street"]))
        views = {name: _view(renderer, camera, tiles, frames) for name, camera in cameras.items()}
        drawn_by = str(renderer.ctx.info["GL_RENDERER"])
    return CityBench(
        buildings=buildings,
        surfaces=scene.surfaces.area.size,
        triangles=triangles,
        tiles=len(tiles.is_wide),
        renderer=drawn_by,
        size=size,
        build=build,
        peak_mib=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0,
        views=views,
    )


def _timed(spans: dict[str, Span], name: str, make: Callable[[], Made]) -> Made:
    """What `make` makes; how long it took goes into `spans`."""
    wall, processor = time.perf_counter(), time.process_time()
    made = make()
    spans[name] = Span(wall=time.perf_counter() - wall, processor=time.process_time() - processor)
    return made


def _view(renderer: Renderer, camera: Camera, tiles: Tiles, frames: int) -> CityView:
    seen = visible_tiles(tiles, camera, renderer.size)
    taken = measure({"frame": _frame(renderer, camera)}, frames)["frame"]
    triangles = int(np.sum(tiles.edge[seen + 1] - tiles.edge[seen]))
    return CityView(triangles=triangles, tiles=int(seen.size), frame_ms=taken.wall, processor_ms=taken.processor)


def _frame(renderer: Renderer, camera: Camera) -> Callable[[], object]:
    """A frame for display alone, the clock standing: what is left goes with what is seen."""
    return lambda: renderer.render(camera, MORNING, planes=("display",))
