"""The hour of the day: scrubbing, playing, and the strip that shows where day and night are."""

import numpy as np

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.environment import Environment
from sensorsim.radiometry import FloatArray

SCRUB_RATE = 5400.0  # [s of the day per second] while a key is held
PLAY_SPEEDS = (1.0, 60.0, 300.0, 600.0, 1800.0, 3600.0)  # [s of the day per second]

# Colours of the strip (red, green, blue from 0 to 1) at elevations of the sun [deg].
_ELEVATIONS = (-18.0, -6.0, 0.0, 6.0, 30.0)
_COLOURS = ((0.02, 0.03, 0.09), (0.09, 0.10, 0.26), (0.78, 0.42, 0.24), (0.95, 0.80, 0.52), (0.55, 0.76, 0.96))


def run_clock(time_of_day: float, speed: float, seconds: float) -> float:
    """Time of the day [s] after `seconds` at a speed [s s-1]; midnight is followed by the same day's morning."""
    return float((time_of_day + speed * seconds) % SECONDS_PER_DAY)


def clock_text(time_of_day: float) -> str:
    """Hours and minutes, 24:00 at the end of the day."""
    minutes = int(time_of_day // 60.0)
    return f"{minutes // 60:02d}:{minutes % 60:02d}"


def read_clock(text: str) -> float | None:
    """Time of the day [s] of HH:MM or HH:MM:SS, None where it is none."""
    parts = text.split(":")
    if not 2 <= len(parts) <= 3 or not all(part.isascii() and part.isdigit() for part in parts):
        return None
    hours, minutes, seconds = (*map(int, parts), 0)[:3]
    total = 3600.0 * hours + 60.0 * minutes + seconds
    return total if minutes < 60 and seconds < 60 and total <= SECONDS_PER_DAY else None


def day_strip(environment: Environment, count: int) -> FloatArray:
    """Colours (count, 3), 0 to 1, from midnight to midnight: night, twilight, low sun, day."""
    elevation = _elevation(environment, np.linspace(0.0, SECONDS_PER_DAY, count))
    return np.column_stack([np.interp(elevation, _ELEVATIONS, [c[i] for c in _COLOURS]) for i in range(3)])


def sun_times(environment: Environment) -> tuple[float | None, float | None]:
    """Sunrise and sunset [s] of the image day, to the minute; None where the sun does not rise or set."""
    minute = np.linspace(0.0, SECONDS_PER_DAY, 1441)
    up = _elevation(environment, minute) > 0.0
    rises, sets = np.flatnonzero(up[1:] & ~up[:-1]), np.flatnonzero(~up[1:] & up[:-1])
    return (
        float(minute[rises[0] + 1]) if rises.size else None,
        float(minute[sets[-1] + 1]) if sets.size else None,
    )


def _elevation(environment: Environment, time_of_day: FloatArray) -> FloatArray:
    window = environment.image_window
    time = environment.time[window] - environment.time[window.start]
    return np.interp(time_of_day, time, environment.sun_elevation[window])
