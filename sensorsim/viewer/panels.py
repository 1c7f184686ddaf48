"""The panel beside the picture: each section takes the state and gives the next one. Needs the extra `viewer`."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import date, timedelta
from typing import get_args

import numpy as np
from imgui_bundle import imgui

from sensorsim.radiometry import FloatArray
from sensorsim.render.air import Atmosphere
from sensorsim.scene import ALL_LEVELS, LEVELS
from sensorsim.sensor import DisplaySettings
from sensorsim.viewer.actions import Seen, adjust
from sensorsim.viewer.clock import PLAY_SPEEDS, clock_text
from sensorsim.viewer.motion import SPEEDS, zoom
from sensorsim.viewer.palettes import PALETTES
from sensorsim.viewer.stage import SCALES
from sensorsim.viewer.state import Place, ViewState, with_display, with_sensor

WIDTH = 300.0  # of the panel [pixels]
STRIP_HEIGHT = 62.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Facts:
    """What the panel tells but does not change."""

    seen: Seen
    baked: Place  # of the world on show
    milliseconds: float  # of the last pictures
    drawn: tuple[int, int]  # pixels of one picture
    strip: FloatArray  # (n, 3) colours of the day
    sun: tuple[float | None, float | None]  # sunrise, sunset [s]
    histogram: tuple[FloatArray, float, float, str]
    recorded: int  # cameras


def panel(state: ViewState, facts: Facts, height: float) -> tuple[ViewState, tuple[str, ...]]:
    """The panel; the next state, and actions that were asked for with its buttons."""
    imgui.set_next_window_pos(imgui.ImVec2(0.0, 0.0))
    imgui.set_next_window_size(imgui.ImVec2(WIDTH, height))
    fixed = imgui.WindowFlags_.no_resize | imgui.WindowFlags_.no_move | imgui.WindowFlags_.no_title_bar
    imgui.begin("panel", None, fixed)
    imgui.push_item_width(150.0)
    for section in (_sensor, _display, _scene, _flight):
        state = section(state, facts)
    asked = _files(state, facts)
    _histogram(facts)
    size = f"{facts.drawn[0]} x {facts.drawn[1]}"
    imgui.text_disabled(f"{size} in {facts.milliseconds:.0f} ms     H: help")
    imgui.pop_item_width()
    imgui.end()
    return state, asked


def time_strip(state: ViewState, facts: Facts, left: float, top: float, width: float) -> ViewState:
    """Clock, play button and the day from midnight to midnight, to be clicked or dragged."""
    imgui.set_next_window_pos(imgui.ImVec2(left, top))
    imgui.set_next_window_size(imgui.ImVec2(width, STRIP_HEIGHT))
    fixed = imgui.WindowFlags_.no_resize | imgui.WindowFlags_.no_move | imgui.WindowFlags_.no_title_bar
    imgui.begin("time", None, fixed | imgui.WindowFlags_.no_scrollbar)
    if imgui.button("Stop" if state.playing else "Play", imgui.ImVec2(52.0, 0.0)):
        state = replace(state, playing=not state.playing)
    imgui.same_line()
    rise, down = ("never" if time is None else clock_text(time) for time in facts.sun)
    imgui.text(f"{clock_text(state.time_of_day)} local standard time, {facts.baked.day.isoformat()}")
    if width > 760.0:  # else there is no room before the speed
        imgui.same_line()
        imgui.text_disabled(f"  sun up {rise}, down {down}")
    imgui.same_line(width - 250.0)
    imgui.set_next_item_width(140.0)
    names = [f"{speed / 60.0:g} min each s" if speed > 1.0 else "real time" for speed in PLAY_SPEEDS]
    nearest = int(np.argmin(np.abs(np.array(PLAY_SPEEDS) - state.play_speed)))
    changed, index = imgui.combo("speed", nearest, names)
    if changed:
        state = replace(state, play_speed=PLAY_SPEEDS[index])
    state = _strip(state, facts, width - 16.0)
    imgui.end()
    return state


def _strip(state: ViewState, facts: Facts, width: float) -> ViewState:
    """The strip of day and night."""
    draw, corner, height = imgui.get_window_draw_list(), imgui.get_cursor_screen_pos(), 22.0
    step = width / len(facts.strip)
    for index, (red, green, blue) in enumerate(facts.strip.tolist()):
        packed = imgui.get_color_u32(imgui.ImVec4(red, green, blue, 1.0))
        x = corner.x + index * step
        draw.add_rect_filled(imgui.ImVec2(x, corner.y), imgui.ImVec2(x + step + 1.0, corner.y + height), packed)
    white, dark = (imgui.get_color_u32(imgui.ImVec4(v, v, v, 1.0)) for v in (1.0, 0.0))
    for hour in range(3, 24, 3):
        x = corner.x + width * hour / 24.0
        for offset, paint in ((1.0, dark), (0.0, white)):
            draw.add_text(imgui.ImVec2(x - 6.0 + offset, corner.y + 3.0 + offset), paint, f"{hour}")
    now = corner.x + width * state.time_of_day / 86400.0
    draw.add_rect_filled(imgui.ImVec2(now - 2.0, corner.y - 2.0), imgui.ImVec2(now + 2.0, corner.y + height), white)
    draw.add_rect(imgui.ImVec2(now - 3.0, corner.y - 3.0), imgui.ImVec2(now + 3.0, corner.y + height + 1.0), dark)
    imgui.invisible_button("day", imgui.ImVec2(width, height))
    if imgui.is_item_active():
        share = (imgui.get_mouse_pos().x - corner.x) / width
        return replace(state, time_of_day=86400.0 * max(0.0, min(1.0, share)))
    return state


def _sensor(state: ViewState, facts: Facts) -> ViewState:
    imgui.separator_text("Sensor")
    names = list(facts.seen.sensors)
    changed, index = imgui.combo("sensor", names.index(state.sensors[0]), names)
    if changed:
        state = with_sensor(state, names[index])
    changed, on = imgui.checkbox("side by side with", state.side_by_side)
    state = replace(state, side_by_side=on) if changed else state
    changed, index = imgui.combo("second", names.index(state.sensors[1]), names)
    if changed and names[index] != state.sensors[0]:
        state = replace(state, sensors=(state.sensors[0], names[index]), side_by_side=True)
    changed, on = imgui.checkbox("noise", state.noise)
    state = replace(state, noise=on) if changed else state
    imgui.same_line()
    changed, on = imgui.checkbox("blur", state.blur)
    return replace(state, blur=on) if changed else state


def _display(state: ViewState, facts: Facts) -> ViewState:
    imgui.separator_text("Display")
    sensor = state.sensors[0]
    display = state.display_of(sensor, facts.seen.own[sensor])
    for action, text, on in (
        ("polarity", "black-hot", display.polarity == "black-hot"),
        ("automatic", "automatic gain", display.is_automatic),
        ("tone", "equalised greys", display.tone == "plateau"),
    ):
        if imgui.checkbox(text, on)[0]:
            state = adjust(state, action, facts.seen)
        if action == "polarity":
            imgui.same_line()
    display = state.display_of(sensor, facts.seen.own[sensor])
    if not display.is_automatic:
        state = with_display(state, sensor, _window(display))
    changed, gamma = imgui.slider_float("gamma", display.gamma, 0.4, 2.5, "%.2f")
    if changed:
        state = adjust_gamma(state, sensor, facts, min(5.0, max(0.2, gamma)))
    changed, index = imgui.combo("colours", PALETTES.index(state.palette), list(PALETTES))
    return replace(state, palette=PALETTES[index]) if changed else state


def adjust_gamma(state: ViewState, sensor: str, facts: Facts, gamma: float) -> ViewState:
    """The state with another gamma of a sensor's display."""
    display = state.display_of(sensor, facts.seen.own[sensor])
    return with_display(state, sensor, replace(display, gamma=gamma))


