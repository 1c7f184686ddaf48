"""The pictures of section IV of [Report1978], figures 19 and 21 to 27, as labelled contact sheets.

Frames of one figure share one display window, so that brighter means warmer across the sheet. At 7 h the low-light
picture would be black in the window of the day and has its own gain, as the set's automatic gain would have given it.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import date
from pathlib import Path

import imageio.v3 as imageio
import numpy as np

from sensorsim.effects import EffectChoice
from sensorsim.environment import read_weather
from sensorsim.frames import ScaleBar, contact_sheet, radiance_scale, temperature_scale
from sensorsim.radiometry import build_band_table
from sensorsim.render import EVERY_EFFECT, Picture, Renderer, World, build_world, station_camera
from sensorsim.render.picture import exposed
from sensorsim.scene import load_scene
from sensorsim.sensor import DisplaySettings, auto_window, display_code, load_sensor
from sensorsim.tables import BakeSettings

WINTER, SUMMER, FALL = date(1976, 2, 7), date(1976, 9, 3), date(1976, 10, 7)
DARK = 0.02  # a frame whose brightest part is below this share of the brightest frame gets its own gain
Progress = Callable[[str, int, int], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class Figure:
    """One figure: level, sensor, and the moments that it shows."""

    number: int
    title: str
    level: str
    sensor: str
    moments: tuple[tuple[date, float], ...]  # day, hour


def _diurnal(number: int, level: str, sensor: str, evening: float) -> Figure:
    title = f"Figure {number}. {_SENSOR_TITLE[sensor]}, level {level}, 7 February 1976 through the day"
    return Figure(
        number=number,
        title=title,
        level=level,
        sensor=sensor,
        moments=tuple((WINTER, hour) for hour in (7.0, 10.0, 13.0, evening)),
    )


def _seasonal(number: int, sensor: str) -> Figure:
    title = f"Figure {number}. {_SENSOR_TITLE[sensor]}, level IIIB, winter, summer and fall at 10 h"
    moments = ((WINTER, 10.0), (SUMMER, 10.0), (FALL, 10.0))
    return Figure(number=number, title=title, level="IIIB", sensor=sensor, moments=moments)


_SENSOR_TITLE = {"flir": "FLIR 8-14 um", "lltv": "LLLTV 0.8-1.1 um"}
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
) -> list[Path]:
    """Draw all figures into `folder`; returns the sheets in the order of the figures."""
    folder.mkdir(parents=True, exist_ok=True)
    pictures: dict[tuple[str, str, date, float], Picture] = {}
    wanted = sorted({(figure.level, day) for figure in FIGURES for day, _ in figure.moments})
    for done, (level, day) in enumerate(wanted):
        if progress is not None:
            progress(f"level {level}, {day}", done, len(wanted))
        world = build_world(
            load_scene("hospital", level=level), read_weather(day.isoformat()), image_day=day, settings=settings,
            effects=effects, sensor=load_sensor("flir"),
        )  # fmt: skip
        for key, picture in _look(world, level, day, size, backend):
            pictures[key] = picture
    if progress is not None:
        progress("contact sheets", len(wanted), len(wanted))
    return [_draw(figure, pictures, folder) for figure in FIGURES]


def _look(
    world: World, level: str, day: date, size: tuple[int, int], backend: str
) -> Iterator[tuple[tuple[str, str, date, float], Picture]]:
    """All pictures of one world that figures ask for."""
    for sensor in ("flir", "lltv"):
        hours = sorted({
            hour for figure in FIGURES if (figure.level, figure.sensor) == (level, sensor)
            for moment, hour in figure.moments if moment == day
        })  # fmt: skip
        camera = station_camera(world.scene, "tower")
        with Renderer(world, load_sensor(sensor), size=size, backend=backend) as renderer:
            for hour in hours:
                yield (level, sensor, day, hour), renderer.render(camera, hour * 3600.0)


def _draw(figure: Figure, pictures: dict[tuple[str, str, date, float], Picture], folder: Path) -> Path:
    shown = [pictures[figure.level, figure.sensor, day, hour] for day, hour in figure.moments]
    seen = [exposed(picture.planes) for picture in shown]
    brightest = max(float(radiance.max()) for radiance in seen)
    own = [float(radiance.max()) < DARK * brightest for radiance in seen]
    level, span = auto_window(np.concatenate([radiance for radiance, dark in zip(seen, own, strict=True) if not dark]))
    window = DisplaySettings(level=level, span=span)
    images, notes = [], []
    for picture, dark in zip(shown, own, strict=True):
        images.append(picture.planes["display"] if dark else display_code(picture.planes["radiance"], window))
        notes.append(f"own gain, {span / (picture.display.span or span):.0f} times that of the day" if dark else "")
    sheet = contact_sheet(
        [images],
        title=figure.title,
        row_labels=[f"level {figure.level}"],
        column_labels=[f"{day:%d %B %Y}, {hour:g} h" for day, hour in figure.moments],
        cell_labels=[notes],
        scale=_scale(figure, window),
        caption="Seen from the tower; outlines are reconstructed from the report's text, weather built to its words.",
    )
    path = folder / f"figure_{figure.number}_{figure.sensor}_{figure.level}.png"
    imageio.imwrite(path, sheet)
    return path


def _scale(figure: Figure, window: DisplaySettings) -> ScaleBar:
    sensor = load_sensor(figure.sensor)
    if sensor.mode == "emissive":
        return temperature_scale(window, build_band_table(sensor.band), band="8-14 um")
    return radiance_scale(window, band="0.8-1.1 um")
