"""What a frame costs: its stages, against one colour on the same triangles and against others, and what it grows with.

A frame is one for display alone, its clock a minute on from the last: surroundings found, numbers of surfaces drawn and
read back, their light through the air, the sensor, window and display. Wall times depend on what else the machine does,
so the processor's time stands beside them, and all that is compared takes turns.
"""

from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import partial
from itertools import count
from time import perf_counter

import numpy as np

from sensorsim.render import Camera, ConstantColour, Renderer, World
from sensorsim.sensor import Sensor
from sensorsim.study.bench_peers import peer_times
from sensorsim.study.bench_timing import measure
from sensorsim.study.bench_worlds import with_surfaces, with_triangles, with_wall_types

MORNING = 36000.0  # [s]
TIMES = (1, 2, 4)  # how many times as much
PIXELS = ((1, 2), (1, 1), (2, 1))  # shares of the sides
STAGES = ("moment", "draw", "read-back", "light", "sensor", "window", "display")


@dataclass(frozen=True, slots=True, kw_only=True)
class Bench:
    """Medians [ms]; processor times are of all threads."""

    scene: str
    sensor: str
    renderer: str
    size: tuple[int, int]
    triangles: int
    surfaces: int
    wall_types: int
    frame_ms: float
    processor_ms: float
    frames_per_second: float
    constant_colour_ms: float
    constant_colour_processor_ms: float
    ratio_constant_colour: float
    ratio_processor: float
    stages_ms: dict[str, float]
    peers: dict[str, dict[str, float] | str]
    growth: dict[str, list[dict[str, float]]]

    def to_dict(self) -> dict[str, object]:
        """As plain values."""
        return asdict(self)


def run_bench(
    world: World, sensor: Sensor, camera: Camera, *,
    size: tuple[int, int], frames: int, peers: bool, growth: bool, backend: str = "auto",
) -> Bench:  # fmt: skip
    """Measure frames of a world through a camera; `peers` and `growth` cost more than the rest."""
    scene = world.scene
    times: dict[str, list[float]] = {stage: [] for stage in STAGES}
    with Renderer(world, sensor, size=size, backend=backend) as renderer:
        plain = ConstantColour(scene.mesh, size, backend=backend)
        work = {"frame": _watched(renderer, camera, times), "constant colour": lambda: plain.render(camera)}
        taken = measure(work, frames)
        plain.release()
        named = str(renderer.ctx.info["GL_RENDERER"])
    frame, floor = taken["frame"], taken["constant colour"]
    return Bench(
        scene=f"{scene.name} {scene.level}".strip(),
        sensor=sensor.name,
        renderer=named,
        size=size,
        triangles=len(scene.mesh.triangle),
        surfaces=scene.surfaces.area.size,
        wall_types=len(world.tables.wall_types),
        frame_ms=frame.wall,
        processor_ms=frame.processor,
        frames_per_second=1e3 / frame.wall,
        constant_colour_ms=floor.wall,
        constant_colour_processor_ms=floor.processor,
        ratio_constant_colour=frame.wall / floor.wall,
        ratio_processor=frame.processor / floor.processor,
        stages_ms={stage: float(1e3 * np.median(spans[-frames:])) for stage, spans in times.items()},
        peers=peer_times(scene.mesh, camera, size, frames) if peers else {},
        growth=_growth(world, sensor, camera, size, frames, backend) if growth else {},
    )


def _frames(renderer: Renderer, camera: Camera) -> Callable[[], object]:
    """One frame after the other."""
    number = count()

    def frame() -> object:
        index = next(number)
        return renderer.render(camera, MORNING + 60.0 * (index % 60), frame=index, planes=("display",))

    return frame


def _watched(renderer: Renderer, camera: Camera, times: dict[str, list[float]]) -> Callable[[], object]:
    """The same, with the span of each stage [s] appended to `times`."""
    draw, last = _frames(renderer, camera), [0.0]

    def watch(stage: str) -> None:
        if stage == "draw":
            renderer.ctx.finish()  # what drawing costs shall not fall to the read-back
        now = perf_counter()
        times[stage].append(now - last[0])
        last[0] = now

    def frame() -> object:
        last[0] = perf_counter()
        return draw()

    renderer.watch = watch
    return frame


def _growth(
    world: World, sensor: Sensor, camera: Camera, size: tuple[int, int], frames: int, backend: str
) -> dict[str, list[dict[str, float]]]:
    """Frame times [ms] with more pixels, triangles, surfaces and wall types, one at a time."""
    timed = partial(_timed, sensor=sensor, camera=camera, frames=frames, backend=backend)
    sizes = [tuple(max(1, side * up // down) for side in size) for up, down in PIXELS]
    scene, walls = world.scene, len(world.tables.wall_types)
    return {
        "pixels": [{"count": w * h, **timed(world, size=(w, h))} for w, h in sizes],
        "triangles": [
            {"count": n * len(scene.mesh.triangle), **timed(with_triangles(world, n), size=size)} for n in TIMES
        ],
        "surfaces": [
            {"count": n * scene.surfaces.area.size, **timed(with_surfaces(world, n), size=size)} for n in TIMES
        ],
        "wall_types": [{"count": n * walls, **timed(with_wall_types(world, n), size=size)} for n in TIMES],
    }


def _timed(
    world: World, *, sensor: Sensor, camera: Camera, size: tuple[int, int], frames: int, backend: str
) -> dict[str, float]:
    with Renderer(world, sensor, size=size, backend=backend) as renderer:
        taken = measure({"frame": _frames(renderer, camera)}, frames)["frame"]
    return {"frame_ms": taken.wall, "processor_ms": taken.processor}
