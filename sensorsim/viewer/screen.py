"""One frame of the window: pictures, symbols, panels. Needs the extra `viewer`."""

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from imgui_bundle import imgui

from sensorsim.radiometry import FloatArray
from sensorsim.render import World
from sensorsim.viewer.actions import Seen
from sensorsim.viewer.baker import Baker
from sensorsim.viewer.choices import centre_range
from sensorsim.viewer.clock import clock_text, day_strip, sun_times
from sensorsim.viewer.effects_panel import effects_panel
from sensorsim.viewer.fit_errors import FitMeter
from sensorsim.viewer.gui import Gui
from sensorsim.viewer.overlay import HINT, Box, draw_notes, draw_scale, draw_symbols, help_page
from sensorsim.viewer.palettes import palette_table, scale_values
from sensorsim.viewer.panels import STRIP_HEIGHT, WIDTH, Facts, panel, time_strip
from sensorsim.viewer.probe import day_of_surface, histogram, probe_pixel
from sensorsim.viewer.probe_panel import probe_panel
from sensorsim.viewer.recording import Recording
from sensorsim.viewer.stage import Shot, Stage, picture_tone
from sensorsim.viewer.state import Place, ViewState
from sensorsim.viewer.symbology import Status, polarity_text, symbols
from sensorsim.viewer.window import Events, Window

STRIP_STEPS = 192  # of the strip of day and night


class Showing(Protocol):
    """What the loop lends to a frame."""

    state: ViewState
    window: Window
    shots: tuple[Shot, ...]
    stage: Stage
    baker: Baker
    meter: FitMeter
    baked: Place
    recording: Recording
    clock: float
    note: str
    note_until: float
    still: bool  # whether the camera rests


def picture_box(size: tuple[int, int], *, panels: bool) -> Box:
    """Left, top, width and height of the window's part for pictures."""
    left, below = (WIDTH, STRIP_HEIGHT) if panels else (0.0, 0.0)
    return left, 0.0, max(16.0, size[0] - left), max(16.0, size[1] - below)


def shared_boxes(box: Box, count: int) -> tuple[Box, ...]:
    """The box cut into so many, side by side."""
    width = box[2] / count
    return tuple((box[0] + index * width, box[1], width, box[3]) for index in range(count))