def _window(display: DisplaySettings) -> DisplaySettings:
    """Sliders of a gain and level held by hand, over a tenth to ten times what they are."""
    assert display.level is not None
    assert display.span is not None
    flags = imgui.SliderFlags_.logarithmic
    changed, gain = imgui.slider_float(
        "gain", 1.0 / display.span, 0.1 / display.span, 10.0 / display.span, "%.3g", flags
    )
    if changed and gain > 0.0:
        display = replace(display, span=1.0 / gain)
    assert display.level is not None
    assert display.span is not None
    low, high = display.level - display.span, display.level + display.span
    changed, level = imgui.slider_float("level", display.level, low, high, "%.4g")
    return replace(display, level=level) if changed else display


def _scene(state: ViewState, facts: Facts) -> ViewState:
    imgui.separator_text("Scene")
    place = state.place
    levels = [*LEVELS, ALL_LEVELS]
    changed, index = imgui.combo("detail", levels.index(place.level), levels)
    if changed:
        place = replace(place, level=levels[index])
    names = [name for name, _ in facts.seen.days]
    current = names.index(place.weather) if place.weather in names else 0
    changed, index = imgui.combo("weather", current, names)
    if changed:
        place = replace(place, weather=names[index], day=facts.seen.days[index][1])
    airs = list(get_args(Atmosphere))
    changed, index = imgui.combo("air", airs.index(state.atmosphere), airs)
    state = replace(state, atmosphere=airs[index]) if changed else state
    day = _day(place.day)
    imgui.same_line()
    imgui.text(day.isoformat())
    if imgui.button("Effects (U)", imgui.ImVec2(136.0, 0.0)):
        state = replace(state, effects=not state.effects)
    return replace(state, place=replace(place, day=day))


