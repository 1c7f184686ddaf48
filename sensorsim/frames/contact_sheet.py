"""Contact sheets: rows and columns of display images with title, labels, a scale bar and a caption."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw, ImageFont

from sensorsim.errors import InputError
from sensorsim.frames.scale_bar import ScaleBar

Grey = npt.NDArray[np.uint8]
Font = ImageFont.FreeTypeFont | ImageFont.ImageFont

_PAPER, _INK, _LINE = 255, 0, 128  # display codes
_GAP = 12  # [pixels] between images and around the sheet
_LEADING = 1.3  # line height over font size
_TITLE_SIZE, _LABEL_SIZE, _CAPTION_SIZE = 20, 14, 13  # [pixels]
_BAR_HEIGHT, _TICK_HEIGHT, _NARROWEST = 16, 5, 400  # [pixels]


def contact_sheet(
    images: Sequence[Sequence[Grey | None]],
    *,
    title: str,
    row_labels: Sequence[str],
    column_labels: Sequence[str],
    caption: str = "",
    cell_labels: Sequence[Sequence[str]] | None = None,
    scale: ScaleBar | None = None,
) -> Grey:
    """Sheet (height, width) uint8 of rows of display images, all (h, w) uint8 of one shape; None leaves a cell empty.

    Pixels of the images are kept as they are. cell_labels stand below their images. Long texts are wrapped.
    Raises InputError where there is no image, the rows or labels do not match, or an image has another shape or type.
    """
    height, width = _checked_shape(images, row_labels, column_labels, cell_labels)
    cells = [list(row) for row in cell_labels] if cell_labels is not None else [[""] * len(row) for row in images]
    layout = _lay_out(height, width, [*column_labels, *(text for row in cells for text in row)], row_labels)
    strips = [_heading(layout, title, column_labels)]
    for row, label, below in zip(images, row_labels, cells, strict=True):
        strips.append(_row(layout, row, label, below))
    if scale is not None:
        strips.append(_scale_strip(layout, scale))
    if caption:
        strips.append(_text_strip(layout, caption, _CAPTION_SIZE))
    return np.concatenate([np.asarray(strip) for strip in strips])


@dataclass(frozen=True, slots=True, kw_only=True)
class _Layout:
    """Sizes [pixels]: image, cell width, left edge of the first cell, width of the sheet."""

    image_height: int
    image_width: int
    cell_width: int
    left: int
    sheet_width: int

    def cell_left(self, column: int) -> int:
        return self.left + column * (self.cell_width + _GAP)


def _lay_out(height: int, width: int, cell_texts: Sequence[str], row_labels: Sequence[str]) -> _Layout:
    """Cells hold the image and the longest word below or above it; the left margin holds the row labels."""
    font = _font(_LABEL_SIZE)
    words = [word for text in cell_texts for word in text.split()]
    cell_width = max(width, *(int(np.ceil(font.getlength(word))) for word in words), 1)
    lines = [line for label in row_labels for line in label.split("\n") if line]
    label_width = max((int(np.ceil(font.getlength(line))) for line in lines), default=0)
    left = _GAP + (label_width + _GAP if label_width else 0)
    columns = len(cell_texts) // (len(row_labels) + 1)
    sheet_width = max(left + columns * (cell_width + _GAP), _NARROWEST)
    return _Layout(image_height=height, image_width=width, cell_width=cell_width, left=left, sheet_width=sheet_width)


def _heading(layout: _Layout, title: str, column_labels: Sequence[str]) -> Image.Image:
    """Title over the column labels."""
    top = _text_strip(layout, title, _TITLE_SIZE)
    font = _font(_LABEL_SIZE)
    labels = [_wrap(label, font, layout.cell_width) for label in column_labels]
    strip = _blank(layout, top.height + _text_height(max(map(len, labels)), _LABEL_SIZE))
    strip.paste(top, (0, 0))
    for column, lines in enumerate(labels):
        _write_centred(strip, layout, column, top.height, lines, font)
    return strip


def _row(layout: _Layout, images: Sequence[Grey | None], label: str, below: Sequence[str]) -> Image.Image:
    """One row of images with its label at the left and the cells' own labels below."""
    font = _font(_LABEL_SIZE)
    texts = [_wrap(text, font, layout.cell_width) if text else [] for text in below]
    strip = _blank(layout, layout.image_height + _text_height(max(map(len, texts)), _LABEL_SIZE) + _GAP)
    draw = ImageDraw.Draw(strip)
    lines = label.split("\n")
    top = (layout.image_height - _text_height(len(lines), _LABEL_SIZE)) / 2
    _write_lines(draw, _GAP, top, lines, font, _LABEL_SIZE)
    for column, (image, cell) in enumerate(zip(images, texts, strict=True)):
        left = layout.cell_left(column) + (layout.cell_width - layout.image_width) // 2
        if image is None:
            box = (left, 0, left + layout.image_width - 1, layout.image_height - 1)
            draw.rectangle(box, outline=_LINE)
        else:
            strip.paste(Image.fromarray(image), (left, 0))
        _write_centred(strip, layout, column, layout.image_height, cell, font)
    return strip


