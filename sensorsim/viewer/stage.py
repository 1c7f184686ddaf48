"""Pictures of a state, drawn off screen by one renderer for each sensor on show."""

import time
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from sensorsim.frames import Frame, take_frame
from sensorsim.gpu import create_context
from sensorsim.radiometry import FloatArray
from sensorsim.render import Picture, Renderer, World
from sensorsim.render.detail import DetailRule
from sensorsim.render.picture import exposed
from sensorsim.sensor import Sensor, tone_curve, window_limits
from sensorsim.viewer.palettes import Colours, paint, palette_table
from sensorsim.viewer.state import ViewState
from sensorsim.viewer.variants import varied

KEPT = 4  # renderers, so that going back to a sensor costs nothing
SCALES = (1.0, 1.5, 2.0, 3.0, 4.0)  # window pixels per pixel drawn
COARSEST = 3.0  # that is chosen without being asked for
STEADY = DetailRule(steady=True)
SLOW, QUICK = 0.080, 0.012  # [s] of a picture, beyond which the scale changes

Key = tuple[str, bool, bool, str, tuple[int, int]]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Shot:
    """One sensor's picture, in grey and in colour."""

    sensor: Sensor
    picture: Picture  # may have nothing but its display
    told: Picture  # the last one with all planes: this one, or one a few pictures ago
    colours: Colours
    renderer: Renderer

    @property
    def is_told(self) -> bool:
        """Whether all planes are of this picture."""
        return self.told is self.picture


class Stage:
    """A world, its sensors and their renderers; `release` gives the off-screen contexts back."""

    def __init__(
        self, world: World, sensors: Mapping[str, Sensor], backend: str = "auto", detail: DetailRule = STEADY
    ) -> None:
        """`detail` chooses among the levels of a scene that holds several."""
        self.world, self.sensors, self.backend, self.detail = world, sensors, backend, detail
        self.seconds = 0.0  # that the last pictures took
        self._rest = create_context(backend)
        self._renderers: dict[Key, Renderer] = {}
        self._told: dict[Renderer, Picture] = {}  # last pictures with all planes

    def swap(self, world: World) -> None:
        """Go on with another world."""
        self._drop()
        self.world = world

    def draw(self, state: ViewState, size: tuple[int, int], *, plain: bool = False) -> tuple[Shot, ...]:
        """Pictures of `size` (width, height) of the sensors on show, from left to right.

        `plain` ones have no planes but their display, which takes a quicker road; the first of each renderer is whole.
        """
        began, table = time.perf_counter(), palette_table(state.palette)
        try:
            return tuple(self._shot(state, name, size, table, plain=plain) for name in state.drawn)
        finally:
            with (
                self._rest
            ):  # leaving it leaves no context current, whatever happened: a window's may be of another kind
                self.seconds = time.perf_counter() - began

    def frame(self, state: ViewState, shot: Shot) -> Frame:
        """The same picture again as a frame with all that made it, its display window held."""
        window = shot.picture.display
        return take_frame(shot.renderer, state.camera, state.time_of_day, display=window, frame=state.frame)

    def release(self) -> None:
        """Give back all contexts."""
        self._drop()
        self._rest.release()

    def _drop(self) -> None:
        for renderer in self._renderers.values():
            renderer.release()
        self._renderers.clear()
        self._told.clear()

    def _shot(self, state: ViewState, name: str, size: tuple[int, int], table: Colours, *, plain: bool) -> Shot:
        renderer = self._renderer(state, name, size)
        display = state.display_of(name, self.sensors[name].display)
        planes = ("display",) if plain and renderer in self._told else None
        picture = renderer.render(state.camera, state.time_of_day, display=display, frame=state.frame, planes=planes)
        if planes is None:
            self._told[renderer] = picture
        told, colours = self._told[renderer], paint(picture.planes["display"], table)
        return Shot(sensor=renderer.sensor, picture=picture, told=told, colours=colours, renderer=renderer)

    def _renderer(self, state: ViewState, name: str, size: tuple[int, int]) -> Renderer:
        key = (name, state.noise, state.blur, state.atmosphere, size)
        renderer = self._renderers.pop(key, None)
        if renderer is None:
            while len(self._renderers) >= KEPT:
                dropped = self._renderers.pop(next(iter(self._renderers)))
                self._told.pop(dropped, None)
                dropped.release()
            sensor = varied(self.sensors[name], noise=state.noise, blur=state.blur)
            renderer = Renderer(
                self.world, sensor, size=size, backend=self.backend, atmosphere=state.atmosphere, detail=self.detail
            )
        self._renderers[key] = renderer  # the one used last stands last
        return renderer


def picture_tone(shot: Shot) -> FloatArray | None:
    """Tone curve of a picture whose greys are no straight line, None for one whose are."""
    display = shot.picture.display
    if display.is_straight:
        return None
    low, high = window_limits(display)
    return tone_curve(display.tone, display.gamma, exposed(shot.told.planes), low, high)


def drawn_size(width: float, height: float, pictures: int, scale: float) -> tuple[int, int]:
    """Pixels (width, height) to draw for a part of the window, shared by so many pictures side by side."""
    return max(16, round(width / pictures / scale)), max(16, round(height / scale))


def next_scale(scale: float, seconds: FloatArray) -> float:
    """Scale to go on with after the last pictures took so long [s]: a step coarser where slow, finer where quick."""
    if seconds.size < 8:
        return scale
    middle, index = float(np.median(seconds)), SCALES.index(scale)
    if middle > SLOW and scale < COARSEST:
        return SCALES[index + 1]
    if middle < QUICK and index > 0:
        return SCALES[index - 1]
    return scale