def _day(day: date) -> date:
    if imgui.button("day -"):
        return day - timedelta(days=1)
    imgui.same_line()
    return day + timedelta(days=1) if imgui.button("day +") else day


def _flight(state: ViewState, facts: Facts) -> ViewState:  # noqa: ARG001
    imgui.separator_text("Flight")
    logarithmic = imgui.SliderFlags_.logarithmic
    changed, speed = imgui.slider_float("m/s", state.speed, *SPEEDS, "%.1f", logarithmic)
    state = replace(state, speed=max(SPEEDS[0], min(SPEEDS[1], speed))) if changed else state
    field = state.camera.horizontal_field_of_view
    changed, wanted = imgui.slider_float("deg field", field, 0.5, 120.0, "%.1f", logarithmic)
    if changed and wanted > 0.0:
        state = replace(state, camera=zoom(state.camera, wanted / field))
    names = ["automatic", *(f"1 / {scale:g}" for scale in SCALES)]
    current = 0 if state.scale is None else 1 + SCALES.index(state.scale)
    changed, index = imgui.combo("pixels", current, names)
    return replace(state, scale=None if index == 0 else SCALES[index - 1]) if changed else state


def _files(state: ViewState, facts: Facts) -> tuple[str, ...]:
    asked = []
    record = "Stop (R)" if state.recording else "Record (R)"
    for label, action in (
        (record, "record"), ("Replay", "replay"), ("Picture (F12)", "save_picture"), ("Planes (F11)", "save_planes"),
    ):  # fmt: skip
        if imgui.button(label, imgui.ImVec2(136.0, 0.0)):
            asked.append(action)
        if action in ("record", "save_picture"):
            imgui.same_line()
    if state.recording:
        imgui.text(f"{facts.recorded} cameras recorded")
    return tuple(asked)


def _histogram(facts: Facts) -> None:
    shares, low, high, unit = facts.histogram
    values = np.asarray(np.sqrt(shares), dtype=np.float32)
    imgui.separator_text("Histogram (square root)")
    imgui.plot_histogram("##histogram", values, graph_size=imgui.ImVec2(WIDTH - 20.0, 58.0), scale_min=0.0)
    digits = ".1f" if unit == "K" else ".3g"
    imgui.text_disabled(f"{low:{digits}} to {high:{digits}} {unit}")


def plain_rows(rows: Sequence[tuple[str, str]]) -> None:
    """Names and values, below one another."""
    for name, value in rows:
        imgui.text_disabled(name)
        imgui.same_line(92.0)
        imgui.text(value)
