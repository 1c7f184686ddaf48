"""Worlds baked in the background: the old picture flies on until the new world is whole."""

import threading
from collections.abc import Callable
from dataclasses import dataclass

from sensorsim.errors import SensorsimError
from sensorsim.render import World
from sensorsim.tables.bake import Progress
from sensorsim.viewer.state import Place

Build = Callable[[Place, Progress], World]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Baked:
    """A finished job: the world, or why there is none."""

    place: Place
    world: World | None
    problem: str


class Baker:
    """Builds the world that was asked for last, one at a time, in a thread."""

    def __init__(self, build: Build) -> None:
        self._build = build
        self._lock = threading.Lock()
        self._running: Place | None = None
        self._next: Place | None = None
        self._done: Baked | None = None
        self._note = ""

    @property
    def note(self) -> str:
        """How far the job is, empty where there is none."""
        with self._lock:
            return "" if self._running is None else f"baking {_name(self._running)} {self._note}".rstrip()

    @property
    def busy(self) -> bool:
        """Whether a job is under way or its world has not been collected."""
        with self._lock:
            return self._running is not None or self._done is not None

    def ask(self, place: Place) -> None:
        """Bake this next; of several that wait only the last is baked."""
        with self._lock:
            if self._running is not None:
                self._next = place
                return
            self._running, self._note = place, ""
        self._start(place)

    def collect(self) -> Baked | None:
        """The job that has ended since the last call, None where there is none."""
        with self._lock:
            done, self._done = self._done, None
        return done

    def _start(self, place: Place) -> None:
        threading.Thread(target=self._work, args=(place,), name="bake", daemon=True).start()

    def _work(self, place: Place) -> None:
        done = self._finish(place)
        with self._lock:
            following, self._next = self._next, None
            self._running, self._note = following, ""
            if following is None:
                self._done = done
        if following is not None:
            self._start(following)

    def _finish(self, place: Place) -> Baked:
        try:
            return Baked(place=place, world=self._build(place, self._report), problem="")
        except SensorsimError as error:
            return Baked(place=place, world=None, problem=str(error))
        except Exception as error:  # whatever ends the thread must be told to the person at the window
            return Baked(place=place, world=None, problem=f"{type(error).__name__}: {error}")

    def _report(self, name: str, done: int, total: int) -> None:
        with self._lock:
            self._note = f"{done} of {total} ({name})"


def _name(place: Place) -> str:
    return f"{place.level}, {place.weather}, {place.day.isoformat()}, effects {place.choice.text}"
