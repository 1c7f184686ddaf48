"""Sensor Control made a picture: band radiance to display codes as the host's knobs have it.

In the order of the signal: AC coupling along the scan, noise, gain and level (or automatic), lines dropped, polarity.
Polarity comes last and turns every code c into 255 - c, so black-hot is the mirror of white-hot whatever else is set.
The sensor's own noise and coupling are in the radiance already; the host's come on top.
"""

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from sensorsim.errors import InputError, NumericsError
from sensorsim.sensor import DisplaySettings, display_code, fix_window
from sensorsim.sensor.display import Polarity
from sensorsim.trainer.host_state import SensorState
from sensorsim.trainer.rotations import FloatArray

CONTRAST = 100.0  # widest window over narrowest
NOISIEST = 0.25  # standard deviation of noise 1, as a share of the window
DROPPED = 0.05  # share of lines
WHITE = 255


@dataclass(frozen=True, slots=True, kw_only=True)
class Knobs:
    """What the ends of the knobs stand for.

    darkest, brightest: band radiance [W m-2 sr-1] that level 0 and 1 can bring to the middle, and gain 0 shows whole.
    line_time [s]: of one line's visible part, for AC coupling; RS-170's by default.
    """

    darkest: float
    brightest: float
    line_time: float = 52.7e-6

    def __post_init__(self) -> None:
        """Refuse a range that is none."""
        if not (np.isfinite([self.darkest, self.brightest]).all() and self.darkest < self.brightest):
            values = (self.darkest, self.brightest)
            raise InputError("sensor knobs", "darkest, brightest", values, "no range", "give two band radiances")
        if not 0.0 < self.line_time < 1.0:
            raise InputError("sensor knobs", "line_time", self.line_time, "not 0 to 1 s", "give seconds")


def display_settings(control: SensorState, knobs: Knobs) -> DisplaySettings:
    """Polarity and window. Gain 0 shows the whole range, gain 1 a hundredth of it, evenly in ratio.

    Level is brightness: 0 puts the brightest radiance in the middle and so darkens the picture, 1 the darkest. With
    automatic gain both are chosen from each frame.
    """
    polarity: Polarity = "black-hot" if control.black_hot else "white-hot"
    if control.auto_gain:
        return DisplaySettings(polarity=polarity)
    wide = knobs.brightest - knobs.darkest
    level = knobs.brightest - control.level * wide
    return DisplaySettings(polarity=polarity, level=level, span=wide * CONTRAST**-control.gain)


def sensor_picture(
    radiance: npt.ArrayLike, control: SensorState, knobs: Knobs, frame: int, *, seen: npt.ArrayLike | None = None
) -> npt.NDArray[np.uint8]:
    """Display codes (h, w) of band radiance (h, w) [W m-2 sr-1]; black when the sensor is off.

    seen: the radiances that automatic gain goes by, of any shape; the whole picture's where it is left out.
    Noise and dropped lines are those of the frame's number, so a frame can be made again. NumericsError for radiance
    that is no picture of finite numbers.
    """
    signal = np.asarray(radiance, dtype=np.float64)
    if signal.ndim != 2 or signal.size == 0 or not np.isfinite(signal).all():
        raise NumericsError(f"sensor picture: radiance of shape {signal.shape} must be a picture of finite numbers")
    if not control.on:
        return np.zeros(signal.shape, dtype=np.uint8)
    rng = np.random.default_rng([frame, control.view, control.sensor])
    signal = ac_coupled(signal, control.ac_coupling * 1e-6, knobs.line_time)
    window = fix_window(display_settings(control, knobs), signal if seen is None else seen)
    if control.noise > 0.0 and window.span is not None:
        signal = signal + rng.normal(0.0, control.noise * NOISIEST * window.span, signal.shape)
    codes = display_code(signal, replace(window, polarity="white-hot"))
    if control.line_dropout:
        codes[rng.random(len(codes)) < DROPPED] = 0
    return np.asarray(WHITE - codes if control.black_hot else codes, dtype=np.uint8)


def ac_coupled(signal: FloatArray, decay: float, line_time: float) -> FloatArray:
    """The signal (h, w) after a capacitor with that decay constant [s], its mean restored; as it is for 0.

    The scan runs line by line, so what is hot leaves a shadow to its right and on the next line. The slow part that is
    taken away starts at the picture's mean.
    """
    if decay == 0.0:
        return signal
    from scipy.signal import lfilter  # takes longer to load than most commands take to work

    kept = float(np.exp(-line_time / (signal.shape[1] * decay)))
    mean = float(signal.mean())
    scan = signal.ravel() - mean
    slow, _ = lfilter([1.0 - kept], [1.0, -kept], scan, zi=[0.0])
    return np.asarray(signal - slow.reshape(signal.shape))