class Screen:
    """Draws frames; remembers what need not be worked out anew for each."""

    def __init__(self, gui: Gui, world: World) -> None:
        self.gui = gui
        self.seen: Seen | None = None
        self.meet(world)

    def meet(self, world: World) -> None:
        """Show another world from now on."""
        self.world = world
        self.strip, self.sun = day_strip(world.environment, STRIP_STEPS), sun_times(world.environment)
        self._day: tuple[int, tuple[FloatArray, FloatArray]] | None = None

    def show(self, showing: Showing, events: Events, seconds: float) -> tuple[ViewState, tuple[str, ...]]:
        """Draw one frame into the window; the next state and the files that were asked for."""
        state, size = showing.state, showing.window.size
        box = picture_box(size, panels=state.panels)
        boxes = shared_boxes(box, len(showing.shots))
        self.gui.begin(size, seconds, events)
        for place, (part, shot) in enumerate(zip(boxes, showing.shots, strict=True)):
            self._picture(state, place, part, shot)
        asked: tuple[str, ...] = ()
        if state.panels and showing.shots and self.seen is not None:
            facts = self._facts(showing, self.seen)
            state, asked = panel(state, facts, float(size[1]))
            state = time_strip(state, facts, WIDTH, box[3], box[2])
        if state.effects and showing.shots and showing.shots[0].told.ledger is not None:
            state = effects_panel(state, showing.shots[0].told.ledger, box[0], box[1])
        if state.probe and showing.still:
            self._probe(showing, boxes, events.cursor)
        if state.help:
            help_page((0.0, 0.0, float(size[0]), float(size[1])))
        notes = [note for note in (showing.baker.note, showing.meter.note) if note]
        notes += [showing.note] if showing.clock < showing.note_until else []
        draw_notes(box, notes, at_top=not state.help)
        draw_notes(box, () if state.moved or state.help else HINT, at_top=False)
        self.gui.end()
        return state, asked

    def _picture(self, state: ViewState, place: int, box: Box, shot: Shot) -> None:
        texture = self.gui.picture(place, shot.colours)
        corner, opposite = imgui.ImVec2(box[0], box[1]), imgui.ImVec2(box[0] + box[2], box[1] + box[3])
        imgui.get_background_draw_list().add_image(texture, corner, opposite)
        if state.symbology:
            draw_symbols(box, symbols(state.camera, (box[2], box[3]), self._status(state, shot)))
            table, unit = shot.renderer.band_table, "W/(m2 sr)" if shot.renderer.band_table is None else "K"
            values = scale_values(shot.picture.display, table, 5, picture_tone(shot))
            draw_scale(box, palette_table(state.palette), values, unit)

    def _status(self, state: ViewState, shot: Shot) -> Status:
        camera, shown, table = state.camera, shot.picture.display, shot.renderer.band_table
        longitude, latitude = self.world.scene.frame.degrees_from_metres(np.atleast_2d(camera.position[:2]))[0]
        asked = state.display_of(shot.sensor.name, shot.sensor.display)
        extra = [name for name, on in (("REC", state.recording), ("REPLAY", state.replaying)) if on]
        extra += ["ORBIT"] if state.orbit is not None else []
        extra += ["EQUALISED"] if shown.tone != "linear" else []
        level, span, band = shown.level or 0.0, shown.span or 1.0, shot.sensor.band.wavelength
        if table is not None:
            ends = np.clip([level - span / 2, level, level + span / 2], table.radiance[0], table.radiance[-1])
            cold, middle, warm = table.apparent_temperature(ends)
            gain, text = f"{warm - cold:.1f} K WIDE", f"{middle:.1f} K"
        else:
            gain, text = f"{span:.3g} WIDE", f"{level:.3g} W/(m2 sr)"
        return Status(
            sensor=shot.sensor.name,
            band=f"{1e6 * band[0]:.3g}-{1e6 * band[-1]:.3g} um",
            polarity=polarity_text(shown.polarity, emissive=table is not None),
            automatic=asked.is_automatic, gain=gain, level=text, range=centre_range(shot),
            clock=f"{self.world.tables.day.isoformat()}  {clock_text(state.time_of_day)} LST",
            place=(float(latitude), float(longitude), float(camera.position[2])), extra=tuple(extra),
        )  # fmt: skip

    def _facts(self, showing: Showing, seen: Seen) -> Facts:
        first = showing.shots[0]
        height, width = first.picture.planes["display"].shape
        return Facts(
            seen=seen, baked=showing.baked, milliseconds=1000.0 * showing.stage.seconds, drawn=(width, height),
            strip=self.strip, sun=self.sun, histogram=histogram(first.told), recorded=len(showing.recording.time),
        )  # fmt: skip

    def _probe(self, showing: Showing, boxes: Sequence[Box], cursor: tuple[float, float]) -> None:
        """What is under the pointer, unless that is a panel."""
        if self.gui.takes_mouse:
            return
        for box, shot in zip(boxes, showing.shots, strict=True):
            height, width = shot.picture.planes["display"].shape
            column = int(np.floor((cursor[0] - box[0]) / box[2] * width))
            row = int(np.floor((cursor[1] - box[1]) / box[3] * height))
            probe = probe_pixel(self.world, shot.picture, column, row) if shot.is_told else None
            if probe is not None:
                day = None if probe.surface is None else self._day_of(probe.surface)
                errors, right = showing.meter.found(self.world), boxes[-1][0] + boxes[-1][2]
                probe_panel(probe, errors, day, showing.state.time_of_day, right, box[1])

    def _day_of(self, surface: int) -> tuple[FloatArray, FloatArray]:
        if self._day is None or self._day[0] != surface:
            self._day = surface, day_of_surface(self.world, surface)
        return self._day[1]
