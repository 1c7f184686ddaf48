"""Timed inputs from a file, so that a flight can be repeated without hands: for checks and for films.

Lines of `SECONDS COMMAND ARGUMENTS`, times not falling; `#` begins a note. A script runs at 30 frames a second of its
own clock, however long each takes.

    hold KEY            a key goes down and stays down         release KEY       and comes up again
    press KEY           down and up at once                    drag RIGHT DOWN   the picture, in pixels
    wheel NOTCHES       over the picture                       time HH:MM        set the clock
    sensor NAME         choose the sensor                      mouse X Y         rest the pointer there, in pixels
    wait bake           until the last bake is in the picture  quit              leave
"""

import math
from dataclasses import dataclass
from pathlib import Path

from sensorsim.errors import InputError
from sensorsim.viewer.clock import read_clock
from sensorsim.viewer.keys import known_keys

FRAME_TIME = 1.0 / 30.0  # [s] of a script
_ARGUMENTS = {
    "hold": "KEY", "release": "KEY", "press": "KEY", "drag": "RIGHT DOWN", "wheel": "NOTCHES", "time": "HH:MM",
    "sensor": "NAME", "mouse": "X Y", "wait": "bake", "quit": "",
}  # fmt: skip
_NUMBERS = ("drag", "wheel", "mouse")


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """One line of a script."""

    time: float  # [s]
    command: str
    words: tuple[str, ...]

    @property
    def numbers(self) -> tuple[float, ...]:
        """The arguments as numbers."""
        return tuple(map(float, self.words))


def read_script(path: Path) -> tuple[Step, ...]:
    """Steps of a script; InputError names file, line, value and remedy for whatever is none."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(path, "file", path.name, f"cannot be read ({error})", "name a text file") from error
    steps: list[Step] = []
    for number, line in enumerate(lines, start=1):
        words = line.split("#", 1)[0].split()
        if words:
            steps.append(_step(f"{path} line {number}", words, steps[-1].time if steps else 0.0))
    return tuple(steps)


def due(steps: tuple[Step, ...], start: float, end: float) -> tuple[Step, ...]:
    """Steps with times from `start` to before `end` [s]."""
    return tuple(step for step in steps if start <= step.time < end)


def _step(where: str, words: list[str], earliest: float) -> Step:
    try:
        time = float(words[0])
    except ValueError:
        time = math.nan
    if not (math.isfinite(time) and time >= earliest):
        raise InputError(where, "time", words[0], f"no time from {earliest:g} s on", "sort the lines by time")
    command = words[1] if len(words) > 1 else ""
    if command not in _ARGUMENTS:
        raise InputError(where, "command", command, "unknown", f"use {', '.join(_ARGUMENTS)}")
    step = Step(time=time, command=command, words=tuple(words[2:]))
    if len(step.words) != len(_ARGUMENTS[command].split()) or not _makes_sense(step):
        given = " ".join(step.words)
        raise InputError(where, command, given, "not what it takes", f"write: {command} {_ARGUMENTS[command]}".rstrip())
    return step


def _makes_sense(step: Step) -> bool:
    if step.command in _NUMBERS:
        try:
            return all(math.isfinite(number) for number in step.numbers)
        except ValueError:
            return False
    if step.command in ("hold", "release", "press"):
        return step.words[0] in known_keys() | {"LEFT_CONTROL"}
    if step.command == "time":
        return read_clock(step.words[0]) is not None
    return step.command != "wait" or step.words == ("bake",)
