"""Mixed blocks: a whole quarter drawn as one box, its faces a mixture of materials by shares of area."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.special import expit

from sensorsim.materials.entry import FRACTION, Entry

PARTS = ("roof", "tree", "open", "wall")  # what a component is; walls show on sides only, roofs and open ground on tops
HIGHEST_SHARE_ERROR = 1e-6
LEAST = 1e-6  # reflectance and absorptance that a component is taken to have at least [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class Component:
    """One material of a mixture."""

    code: int
    part: str  # one of PARTS
    share: float  # [-] of the area, where the feature's sheet gives no coverage
    source: str  # of the share, as in `Quantity.source`


@dataclass(frozen=True, slots=True, kw_only=True)
class Coverage:
    """What the sheet of a feature says of its area, as shares [-]; None where it has a dash."""

    roof: float | None = None
    tree: float | None = None


def read_mixture(parent: Entry) -> tuple[Component, ...]:
    """Components of the `mixture` list of a material, empty without one; InputError where shares do not sum to 1."""
    components = tuple(_read_component(entry) for entry in parent.entries("mixture", "component"))
    total = sum(component.share for component in components)
    if components and abs(total - 1.0) > HIGHEST_SHARE_ERROR:
        raise parent.error("mixture", "shares do not sum to 1", "correct them", round(total, 6))
    return components


def _read_component(entry: Entry) -> Component:
    entry.refuse_unknown(("code", "part", "share"))
    code = entry.table.get("code")
    if isinstance(code, bool) or not isinstance(code, int):
        raise entry.error("code", "not a whole number", "name the code of another material")
    share = entry.quantity("share", FRACTION)
    return Component(code=code, part=entry.choice("part", PARTS).value, share=share.value, source=share.source)


def component_shares(components: Sequence[Component], coverage: Coverage, *, side: bool) -> tuple[float, ...]:
    """Share of each component [-] on a top or a side of the block; they sum to 1.

    Tops show roofs, trees and open ground. Where the sheet gives roof or tree coverage it counts, trees as far as the
    roofs leave room, and the other parts share the rest as the record has it. Sides show walls, and trees before them
    to the share of the tree coverage. A mixture that has no part for a face shows all its parts there.
    """
    shown: tuple[str, ...] = ("wall", "tree") if side else ("roof", "tree", "open")
    if not any(component.part in shown for component in components):
        shown = PARTS
    own = {part: sum(c.share for c in components if c.part == part) if part in shown else 0.0 for part in PARTS}
    if not sum(own.values()) > 0.0:
        own = {part: sum(c.share for c in components if c.part == part) for part in PARTS}
    part_share = _cover_parts(own, coverage)
    return tuple(part_share[c.part] * c.share / own[c.part] if own[c.part] > 0.0 else 0.0 for c in components)


def _cover_parts(own: Mapping[str, float], coverage: Coverage) -> dict[str, float]:
    """Share of each part from the record's own ones and the sheet's coverage."""
    fixed: dict[str, float] = {}
    for part, given in (("roof", coverage.roof), ("tree", coverage.tree)):
        if given is not None and own[part] > 0.0:
            fixed[part] = min(given, 1.0 - sum(fixed.values()))
    rest = sum(share for part, share in own.items() if part not in fixed)
    left = 1.0 - sum(fixed.values())
    if rest > 0.0:
        return {part: fixed.get(part, left * share / rest) for part, share in own.items()}
    held = fixed if sum(fixed.values()) > 0.0 else own
    total = sum(held.values())
    return {part: held.get(part, 0.0) / total for part in own}


def part_reflectances(
    own: Sequence[float], share: Sequence[float], reflectance: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Solar reflectances (parts, r) [-] of components in a block that words call `reflectance` (r,).

    All components' odds, r / (1 - r), are their own times one factor, so that each stays within 0 and 1, the mean over
    the area is the word's, and all go smoothly with it: a kink would be more than a few reflectances can follow.
    """
    odds = np.log(np.clip(own, LEAST, 1.0 - LEAST)) - np.log1p(-np.clip(own, LEAST, 1.0 - LEAST))
    area = np.asarray(share, dtype=np.float64)

    def at(word: float) -> NDArray[np.float64]:
        if not LEAST < word < 1.0 - LEAST:
            return np.full(odds.size, word)
        factor = brentq(lambda x: float(area @ expit(odds + x)) - word, -50.0, 50.0, xtol=1e-13)
        return np.asarray(expit(odds + factor))

    return np.stack([at(float(word)) for word in reflectance], axis=1)
