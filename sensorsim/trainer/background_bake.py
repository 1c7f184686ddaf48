"""Bakes in a thread beside the frames, one at a time; what was asked for last is baked next."""

import os
import threading
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime

from sensorsim.errors import SensorsimError
from sensorsim.render import World
from sensorsim.trainer.bake_request import BakeRequest

LOW_PRIORITY = 10  # of the thread: frames come first


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Baked:
    """How a bake ended: a world, or the reason why there is none."""

    request: BakeRequest
    world: World | None
    reason: str


class BackgroundBake:
    """Makes worlds of requests. The thread is a daemon: a bake under way does not keep the program from ending."""

    def __init__(self, bake: Callable[[BakeRequest, datetime], World]) -> None:
        self._bake = bake
        self._asked: BakeRequest | None = None
        self._thread: threading.Thread | None = None
        self._done: Baked | None = None

    def ask(self, request: BakeRequest | None, moment: datetime) -> None:
        """Begins the bake of a request, unless it is the last one begun or another is under way."""
        if request is None or request == self._asked or self._thread is not None:
            return
        self._asked = request
        self._thread = threading.Thread(target=self._run, args=(request, moment), daemon=True)
        self._thread.start()

    def take(self) -> Baked | None:
        """What the last bake came to, once; None while there is nothing new."""
        if self._thread is None or self._thread.is_alive():
            return None
        self._thread.join()
        self._thread, done, self._done = None, self._done, None
        return done

    def _run(self, request: BakeRequest, moment: datetime) -> None:
        os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), LOW_PRIORITY)
        try:
            self._done = Baked(request=request, world=self._bake(request, moment), reason="")
        except SensorsimError as error:
            self._done = Baked(request=request, world=None, reason=str(error))
        except BaseException as error:  # the frames go on, and the host is told
            self._done = Baked(request=request, world=None, reason=f"{type(error).__name__}: {error}")
