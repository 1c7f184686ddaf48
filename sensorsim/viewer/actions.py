"""From keys to the next state: what a press does at once, and what a moment of holding keys does. Pure functions."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from datetime import date
from typing import Any

from sensorsim.render import Camera
from sensorsim.scene import ALL_LEVELS, LEVELS
from sensorsim.sensor import DisplaySettings
from sensorsim.viewer.clock import SCRUB_RATE, run_clock
from sensorsim.viewer.keys import PRESSED, motion_of, scrub_of
from sensorsim.viewer.motion import Motion, circle, drag, fly, point_ahead, wheel_speed, zoom
from sensorsim.viewer.palettes import PALETTES
from sensorsim.viewer.state import (
    ViewState,
    other_gain,
    other_polarity,
    other_tone,
    with_display,
    with_gain,
    with_level,
    with_sensor,
)

FILE_ACTIONS = ("save_picture", "save_planes", "save_window", "record", "replay", "measure")


@dataclass(frozen=True, slots=True, kw_only=True)
class Inputs:
    """What hand and script did since the last frame."""

    held: frozenset[str] = frozenset()  # keys that are down
    pressed: tuple[str, ...] = ()  # keys that went down
    drag: tuple[float, float] = (0.0, 0.0)  # of the picture, right and down [pixels]
    wheel: float = 0.0  # notches over the picture
    stick: Motion = field(default_factory=Motion)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Seen:
    """What the last picture and the scene tell about the choices there are."""

    sensors: tuple[str, ...]  # all that can be chosen
    own: Mapping[str, DisplaySettings]  # the sensors' own displays
    shown: Mapping[str, DisplaySettings]  # windows of the pictures on show
    distance: float | None  # to the surface in the middle [m]
    stations: tuple[Camera, ...]  # the scene's cameras
    days: tuple[tuple[str, date], ...]  # weather that can be chosen, each with its day
    width: float  # of the picture [pixels]


def press(state: ViewState, key: str, seen: Seen) -> ViewState:
    """The state after a key went down; keys that mean nothing or a file change nothing."""
    action = PRESSED.get(key, "")
    if action.startswith("sensor_"):
        number = int(action.removeprefix("sensor_"))
        return with_sensor(state, seen.sensors[number - 1]) if number <= len(seen.sensors) else state
    if action in _SWITCHES:
        switched: dict[str, Any] = {action: not getattr(state, action)}
        return replace(state, **switched)
    if action in _DISPLAY:
        return adjust(state, action, seen)
    if action in _PRESS:
        return _PRESS[action](state, seen)
    return state


def adjust(state: ViewState, action: str, seen: Seen) -> ViewState:
    """The state after a knob of the display was turned, on all sensors on show that have a picture."""
    for sensor in state.drawn:
        if sensor in seen.shown:
            display = state.display_of(sensor, seen.own[sensor])
            state = with_display(state, sensor, _DISPLAY[action](display, seen.shown[sensor]))
    return state


def advance(state: ViewState, inputs: Inputs, seen: Seen, seconds: float) -> ViewState:
    """The state a moment [s] later, by keys held, mouse, wheel, gamepad and clock."""
    motion = motion_of(inputs.held) + inputs.stick
    camera = drag(state.camera, *inputs.drag, seen.width) if any(inputs.drag) else state.camera
    if not {"LEFT_CONTROL", "RIGHT_CONTROL"}.isdisjoint(inputs.held):
        camera = zoom(camera, math.pow(0.9, inputs.wheel))
    else:
        state = replace(state, speed=wheel_speed(state.speed, inputs.wheel))
    orbit = None if any(inputs.drag) else state.orbit
    if motion != Motion():
        if orbit is None or motion.yaw or motion.pitch:
            orbit, camera = None, fly(camera, motion, state.speed, seconds)
        else:
            camera = circle(camera, orbit, motion, state.speed, seconds)
    scrub = scrub_of(inputs.held) * SCRUB_RATE + (state.play_speed if state.playing else 0.0)
    moved = state.moved or motion != Motion() or any(inputs.drag)
    clock = run_clock(state.time_of_day, scrub, seconds) if scrub else state.time_of_day
    return replace(state, camera=camera, orbit=orbit, time_of_day=clock, moved=moved, frame=state.frame + 1)


def _orbit(state: ViewState, seen: Seen) -> ViewState:
    return replace(state, orbit=point_ahead(state.camera, seen.distance) if state.orbit is None else None)


def _station(state: ViewState, seen: Seen) -> ViewState:
    if not seen.stations:
        return state
    number = (state.station + 1) % len(seen.stations)
    return replace(state, camera=seen.stations[number], station=number, orbit=None)


def _palette(state: ViewState, seen: Seen) -> ViewState:  # noqa: ARG001
    return replace(state, palette=PALETTES[(PALETTES.index(state.palette) + 1) % len(PALETTES)])


def _detail(state: ViewState, seen: Seen) -> ViewState:  # noqa: ARG001
    levels = (*LEVELS, ALL_LEVELS)
    level = levels[(levels.index(state.place.level) + 1) % len(levels)]
    return replace(state, place=replace(state.place, level=level))


def _weather(state: ViewState, seen: Seen) -> ViewState:
    names = [name for name, _ in seen.days]
    index = names.index(state.place.weather) if state.place.weather in names else -1
    name, day = seen.days[(index + 1) % len(names)]
    return replace(state, place=replace(state.place, weather=name, day=day))


def _escape(state: ViewState, seen: Seen) -> ViewState:  # noqa: ARG001
    return replace(state, help=False) if state.help else replace(state, quit=True)


def _play(state: ViewState, seen: Seen) -> ViewState:  # noqa: ARG001
    return replace(state, playing=not state.playing)


_SWITCHES = ("side_by_side", "noise", "blur", "symbology", "probe", "panels", "help", "effects")
_DISPLAY: Mapping[str, Callable[[DisplaySettings, DisplaySettings], DisplaySettings]] = {
    "polarity": lambda display, shown: other_polarity(display),  # noqa: ARG005
    "automatic": other_gain,
    "tone": lambda display, shown: other_tone(display),  # noqa: ARG005
    "gain_up": lambda display, shown: with_gain(display, shown, 1.0),
    "gain_down": lambda display, shown: with_gain(display, shown, -1.0),
    "level_up": lambda display, shown: with_level(display, shown, 1.0),
    "level_down": lambda display, shown: with_level(display, shown, -1.0),
}
_PRESS: Mapping[str, Callable[[ViewState, Seen], ViewState]] = {
    "play": _play,
    "orbit": _orbit,
    "station": _station,
    "palette": _palette,
    "detail": _detail,
    "weather": _weather,
    "escape": _escape,
}