def _scale_strip(layout: _Layout, scale: ScaleBar) -> Image.Image:
    """The grey bar under its title, ticks and their labels below it."""
    font = _font(_LABEL_SIZE)
    title = _text_height(1, _LABEL_SIZE)
    strip = _blank(layout, title + _BAR_HEIGHT + _TICK_HEIGHT + title + _GAP)
    draw = ImageDraw.Draw(strip)
    left, width = _bar_place(layout, font, scale)
    _write_lines(draw, left, 0, [scale.title], font, _LABEL_SIZE)
    greys = np.rint(np.linspace(255.0, 0.0, width) if scale.black_hot else np.linspace(0.0, 255.0, width))
    bar = np.tile(greys.astype(np.uint8), (_BAR_HEIGHT, 1))
    strip.paste(Image.fromarray(bar), (left, title))
    draw.rectangle((left - 1, title - 1, left + width, title + _BAR_HEIGHT), outline=_LINE)
    foot = title + _BAR_HEIGHT
    for position, label in scale.ticks:
        x = left + round(position * (width - 1))
        draw.line((x, foot, x, foot + _TICK_HEIGHT), fill=_INK)
        draw.text((x - font.getlength(label) / 2, foot + _TICK_HEIGHT + 1), label, fill=_INK, font=font)
    return strip


def _bar_place(layout: _Layout, font: Font, scale: ScaleBar) -> tuple[int, int]:
    """Left edge and width of the bar: under the images, with room for the labels at its ends."""
    overhang = max((int(np.ceil(font.getlength(label) / 2)) for _, label in scale.ticks), default=0)
    left = max(layout.left, overhang + 1)
    return left, layout.sheet_width - left - max(_GAP, overhang + 1)


def _text_strip(layout: _Layout, text: str, size: int) -> Image.Image:
    """Wrapped text over the width of the sheet."""
    font = _font(size)
    lines = _wrap(text, font, layout.sheet_width - 2 * _GAP)
    strip = _blank(layout, _text_height(len(lines), size) + _GAP)
    _write_lines(ImageDraw.Draw(strip), _GAP, _GAP // 2, lines, font, size)
    return strip


def _write_centred(
    strip: Image.Image, layout: _Layout, column: int, top: int, lines: Sequence[str], font: Font
) -> None:
    draw = ImageDraw.Draw(strip)
    middle = layout.cell_left(column) + layout.cell_width / 2
    for number, line in enumerate(lines):
        place = (middle - font.getlength(line) / 2, top + number * _LABEL_SIZE * _LEADING)
        draw.text(place, line, fill=_INK, font=font)


def _write_lines(
    draw: ImageDraw.ImageDraw, left: float, top: float, lines: Sequence[str], font: Font, size: int
) -> None:
    for number, line in enumerate(lines):
        draw.text((left, top + number * size * _LEADING), line, fill=_INK, font=font)


def _wrap(text: str, font: Font, width: float) -> list[str]:
    """Lines of whole words no wider than `width`; line ends of the text are kept."""
    lines = []
    for paragraph in text.split("\n"):
        line = ""
        for word in paragraph.split():
            longer = f"{line} {word}".strip()
            if line and font.getlength(longer) > width:
                lines.append(line)
                longer = word
            line = longer
        lines.append(line)
    return lines


def _text_height(lines: int, size: int) -> int:
    return int(np.ceil(lines * size * _LEADING)) + (4 if lines else 0)


def _font(size: int) -> Font:
    return ImageFont.load_default(size=size)


def _blank(layout: _Layout, height: int) -> Image.Image:
    return Image.new("L", (layout.sheet_width, height), _PAPER)


def _checked_shape(
    images: Sequence[Sequence[Grey | None]],
    row_labels: Sequence[str],
    column_labels: Sequence[str],
    cell_labels: Sequence[Sequence[str]] | None,
) -> tuple[int, int]:
    """Height and width of the images, after all checks of the sheet's input."""
    where = "contact sheet"
    if len(row_labels) != len(images):
        raise InputError(where, "row labels", list(row_labels), f"not {len(images)}", "give one for each row")
    if any(len(row) != len(column_labels) for row in images):
        counts = [len(row) for row in images]
        raise InputError(where, "rows", counts, f"not {len(column_labels)} images each", "fill gaps with None")
    if cell_labels is not None and [len(row) for row in cell_labels] != [len(row) for row in images]:
        raise InputError(where, "cell labels", cell_labels, "not one for each cell", "use '' where there is none")
    given = [image for row in images for image in row if image is not None]
    if not given:
        raise InputError(where, "images", [], "none", "give one image at least")
    for image in given:
        if image.ndim != 2 or image.dtype != np.uint8 or image.shape != given[0].shape:
            found = (image.shape, str(image.dtype))
            raise InputError(where, "image", found, f"not uint8 of shape {given[0].shape}", "give images of one size")
    return given[0].shape[0], given[0].shape[1]
