"""The loop of the window: inputs, next state, pictures, panels, files. Needs the extra `viewer`."""

import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from sensorsim.errors import SensorsimError
from sensorsim.frames.camera_path import CameraPath
from sensorsim.render import World
from sensorsim.render.air import DEFAULT_ATMOSPHERE
from sensorsim.render.detail import DetailRule
from sensorsim.sensor import Sensor
from sensorsim.viewer.actions import FILE_ACTIONS, Inputs, advance, press
from sensorsim.viewer.baker import Baker, Build
from sensorsim.viewer.choices import Days, named, seen
from sensorsim.viewer.clock import read_clock
from sensorsim.viewer.effect_list import same_bake, with_choice
from sensorsim.viewer.files import free_path, save_picture, save_planes, save_window
from sensorsim.viewer.fit_errors import FitMeter
from sensorsim.viewer.gui import Gui
from sensorsim.viewer.keys import PRESSED
from sensorsim.viewer.pace import Pace
from sensorsim.viewer.recording import Recording, camera_at, write_camera_path
from sensorsim.viewer.screen import Screen, picture_box
from sensorsim.viewer.script import FRAME_TIME, Step, due
from sensorsim.viewer.stage import STEADY, Shot, Stage, drawn_size
from sensorsim.viewer.state import Place, ViewState, with_sensor
from sensorsim.viewer.window import Events, Window

LONGEST_STEP = 0.1  # [s] that a frame moves the camera by, however long it took
NOTE_TIME = 5.0  # [s] that a note stays


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ViewerOptions:
    """What does not change while the window is open."""

    size: tuple[int, int]  # of the window [pixels]
    folder: Path  # of what is saved
    sensors: Mapping[str, Sensor]  # that can be chosen, by name
    days: Days
    build: Build
    backend: str = "auto"
    detail: DetailRule = STEADY
    flight: CameraPath | None = None  # to replay
    script: tuple[Step, ...] | None = None
    frames: int | None = None  # after which the window closes


