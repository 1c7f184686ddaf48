"""The error of the tables' fit under the pointer, measured against the full solve on request, in the background."""

import threading
from dataclasses import dataclass

from sensorsim.errors import SensorsimError
from sensorsim.frames.fit_error import surface_fit_error
from sensorsim.radiometry import FloatArray
from sensorsim.render import World


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FitErrors:
    """Errors of all surfaces of a world at one hour."""

    world: World
    time_of_day: float  # [s]
    error: FloatArray  # (surfaces,) [K]


class FitMeter:
    """Solves the surfaces of a world in full, one request at a time."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._busy = False
        self._found: FitErrors | None = None
        self._problem = ""

    @property
    def note(self) -> str:
        """What is under way or went wrong, empty where nothing is."""
        with self._lock:
            return "measuring the error of the fit" if self._busy else self._problem

    def measure(self, world: World, time_of_day: float) -> None:
        """Begin; a request while another is under way is dropped."""
        with self._lock:
            if self._busy:
                return
            self._busy, self._problem = True, ""
        threading.Thread(target=self._work, args=(world, time_of_day), name="fit error", daemon=True).start()

    def found(self, world: World) -> FitErrors | None:
        """The last errors that were measured, where they are this world's."""
        with self._lock:
            return self._found if self._found is not None and self._found.world is world else None

    def _work(self, world: World, time_of_day: float) -> None:
        found, problem = None, ""
        try:
            error = surface_fit_error(world, time_of_day)
            found = FitErrors(world=world, time_of_day=time_of_day, error=error)
        except SensorsimError as failure:
            problem = str(failure)
        with self._lock:
            self._busy, self._problem = False, problem
            self._found = self._found if found is None else found
