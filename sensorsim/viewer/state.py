"""All that decides what the window shows, as one frozen value, and how the display's knobs change it."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from datetime import date

from sensorsim.effects import EffectChoice
from sensorsim.radiometry import FloatArray
from sensorsim.render import EVERY_EFFECT, Camera
from sensorsim.render.air import DEFAULT_ATMOSPHERE
from sensorsim.sensor import DisplaySettings

GAIN_STEP = 1.25  # of the window's width, for a press of a key
LEVEL_STEP = 0.05  # of the window's width


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """What a world is baked of."""

    level: str
    weather: str  # a name that comes with the package, or a file
    day: date
    choice: EffectChoice = EVERY_EFFECT  # of the effects


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ViewState:
    """Camera, clock, sensors and switches."""

    camera: Camera
    time_of_day: float  # [s]
    place: Place  # asked for; the picture is of the last one that is baked
    sensors: tuple[str, str]  # the picture's, and the second one's where there are two side by side
    playing: bool = False
    play_speed: float = 600.0  # [s of the day per second]
    speed: float = 40.0  # [m s-1]
    orbit: FloatArray | None = None  # (3,) point that the camera circles
    side_by_side: bool = False
    displays: Mapping[str, DisplaySettings] = field(default_factory=dict)  # by sensor, where it is not its own
    palette: str = "grey"
    atmosphere: str = DEFAULT_ATMOSPHERE
    noise: bool = True
    blur: bool = True
    scale: float | None = None  # window pixels per pixel drawn, None for as many as keep it fluid
    symbology: bool = True
    probe: bool = True
    panels: bool = True
    help: bool = False
    effects: bool = False  # whether they are listed
    recording: bool = False
    replaying: bool = False
    station: int = 0  # of the scene's cameras, the last one jumped to
    moved: bool = False  # whether the pilot has found the keys
    quit: bool = False
    frame: int = 0  # number of the picture, which decides its noise

    @property
    def drawn(self) -> tuple[str, ...]:
        """Names of the sensors on show, from left to right."""
        return self.sensors if self.side_by_side else self.sensors[:1]

    def display_of(self, sensor: str, own: DisplaySettings) -> DisplaySettings:
        """How a sensor is displayed: as the user set it, else as its description has it."""
        return self.displays.get(sensor, own)


def with_display(state: ViewState, sensor: str, display: DisplaySettings) -> ViewState:
    """The state with a sensor displayed so."""
    return replace(state, displays={**state.displays, sensor: display})


def with_sensor(state: ViewState, sensor: str) -> ViewState:
    """The state with that sensor as the picture's; the second one changes places with it where it was that one."""
    first, second = state.sensors
    return replace(state, sensors=(sensor, first if second == sensor else second))


def other_polarity(display: DisplaySettings) -> DisplaySettings:
    """White-hot for black-hot and back."""
    return replace(display, polarity="black-hot" if display.polarity == "white-hot" else "white-hot")


def other_gain(display: DisplaySettings, shown: DisplaySettings) -> DisplaySettings:
    """Automatic for manual and back; manual holds the window that the last picture was shown with."""
    if display.is_automatic:
        return replace(display, level=shown.level, span=shown.span)
    return replace(display, level=None, span=None)


def with_gain(display: DisplaySettings, shown: DisplaySettings, steps: float) -> DisplaySettings:
    """Gain raised by steps, held by hand from then on; the window's middle stays."""
    held = display if not display.is_automatic else other_gain(display, shown)
    assert held.span is not None
    return replace(held, span=max(held.span / GAIN_STEP**steps, 1e-12))


def with_level(display: DisplaySettings, shown: DisplaySettings, steps: float) -> DisplaySettings:
    """Level raised by steps of the window's width, held by hand from then on: a higher level is a darker picture."""
    held = display if not display.is_automatic else other_gain(display, shown)
    assert held.level is not None
    assert held.span is not None
    return replace(held, level=held.level + steps * LEVEL_STEP * held.span)


def other_tone(display: DisplaySettings) -> DisplaySettings:
    """Straight for equalised greys and back."""
    return replace(display, tone="plateau" if display.tone == "linear" else "linear")