class Viewer:
    """A window on a world. Use `run_viewer`."""

    def __init__(self, world: World, state: ViewState, options: ViewerOptions) -> None:
        self.state, self.options = state, options
        self.window = Window(f"sensorsim: {named(world.scene.name)}", options.size)
        with self.window.ctx:
            self.gui = Gui(self.window.ctx)
        self.screen = Screen(self.gui, world)
        self.stage = Stage(world, options.sensors, options.backend, options.detail)
        self.baker, self.meter = Baker(options.build), FitMeter()
        self.drawn = state  # the last state that made a picture
        self.still = True  # whether the camera rests
        self.baked = self.asked = state.place
        self.shots: tuple[Shot, ...] = ()
        self.recording, self.flight, self.flown = Recording(), options.flight, 0.0
        self.clock, self.began, self.frames = 0.0, time.perf_counter(), 0
        self.note, self.note_until = "", 0.0
        self.script_held: set[str] = set()
        self.cursor = (-1.0, -1.0)
        self.pace = Pace()

    def run(self) -> None:
        """Until the window is closed."""
        while not (self.state.quit or self.window.is_closing or self.frames == self.options.frames):
            self._frame()
            self.frames += 1

    def release(self) -> None:
        """Close the window and give all contexts back."""
        self.stage.release()
        with self.window.ctx:
            self.gui.release()
        self.window.release()

    def _frame(self) -> None:
        seconds = self._tick()
        events = self.window.poll()
        inputs = self._inputs(events, seconds)
        self._step(inputs, seconds)
        self._follow_bake()
        box = picture_box(self.window.size, panels=self.state.panels)
        scale = self.state.scale or self.pace.scale
        self._draw(drawn_size(box[2], box[3], len(self.state.drawn), scale))
        self._fit_scale()
        with self.window.ctx:
            self.state, asked = self.screen.show(self, events, seconds)
            self.window.show()
        events.clear()
        for action in (*asked, *(PRESSED.get(key, "") for key in inputs.pressed)):
            if action in FILE_ACTIONS:
                self._file(action)

    def _draw(self, size: tuple[int, int]) -> None:
        """Pictures of the state, or of the last one that could be drawn where this one cannot.

        In a world that is new there is no last one: the plain display and air are the way back then.
        """
        plain = self.pace.plain(moves=self._moves())
        try:
            self.shots = self.stage.draw(self.state, size, plain=plain)
        except SensorsimError as error:
            self._say(str(error))
            if self.shots:
                self.state = replace(self.drawn, place=self.state.place, frame=self.state.frame)
            else:
                self.state = replace(self.state, displays={}, atmosphere=DEFAULT_ATMOSPHERE)
            self.shots = self.stage.draw(self.state, size)
        self.drawn = self.state

    def _moves(self) -> bool:
        """Whether the camera flies, or the hour runs and nothing is pointed at."""
        self.still = self.state.camera is self.drawn.camera
        runs = self.state.time_of_day != self.drawn.time_of_day
        return not self.still or (runs and (not self.state.probe or self.gui.takes_mouse))

    def _tick(self) -> float:
        """Seconds since the last frame; those of a script are all alike."""
        now = time.perf_counter()
        past, self.began = now - self.began, now
        seconds = min(past, LONGEST_STEP) if self.options.script is None else FRAME_TIME
        self.clock += seconds
        return seconds

    def _inputs(self, events: Events, seconds: float) -> Inputs:
        """What hand, gamepad and script did; what a panel takes is not for the flight."""
        free = not self.gui.takes_mouse
        down = free and bool(events.buttons & {0, 1}) and not any(button in (0, 1) for button, _ in events.clicks)
        drag = (events.cursor[0] - self.cursor[0], events.cursor[1] - self.cursor[1]) if down else (0.0, 0.0)
        self.cursor = events.cursor
        typing = self.gui.takes_keys
        pressed = [] if typing else [name for name, is_down in events.keys if is_down]
        held = set() if typing else events.held | set(pressed)  # a tap between two frames counts as one frame
        if "Q" in held and not held.isdisjoint({"LEFT_CONTROL", "RIGHT_CONTROL"}):
            self.state = replace(self.state, quit=True)
        inputs = Inputs(
            held=frozenset(held), pressed=tuple(pressed), drag=drag, wheel=events.wheel if free else 0.0,
            stick=self.window.stick(),
        )  # fmt: skip
        return inputs if self.options.script is None else self._scripted(inputs, events, seconds)

    def _scripted(self, inputs: Inputs, events: Events, seconds: float) -> Inputs:
        """The same with what the script does in this frame."""
        pressed, drag, wheel = list(inputs.pressed), inputs.drag, inputs.wheel
        for step in due(self.options.script or (), self.clock - seconds, self.clock):
            match step.command:
                case "hold":
                    self.script_held.add(step.words[0])
                case "release":
                    self.script_held.discard(step.words[0])
                case "press":
                    pressed.append(step.words[0])
                case "drag":
                    drag = (drag[0] + step.numbers[0], drag[1] + step.numbers[1])
                case "wheel":
                    wheel += step.numbers[0]
                case "mouse":
                    events.cursor = self.cursor = (step.numbers[0], step.numbers[1])
                case _:
                    self._command(step)
        held = inputs.held | self.script_held
        return replace(inputs, held=held, pressed=tuple(pressed), drag=drag, wheel=wheel)

    def _command(self, step: Step) -> None:
        """Commands of a script that no key has."""
        match step.command:
            case "time":
                self.state = replace(self.state, time_of_day=read_clock(step.words[0]) or 0.0)
            case "sensor" if step.words[0] in self.options.sensors:
                self.state = with_sensor(self.state, step.words[0])
            case "sensor":
                self._say(f"no sensor {step.words[0]}")
            case "wait":
                while self.baker.busy and self.baked != self.asked:
                    self._follow_bake()
                    time.sleep(0.01)
            case "quit":
                self.state = replace(self.state, quit=True)

    def _step(self, inputs: Inputs, seconds: float) -> None:
        """The next state."""
        width = picture_box(self.window.size, panels=self.state.panels)[2]
        facts = seen(self.stage.world, self.options.sensors, self.shots, self.options.days, width)
        self.screen.seen = facts
        for key in inputs.pressed:
            self.state = press(self.state, key, facts)
        self.state = advance(self.state, inputs, facts, seconds)
        if self.state.replaying and self.flight is not None:
            self.flown += seconds
            over = self.flown >= self.flight.time[-1] - self.flight.time[0]
            self.state = replace(self.state, camera=camera_at(self.flight, self.flown), replaying=not over, moved=True)
        if self.state.recording:
            self.recording = self.recording.add(self.clock, self.state.camera)

    def _follow_bake(self) -> None:
        """Ask for the world that the state wants, and take in the one that is done."""
        if self.state.place != self.asked:
            self.asked = self.state.place
            if same_bake(self.asked, self.baked) and not self.baker.busy:
                self._meet(with_choice(self.stage.world, self.asked.choice), self.asked)
                return
            self.baker.ask(self.asked)
        done = self.baker.collect()
        if done is None:
            return
        if done.world is None:
            self._say(done.problem)
            self.state = replace(self.state, place=self.baked)
            self.asked = self.baked
            return
        self._meet(done.world, done.place)
        if done.world.warnings:
            self._say(done.world.warnings[0])

    def _meet(self, world: World, place: Place) -> None:
        """Go on with a world, whole from one picture to the next."""
        self.stage.swap(world)
        self.screen.meet(world)
        self.baked, self.shots = place, ()

    def _fit_scale(self) -> None:
        """Fewer pixels where pictures are slow; a script's are always as many, and a bake passes."""
        if self.options.script is not None or self.baker.busy:
            return
        self.pace.took(self.stage.seconds)

    def _file(self, action: str) -> None:
        """Write what was asked for and say so; a disk that refuses ends nothing."""
        try:
            self._say(self._write(action))
        except SensorsimError as error:
            self._say(str(error))

    def _write(self, action: str) -> str:
        folder = self.options.folder
        if action == "save_window":
            with self.window.ctx:
                return f"wrote {save_window(self.gui.read(), folder)}"
        if action == "measure":
            self.meter.measure(self.stage.world, self.state.time_of_day)
            return "solving every surface in full for this hour"
        if action in ("record", "replay"):
            return self._record() if action == "record" else self._replay()
        written = []
        for shot in self.shots:
            frame = self.stage.frame(self.state, shot)
            stem = f"{named(self.stage.world.scene.name)}_{shot.sensor.name}"
            save = save_picture if action == "save_picture" else save_planes
            written.append(str(save(frame, folder, stem)))
        return f"wrote {' and '.join(written)}"

    def _record(self) -> str:
        """Begin a recording, or end it and write it."""
        if not self.state.recording:
            self.recording = Recording()
            self.state = replace(self.state, recording=True, replaying=False)
            return "recording the flight; R ends it"
        self.state = replace(self.state, recording=False)
        self.flight = self.recording.path()
        path = free_path(self.options.folder, "flight", ".csv")
        write_camera_path(path, self.flight, self.stage.world.scene.frame)
        return f"wrote {path}"

    def _replay(self) -> str:
        if self.flight is None:
            return "nothing to replay: record with R, or start with --path"
        self.flown = 0.0
        self.state = replace(self.state, replaying=not self.state.replaying, orbit=None)
        return "flying the recorded path" if self.state.replaying else "replay ended"

    def _say(self, text: str) -> None:
        self.note, self.note_until = text, self.clock + NOTE_TIME


def run_viewer(world: World, state: ViewState, options: ViewerOptions) -> ViewState:
    """Open a window on a world and let it fly; the state that it was left in.

    Raises GraphicsError where there is no display.
    """
    viewer = Viewer(world, state, options)
    try:
        viewer.run()
    finally:
        viewer.release()
    return viewer.state
