"""Pictures of one look with an effect on and off, everything else the same.

Worlds are kept while the cases are drawn: what one kind of weather has baked serves all of its cases, an effect of the
surface takes one more bake, an effect of the frame none.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from sensorsim.effects import EFFECTS, FRAME, EffectChoice
from sensorsim.radiometry import build_band_table
from sensorsim.render import Camera, Picture, Renderer, World, build_world, look_at, station_camera
from sensorsim.scene import Scene, load_scene
from sensorsim.sensor import Sensor, load_sensor
from sensorsim.study.effects_cases import Case, all_cases
from sensorsim.study.effects_sensors import study_sensor
from sensorsim.study.effects_weather import study_weather
from sensorsim.tables import BakeSettings

FloatArray = NDArray[np.float64]
Progress = Callable[[str, int, int], None]
SPARE = frozenset({"spare_orientations", "spare_reflectances"})
MIRRORED = ("behind", "into the sun")  # the hospital from its other side, and with the horizon in the middle
OF_FRAMES = frozenset(effect.name for effect in EFFECTS if effect.stage == FRAME)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Pair:
    """A case with its pictures (height, width) in apparent temperature [K] or band radiance [W m-2 sr-1]."""

    case: Case
    words: str  # of the weather
    unit: str
    on: FloatArray
    off: FloatArray
    surface: NDArray[np.bool_]  # where a surface is seen
    bound: float | None  # [unit] of the change by the ledger, where it tells one in this unit

    @property
    def change(self) -> FloatArray:
        """On less off."""
        return self.on - self.off

    @property
    def greatest(self) -> float:
        """Greatest change of a pixel."""
        return float(np.abs(self.change).max())

    @property
    def rms(self) -> float:
        """Root mean square of the change over the picture."""
        return float(np.sqrt(np.mean(np.square(self.change))))


def take_pairs(
    *, settings: BakeSettings | None = None, size: tuple[int, int] = (320, 240), backend: str = "auto",
    progress: Progress | None = None, cases: Sequence[Case] | None = None,
) -> Iterator[Pair]:  # fmt: skip
    """One pair for each case, in their order."""
    chosen = BakeSettings() if settings is None else settings
    scene = load_scene("hospital", level="IIIB")

    @cache
    def world(weather: str, sky: str, mode: str, choice: EffectChoice) -> World:
        series, day, _ = study_weather(weather)
        sensor = load_sensor("flir" if mode == "emissive" else "lltv")
        return build_world(
            scene, series, image_day=day, settings=replace(chosen, sky=sky), effects=choice, sensor=sensor
        )

    shown = all_cases() if cases is None else cases
    for done, case in enumerate(shown):
        if progress is not None:
            progress(f"{case.effect}, {case.sensor}", done, len(shown))
        sensor = study_sensor(case.sensor)
        on, off = _choices(case.effect, sensor)
        whole = world(case.weather, case.sky, sensor.mode, on)
        if case.effect in OF_FRAMES:
            left = replace(whole, choice=off)
        else:
            left = world(case.weather, case.sky, sensor.mode, off)
        yield _pair(case, sensor, *(_look(one, case, sensor, size, backend) for one in (whole, left)))


def _choices(effect: str, sensor: Sensor) -> tuple[EffectChoice, EffectChoice]:
    """All effects, and all but one; light needs no temperatures."""
    base = EffectChoice(base="all", refused=SPARE | ({"temperature"} if sensor.mode == "reflective" else set()))
    return (base.with_wanted(effect), base) if effect == "exchange" else (base, base.with_refused(effect))


def _look(world: World, case: Case, sensor: Sensor, size: tuple[int, int], backend: str) -> Picture:
    """The second of two frames, after which the camera has turned."""
    camera = _camera(world.scene, case.camera, sensor, size)
    before = replace(camera, yaw=camera.yaw - case.turn)
    with Renderer(world, sensor, size=size, backend=backend) as renderer:
        if case.turn:
            renderer.render(before, case.hour * 3600.0, frame=0)
        return renderer.render(camera, case.hour * 3600.0, frame=1)


def _camera(scene: Scene, name: str, sensor: Sensor, size: tuple[int, int]) -> Camera:
    """A camera of the scene; a detector's picture is cut to its own pixels, so that each is as large as it has them."""
    camera = station_camera(scene, "hospital" if name in MIRRORED else name)
    if sensor.detector is not None:
        field = min(sensor.horizontal_field_of_view * size[0] / sensor.size[0], 90.0)
        camera = replace(camera, horizontal_field_of_view=field)
    camera = _mirrored(camera) if name in MIRRORED else camera
    return replace(camera, pitch=0.0) if name == "into the sun" else camera


def _mirrored(camera: Camera) -> Camera:
    """The camera on the other side of the place on the ground that it looks at."""
    forward, _, _ = camera.axes()
    target = camera.position - forward * camera.position[2] / forward[2]
    across = 2.0 * target - camera.position
    across[2] = camera.position[2]
    return look_at(across, target, camera.horizontal_field_of_view)


def _pair(case: Case, sensor: Sensor, on: Picture, off: Picture) -> Pair:
    table = build_band_table(sensor.band) if sensor.mode == "emissive" else None
    unit = "W m-2 sr-1" if table is None else "K"

    def shown(picture: Picture) -> FloatArray:
        seen = np.asarray(picture.planes.get("signal", picture.planes["radiance"]), dtype=np.float64)
        # Noise may leave the table: its ends stand for what is beyond.
        return seen if table is None else np.interp(seen, table.radiance, table.temperature)

    rows = [] if off.ledger is None else [row for row in off.ledger.rows if row.effect == case.effect]
    return Pair(
        case=case, words=study_weather(case.weather)[2], unit=unit, on=shown(on), off=shown(off),
        surface=on.planes["surface_id"] >= 0,
        bound=rows[0].bound if rows and rows[0].unit == unit else None,
    )  # fmt: skip
