"""The pictures of section IV of [Report1978], figures 19 and 21 to 27, as labelled contact sheets, by any sensors.

Frames of one figure share one display window, so that brighter means warmer across the sheet. At 7 h the low-light
picture would be black in the window of the day and has its own gain, as the set's automatic gain would have given it.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import Any

import imageio.v3 as imageio
import numpy as np
from numpy.typing import NDArray

from sensorsim.effects import EffectChoice
from sensorsim.environment import read_weather
from sensorsim.errors import InputError
from sensorsim.frames import ScaleBar, contact_sheet, radiance_scale, temperature_scale
from sensorsim.radiometry import build_band_table
from sensorsim.render import EVERY_EFFECT, Picture, Renderer, World, build_world, station_camera
from sensorsim.scene import load_scene
from sensorsim.sensor import DisplaySettings, Sensor, auto_window, display_code, load_sensor, sampled_surfaces
from sensorsim.tables import BakeSettings

WINTER, SUMMER, FALL = date(1976, 2, 7), date(1976, 9, 3), date(1976, 10, 7)
DARK = 0.02  # a frame whose brightest part is below this share of the brightest frame gets its own gain
Progress = Callable[[str, int, int], None]
Pictures = dict[tuple[str, str, date, float], Picture]


@dataclass(frozen=True, slots=True, kw_only=True)
class Figure:
    """One figure: level, sensor of the report, and the moments that it shows."""

    number: int
    title: str  # what is said of the moments
    level: str
    sensor: str
    moments: tuple[tuple[date, float], ...]  # day, hour


def _diurnal(number: int, level: str, sensor: str, evening: float) -> Figure:
    return Figure(
        number=number,
        title="7 February 1976 through the day",
        level=level,
        sensor=sensor,
        moments=tuple((WINTER, hour) for hour in (7.0, 10.0, 13.0, evening)),
    )


def _seasonal(number: int, sensor: str) -> Figure:
    moments = ((WINTER, 10.0), (SUMMER, 10.0), (FALL, 10.0))
    return Figure(number=number, title="winter, summer and fall at 10 h", level="IIIB", sensor=sensor, moments=moments)


FIGURES = (
    _seasonal(19, "flir"),
    _diurnal(21, "IIIB", "flir", 17.0),
    _diurnal(22, "IA", "flir", 17.0),
    _diurnal(23, "IIA", "flir", 17.0),
    _seasonal(24, "lltv"),
    _diurnal(25, "IIIB", "lltv", 16.0),
    _diurnal(26, "IA", "lltv", 16.0),
    _diurnal(27, "IIA", "lltv", 16.0),
)


def make_gallery(
    folder: Path,
    *,
    size: tuple[int, int] = (480, 360),
    settings: BakeSettings | None = None,
    backend: str = "auto",
    progress: Progress | None = None,
    effects: EffectChoice = EVERY_EFFECT,
    sensors: Sequence[Sensor] = (),
) -> list[Path]:
    """Draw all figures into `folder`; returns the sheets in the order of the figures.

    `sensors` take the place of those of the report: an emissive one of its FLIR, a reflective one of its LLLTV. Of one
    with a detector the radiance that reaches it, without blur or noise, stands above what it reports, in the same
    window, and what it displays with the gain of each frame.
    """
    folder.mkdir(parents=True, exist_ok=True)
    chosen = _in_place(sensors)
    pictures: Pictures = {}
    wanted = sorted({(figure.level, day) for figure in FIGURES for day, _ in figure.moments})
    for done, (level, day) in enumerate(wanted):
        if progress is not None:
            progress(f"level {level}, {day}", done, len(wanted))
        world = build_world(
            load_scene("hospital", level=level), read_weather(day.isoformat()), image_day=day, settings=settings,
            effects=effects, sensor=chosen["flir"],
        )  # fmt: skip
        for kind, sensor in chosen.items():
            pictures |= _look(world, sensor, (level, kind, day), size, backend)
    if progress is not None:
        progress("contact sheets", len(wanted), len(wanted))
    return [_draw(figure, chosen[figure.sensor], pictures, folder) for figure in FIGURES]


def _in_place(sensors: Sequence[Sensor]) -> dict[str, Sensor]:
    """The sensor for each of the report's two; InputError where two would take the place of one."""
    chosen = {"flir": load_sensor("flir"), "lltv": load_sensor("lltv")}
    kinds = ["flir" if sensor.mode == "emissive" else "lltv" for sensor in sensors]
    for kind in chosen:
        if kinds.count(kind) > 1:
            names = ",".join(sensor.name for sensor in sensors)
            raise InputError("gallery", "sensors", names, f"two in place of {kind}", "give one for each band")
    return chosen | dict(zip(kinds, sensors, strict=True))


