"""Symbols over the picture in the manner of a FLIR, as lines and texts in pixels; nothing here draws.

Conformal where it can be: the marks of the pitch ladder lie at the elevations that they name.
"""

import math
from dataclasses import dataclass

from sensorsim.render import Camera

Point = tuple[float, float]  # right and down of the picture's upper left corner [pixels]


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """A straight line."""

    start: Point
    end: Point


@dataclass(frozen=True, slots=True, kw_only=True)
class Label:
    """A text whose `anchor` (0 left or top, 1 right or bottom) lies at a point."""

    at: Point
    text: str
    anchor: Point = (0.0, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Status:
    """What the corner texts tell."""

    sensor: str
    band: str
    polarity: str  # WHT HOT and the like
    automatic: bool
    gain: str
    level: str
    range: float | None  # [m] of what is in the middle, None for the sky
    clock: str
    place: tuple[float, float, float]  # latitude, longitude [deg], height [m]
    extra: tuple[str, ...] = ()


Symbols = tuple[tuple[Line, ...], tuple[Label, ...]]


def symbols(camera: Camera, size: tuple[float, float], status: Status) -> Symbols:
    """All symbols of a picture of `size` (width, height) in pixels."""
    parts = (
        _reticle(size),
        heading_tape(camera.yaw, size[0]),
        pitch_ladder(camera, size),
        ((), _corners(camera, size, status)),
    )
    return tuple(line for lines, _ in parts for line in lines), tuple(label for _, labels in parts for label in labels)


def heading_tape(yaw: float, width: float) -> Symbols:
    """A tape of headings around the one flown, 60 degrees wide, at the top of a picture."""
    half, top, span = 0.18 * width, 30.0, 30.0
    middle = 0.5 * width
    lines = [Line(start=(middle - half, top), end=(middle + half, top))]
    labels = [Label(at=(middle, top + 13.0), text=f"{round(yaw) % 360:03d}", anchor=(0.5, 0.0))]
    lines.append(Line(start=(middle, top + 2.0), end=(middle, top + 11.0)))
    for mark in range(math.ceil((yaw - span) / 5.0) * 5, math.floor(yaw + span) + 1, 5):
        x = middle + (mark - yaw) / span * half
        tall = mark % 10 == 0
        lines.append(Line(start=(x, top), end=(x, top - (8.0 if tall else 4.0))))
        if mark % 30 == 0:
            labels.append(Label(at=(x, top - 9.0), text=compass_text(mark % 360), anchor=(0.5, 1.0)))
    return tuple(lines), tuple(labels)


def compass_text(heading: int) -> str:
    """N, E, S, W, or tens of degrees as on a runway."""
    return {0: "N", 90: "E", 180: "S", 270: "W"}.get(heading, f"{heading // 10:02d}")


def pitch_ladder(camera: Camera, size: tuple[float, float]) -> Symbols:
    """Rungs at true elevations straight ahead, the horizon the longest; none where the camera is rolled."""
    if camera.roll % 360.0 != 0.0:
        return (), ()
    width, height = size
    focal = 0.5 * width / math.tan(math.radians(0.5 * camera.horizontal_field_of_view))
    step = 1 if camera.horizontal_field_of_view < 12.0 else 2 if camera.horizontal_field_of_view < 25.0 else 5
    lines, labels = [], []
    for elevation in range(-90 + (90 % step), 91, step):
        away = elevation - camera.pitch
        if abs(away) >= 60.0:
            continue
        y = 0.5 * height - focal * math.tan(math.radians(away))
        if not 0.2 * height <= y <= 0.8 * height:
            continue
        half, gap = (0.16 if elevation == 0 else 0.08) * width, 0.05 * width
        for side in (-1.0, 1.0):
            start, end = 0.5 * width + side * gap, 0.5 * width + side * (gap + half)
            lines.append(Line(start=(start, y), end=(end, y)))
        text = "0" if elevation == 0 else f"{elevation:+d}"
        labels.append(Label(at=(0.5 * width + gap + half + 4.0, y), text=text, anchor=(0.0, 0.5)))
    return tuple(lines), tuple(labels)


def polarity_text(polarity: str, *, emissive: bool) -> str:
    """How the picture's greys run, in a FLIR's words, or for reflected light in a television's."""
    if emissive:
        return "WHT HOT" if polarity == "white-hot" else "BLK HOT"
    return "POSITIVE" if polarity == "white-hot" else "NEGATIVE"


def _reticle(size: tuple[float, float]) -> Symbols:
    """A cross with an open middle."""
    x, y = 0.5 * size[0], 0.5 * size[1]
    inner, outer = 6.0, 20.0
    arms = [((x + s * inner, y), (x + s * outer, y)) for s in (-1.0, 1.0)]
    arms += [((x, y + s * inner), (x, y + s * outer)) for s in (-1.0, 1.0)]
    return tuple(Line(start=start, end=end) for start, end in arms), ()


def _corners(camera: Camera, size: tuple[float, float], status: Status) -> tuple[Label, ...]:
    width, height = size
    latitude, longitude, up = status.place
    upper = (
        status.sensor.upper(),
        status.band,
        f"{status.polarity}  {'AUTO' if status.automatic else 'MAN'}",
        *status.extra,
    )
    lower_left = (
        status.clock,
        f"{abs(latitude):.5f} {'N' if latitude >= 0 else 'S'}  {abs(longitude):.5f} {'E' if longitude >= 0 else 'W'}",
        f"ALT {up:.0f} m   AZ {camera.yaw % 360.0:05.1f}   EL {camera.pitch:+05.1f}",
    )
    lower_right = (
        "RNG ---" if status.range is None else f"RNG {status.range:.0f} m",
        f"FOV {camera.horizontal_field_of_view:.1f} deg",
        f"GAIN {status.gain}",
        f"LVL {status.level}",
    )
    return (
        *_stack((12.0, 12.0), upper, (0.0, 0.0)),
        *_stack((12.0, height - 12.0), lower_left, (0.0, 1.0)),
        *_stack((width - 12.0, height - 12.0), lower_right, (1.0, 1.0)),
    )


LINE_HEIGHT = 19.0


def _stack(at: Point, texts: tuple[str, ...], anchor: Point) -> tuple[Label, ...]:
    """Texts below one another, the first on top, grown from a corner."""
    first = at[1] if anchor[1] == 0.0 else at[1] - LINE_HEIGHT * (len(texts) - 1)
    return tuple(
        Label(at=(at[0], first + LINE_HEIGHT * row), text=text, anchor=anchor) for row, text in enumerate(texts)
    )
