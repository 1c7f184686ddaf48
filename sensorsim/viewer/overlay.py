"""What lies over the picture: symbols, colour scale, first hint, notes and the help page. Needs the extra `viewer`."""

import textwrap
from collections.abc import Sequence
from typing import Any

from imgui_bundle import imgui

from sensorsim.radiometry import FloatArray
from sensorsim.viewer.keys import HELP
from sensorsim.viewer.palettes import Colours
from sensorsim.viewer.symbology import Symbols

Box = tuple[float, float, float, float]  # left, top, width, height [pixels]
KEY_WIDTH = 160.0  # of the first column of the help page [pixels]
HINT = (
    "W A S D  fly     Q E  down, up     drag the mouse  look around     wheel  speed",
    "hold comma or period  change the hour     1 2 3  sensors     H  all keys",
)


def colour(red: float, green: float, blue: float, alpha: float = 1.0) -> int:
    """A colour from 0 to 1 as ImGui packs it."""
    return int(imgui.get_color_u32(imgui.ImVec4(red, green, blue, alpha)))


def draw_symbols(box: Box, symbols: Symbols) -> None:
    """Symbols in light green over a dark edge, so that they show on white and black."""
    draw = imgui.get_background_draw_list()
    lines, labels = symbols
    left, top = box[0], box[1]
    draw.push_clip_rect(imgui.ImVec2(left, top), imgui.ImVec2(left + box[2], top + box[3]))
    for paint, offset, thickness in ((colour(0, 0, 0, 0.75), 1.0, 2.0), (colour(0.55, 1.0, 0.6), 0.0, 1.3)):
        for line in lines:
            start = imgui.ImVec2(left + line.start[0] + offset, top + line.start[1] + offset)
            end = imgui.ImVec2(left + line.end[0] + offset, top + line.end[1] + offset)
            draw.add_line(start, end, paint, thickness)
    for label in labels:
        _text(draw, (left + label.at[0], top + label.at[1]), label.text, label.anchor)
    draw.pop_clip_rect()


def _text(draw: Any, at: tuple[float, float], text: str, anchor: tuple[float, float]) -> None:
    size = imgui.calc_text_size(text)
    x, y = round(at[0] - anchor[0] * size.x), round(at[1] - anchor[1] * size.y)
    for offset, paint in ((1, colour(0, 0, 0, 0.9)), (0, colour(0.55, 1.0, 0.6))):
        draw.add_text(imgui.ImVec2(x + offset, y + offset), paint, text)


def draw_scale(box: Box, colours: Colours, values: FloatArray, unit: str) -> None:
    """A bar of a picture's colours with what they mean, on its left side, half way down; black below."""
    draw = imgui.get_background_draw_list()
    height, width = min(220.0, 0.4 * box[3]), 14.0
    left, top = box[0] + 12.0, box[1] + 0.5 * (box[3] - height)
    right = left + width
    steps = 64
    for step in range(steps):
        red, green, blue = (float(part) / 255.0 for part in colours[255 - step * 255 // (steps - 1)])
        upper = top + height * step / steps
        draw.add_rect_filled(
            imgui.ImVec2(left, upper), imgui.ImVec2(right, upper + height / steps + 1.0),
            colour(red, green, blue),
        )  # fmt: skip
    draw.add_rect(imgui.ImVec2(left, top), imgui.ImVec2(right, top + height), colour(0.55, 1.0, 0.6))
    for index, value in enumerate(values):
        y = top + height * (1.0 - index / (len(values) - 1))
        _text(draw, (right + 6.0, y), scale_text(float(value), unit), (0.0, 0.5))
    _text(draw, (left, top - 10.0), unit, (0.0, 1.0))


def scale_text(value: float, unit: str) -> str:
    """A temperature to a tenth of a kelvin, any other value to three figures."""
    return f"{value:.1f}" if unit == "K" else f"{value:.3g}"


def draw_notes(box: Box, lines: Sequence[str], *, at_top: bool) -> None:
    """Lines in a dark box in the middle of the picture's width, near its top or its bottom."""
    lines = [part for line in lines for part in textwrap.wrap(line, max(20, int(box[2] / 10.0)))]
    if not lines:
        return
    draw = imgui.get_foreground_draw_list()
    sizes = [imgui.calc_text_size(line) for line in lines]
    width, row = max(size.x for size in sizes), max(size.y for size in sizes) + 4.0
    left = box[0] + 0.5 * (box[2] - width)
    top = box[1] + 70.0 if at_top else box[1] + box[3] - 90.0 - row * len(lines)
    corner = imgui.ImVec2(left + width + 14.0, top + row * len(lines) + 8.0)
    draw.add_rect_filled(imgui.ImVec2(left - 14.0, top - 8.0), corner, colour(0, 0, 0, 0.75), 6.0)
    for index, line in enumerate(lines):
        x = box[0] + 0.5 * (box[2] - sizes[index].x)
        draw.add_text(imgui.ImVec2(x, top + row * index), colour(1, 1, 1), line)


def help_page(box: Box) -> None:
    """All keys, in two columns."""
    width, height = min(940.0, box[2] - 20.0), min(456.0, box[3] - 20.0)
    imgui.set_next_window_pos(imgui.ImVec2(box[0] + 0.5 * (box[2] - width), box[1] + 0.5 * (box[3] - height)))
    imgui.set_next_window_size(imgui.ImVec2(width, height))
    imgui.set_next_window_bg_alpha(0.93)
    imgui.begin("Keys (H closes this page)", None, imgui.WindowFlags_.no_resize | imgui.WindowFlags_.no_collapse)
    if imgui.begin_table("keys", 2):
        for column in (HELP[:2], HELP[2:]):
            imgui.table_next_column()
            for title, rows in column:
                imgui.separator_text(title)
                for keys, meaning in rows:
                    start = imgui.get_cursor_pos_x()
                    imgui.text_colored(imgui.ImVec4(0.55, 1.0, 0.6, 1.0), keys)
                    imgui.same_line()
                    imgui.set_cursor_pos_x(start + KEY_WIDTH)
                    imgui.text(meaning)
        imgui.end_table()
    imgui.end()
