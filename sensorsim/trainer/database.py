"""The database handshake: a number asked for, its negative while it loads, and the number itself once both are done."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, TypeAlias

LoadState: TypeAlias = Literal["loading", "ready", "missing"]
DatabaseLoader: TypeAlias = Callable[[int], LoadState]  # asked every frame; starts the loading when first asked

NOT_AVAILABLE = -128
OWN_CHOICE = 0  # the image generator's database, whichever it is


@dataclass(frozen=True, slots=True, kw_only=True)
class Handshake:
    """Which database the host asked for, and whether it has acknowledged our answer by sending 0."""

    wanted: int = OWN_CHOICE
    acknowledged: bool = False


def hear(handshake: Handshake, asked: int) -> Handshake:
    """After an IG Control with that number. One already agreed on may be repeated; negative ones say nothing."""
    if asked > 0 and asked != handshake.wanted:
        return Handshake(wanted=asked)
    if asked == 0 and handshake.wanted != OWN_CHOICE:
        return Handshake(wanted=handshake.wanted, acknowledged=True)
    return handshake


def database_number(handshake: Handshake, load: DatabaseLoader) -> int:
    """The number for the next Start of Frame."""
    if handshake.wanted == OWN_CHOICE:
        return OWN_CHOICE
    state = load(handshake.wanted)
    if state == "missing":
        return NOT_AVAILABLE
    return handshake.wanted if state == "ready" and handshake.acknowledged else -handshake.wanted
