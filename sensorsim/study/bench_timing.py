"""Times of pieces of work that take turns, so that a machine that is busy for a while is busy for all of them."""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

WARM_UP = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class Times:
    """Medians of one piece of work."""

    wall: float  # [ms]
    processor: float  # [ms] of all threads


def measure(work: Mapping[str, Callable[[], Any]], turns: int) -> dict[str, Times]:
    """Do each piece of work once a turn and take the medians, after a few turns that do not count."""
    taken: dict[str, list[tuple[float, float]]] = {name: [] for name in work}
    for turn in range(WARM_UP + turns):
        for name, piece in work.items():
            wall, processor = time.perf_counter(), time.process_time()
            piece()
            both = time.perf_counter() - wall, time.process_time() - processor
            if turn >= WARM_UP:
                taken[name].append(both)
    medians = {name: 1e3 * np.median(np.array(times), axis=0) for name, times in taken.items()}
    return {name: Times(wall=float(value[0]), processor=float(value[1])) for name, value in medians.items()}
