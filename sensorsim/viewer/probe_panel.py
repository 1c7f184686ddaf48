"""The window that tells what is under the pointer, with that surface's day. Needs the extra `viewer`."""

import numpy as np
from imgui_bundle import imgui

from sensorsim.radiometry import FloatArray
from sensorsim.viewer.clock import clock_text
from sensorsim.viewer.fit_errors import FitErrors
from sensorsim.viewer.panels import plain_rows
from sensorsim.viewer.probe import Probe

WIDTH = 292.0  # [pixels]


def probe_rows(probe: Probe, errors: FitErrors | None) -> tuple[tuple[str, str], ...]:
    """Names and values of a pixel, as far as there are any, and the error of its fit where that was measured."""
    values = (
        ("feature", _short(probe.feature, 24)),
        ("part", f"{probe.role} {probe.word}".strip()),
        ("material", _short(probe.wall_type, 24)),
        ("inside", probe.interior),
        ("reflects", _number(probe.reflectance, "{:.2f} of sunlight")),
        ("emits", _number(probe.emissivity, "{:.3f} of a black body")),
        ("surface", _kelvin(probe.temperature)),
        ("fit error", _fit_error(probe, errors)),
        ("apparent", _kelvin(probe.apparent_temperature)),
        ("radiance", f"{probe.radiance:.5g} W/(m2 sr)"),
        ("range", _number(probe.range, "{:.1f} m")),
        *((_short(name.replace("_", " "), 10), f"{value:.5g}") for name, value in probe.more),
    )
    return tuple((name, value) for name, value in values if value)


def probe_panel(
    probe: Probe,
    errors: FitErrors | None,
    day: tuple[FloatArray, FloatArray] | None,
    now: float,
    right: float,
    top: float,
) -> None:
    """The window, its upper right corner at a place; `day` is times [s] and temperatures [K], `now` the clock [s]."""
    imgui.set_next_window_pos(imgui.ImVec2(right - WIDTH - 8.0, top + 62.0))
    imgui.set_next_window_size(imgui.ImVec2(WIDTH, 0.0))
    imgui.set_next_window_bg_alpha(0.85)
    plain = imgui.WindowFlags_.no_title_bar | imgui.WindowFlags_.no_inputs | imgui.WindowFlags_.no_resize
    imgui.begin("probe", None, plain | imgui.WindowFlags_.no_focus_on_appearing)
    plain_rows(probe_rows(probe, errors))
    if day is not None:
        _plot(day, now)
    imgui.end()


def _plot(day: tuple[FloatArray, FloatArray], now: float) -> None:
    """Temperature from midnight to midnight with a line at the hour."""
    time, kelvin = day
    low, high = float(kelvin.min()), float(kelvin.max())
    corner, width, height = imgui.get_cursor_screen_pos(), WIDTH - 16.0, 64.0
    imgui.plot_lines(
        "##day", np.asarray(kelvin, dtype=np.float32), graph_size=imgui.ImVec2(width, height),
        scale_min=low - 0.5, scale_max=high + 0.5,
    )  # fmt: skip
    x = corner.x + 4.0 + (width - 8.0) * now / float(time[-1])
    green = imgui.get_color_u32(imgui.ImVec4(0.55, 1.0, 0.6, 1.0))
    imgui.get_window_draw_list().add_line(imgui.ImVec2(x, corner.y), imgui.ImVec2(x, corner.y + height), green, 1.5)
    imgui.text_disabled(f"0 to 24 h: {low:.1f} to {high:.1f} K")


def _fit_error(probe: Probe, errors: FitErrors | None) -> str:
    if errors is None or probe.surface is None:
        return ""
    return f"{float(errors.error[probe.surface]):.3f} K at {clock_text(errors.time_of_day)}"


def _kelvin(value: float | None) -> str:
    return "" if value is None else f"{value:.2f} K  ({value - 273.15:+.2f} C)"


def _number(value: float | None, form: str) -> str:
    return "" if value is None else form.format(value)


def _short(text: str, length: int) -> str:
    return text if len(text) <= length else text[: length - 2] + ".."