def _look(
    world: World, sensor: Sensor, key: tuple[str, str, date], size: tuple[int, int], backend: str
) -> Iterator[tuple[tuple[str, str, date, float], Picture]]:
    """All pictures of one world by one sensor that figures ask for."""
    level, kind, day = key
    hours = sorted({
        hour for figure in FIGURES if (figure.level, figure.sensor) == (level, kind)
        for moment, hour in figure.moments if moment == day
    })  # fmt: skip
    camera = station_camera(world.scene, "tower")
    with Renderer(world, sensor, size=size, backend=backend) as renderer:
        for place, hour in enumerate(hours):
            # Numbers apart, so that no frame remembers the one of hours before.
            yield (*key, hour), renderer.render(camera, hour * 3600.0, frame=2 * place)


def _draw(figure: Figure, sensor: Sensor, pictures: Pictures, folder: Path) -> Path:
    shown = [pictures[figure.level, figure.sensor, day, hour].planes for day, hour in figure.moments]
    clean = [sampled_surfaces(planes["radiance"], planes["surface_id"] >= 0) for planes in shown]
    brightest = max(float(radiance.max()) for radiance in clean)
    own = [float(radiance.max()) < DARK * brightest for radiance in clean]
    day = _window(np.concatenate([radiance for radiance, dark in zip(clean, own, strict=True) if not dark]))
    windows = [_window(radiance) if dark else day for radiance, dark in zip(clean, own, strict=True)]
    gains, looks = [_gain(window, day) for window in windows], list(zip(shown, windows, strict=True))
    rows, notes = [[display_code(planes["radiance"], window) for planes, window in looks]], [gains]
    labels = [f"level {figure.level}"]
    if sensor.detector is not None:
        rows += [
            [display_code(planes["signal"], window) for planes, window in looks],
            [planes["display"] for planes in shown],
        ]
        notes += [gains, [""] * len(shown)]
        labels = ["radiance", sensor.name, f"{sensor.name},\nown gain"]
    sheet = contact_sheet(
        rows,
        title=f"Figure {figure.number}. {_title(sensor)}, level {figure.level}, {figure.title}",
        row_labels=labels,
        column_labels=[f"{moment:%d %B %Y}, {hour:g} h" for moment, hour in figure.moments],
        cell_labels=notes,
        scale=_scale(sensor, day),
        caption="Seen from the tower; outlines are reconstructed from the report's text, weather built to its words.",
    )
    path = folder / f"figure_{figure.number}_{sensor.name}_{figure.level}.png"
    imageio.imwrite(path, sheet)
    return path


def _window(radiance: NDArray[Any]) -> DisplaySettings:
    level, span = auto_window(radiance)
    return DisplaySettings(level=level, span=span)


def _gain(window: DisplaySettings, day: DisplaySettings) -> str:
    """What is said of a window that is not the day's."""
    if window is day or window.span is None or day.span is None:
        return ""
    return f"own gain, {day.span / window.span:.0f} times that of the day"


def _title(sensor: Sensor) -> str:
    return sensor.title if sensor.detector is not None else f"{sensor.name.upper()} {_band(sensor)}"


def _band(sensor: Sensor) -> str:
    shortest, longest = 1e6 * float(sensor.band.wavelength[0]), 1e6 * float(sensor.band.wavelength[-1])
    return f"{shortest:.3g}-{longest:.3g} um"


def _scale(sensor: Sensor, window: DisplaySettings) -> ScaleBar:
    if sensor.mode == "emissive":
        return temperature_scale(window, build_band_table(sensor.band), band=_band(sensor))
    return radiance_scale(window, band=_band(sensor))
