"""Who is on and why: bounds of what leaving an effect out would change, and how the tolerance is shared among them."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sensorsim.effects.catalogue import Effect
from sensorsim.effects.choice import EffectChoice
from sensorsim.effects.plan import EffectPlan

DEFAULT_NOISE = 0.1  # [K] noise-equivalent temperature difference of a sensor that states none
NOISE_SHARE = 0.25  # of it, that leaving effects out may change


@dataclass(frozen=True, slots=True, kw_only=True)
class Bound:
    """An upper bound of what leaving one effect out changes, anywhere and at any time."""

    value: float  # 0 where it changes nothing
    reason: str
    saves: float = 0.0  # [ms] estimate of the time that leaving it out saves


@dataclass(frozen=True, slots=True, kw_only=True)
class LedgerRow:
    """One effect of the ledger."""

    effect: str
    on: bool
    bound: float  # [unit]
    unit: str
    tolerance: float  # [unit] for all that is left out together
    reason: str
    saves: float  # [ms] by being off, or that it would save
    on_request: bool  # whether the user decided

    def to_dict(self) -> dict[str, Any]:
        """Plain values."""
        return {
            "effect": self.effect,
            "on": self.on,
            "bound": self.bound,
            "unit": self.unit,
            "tolerance": self.tolerance,
            "reason": self.reason,
            "saves_ms": self.saves,
        }


@dataclass(frozen=True, slots=True, kw_only=True)
class Ledger:
    """All effects that were decided together."""

    rows: tuple[LedgerRow, ...] = ()

    @property
    def plan(self) -> EffectPlan:
        """The decision."""
        return EffectPlan(off=tuple(row.effect for row in self.rows if not row.on))

    @property
    def spent(self) -> float:
        """Sum of the bounds [unit] of what has been left out by them."""
        return sum(row.bound for row in self.rows if not (row.on or row.on_request))

    def to_list(self) -> list[dict[str, Any]]:
        """The rows as plain values."""
        return [row.to_dict() for row in self.rows]

    def row(self, effect: str) -> LedgerRow:
        """The row of an effect; KeyError without one."""
        return {row.effect: row for row in self.rows}[effect]

    def with_rows(self, rows: Iterable[LedgerRow]) -> "Ledger":
        """This ledger and further rows."""
        return Ledger(rows=(*self.rows, *rows))


def decide(
    effects: Sequence[Effect], bounds: Mapping[str, Bound], choice: EffectChoice, *, tolerance: float, unit: str,
    spent: float = 0.0,
) -> tuple[LedgerRow, ...]:  # fmt: skip
    """Rows of `effects` by the user's choice, else by the bounds: the smallest go, while their sum is in tolerance.

    `spent` [unit] is what has been left out of the same tolerance before. Bounds add up, since each is one of a change
    of the absorbed flux or of the radiance, and so their sum is one of leaving all of them out. What the user leaves
    out does not count: it would let nothing else go.
    """
    off = {effect.name for effect in effects if choice.asked(effect.name) is False}
    free = [effect.name for effect in effects if choice.asked(effect.name) is None]
    for name in sorted(free, key=lambda name: bounds[name].value):
        if spent + bounds[name].value <= tolerance:
            spent += bounds[name].value
            off.add(name)
    return tuple(_row(effect, effect.name not in off, bounds, choice, tolerance, unit) for effect in effects)


def _row(
    effect: Effect, on: bool, bounds: Mapping[str, Bound], choice: EffectChoice, tolerance: float, unit: str
) -> LedgerRow:
    name, bound = effect.name, bounds[effect.name]
    reason = bound.reason
    if choice.asked(name) is not None and (on or not effect.optional):
        reason = f"{'asked for' if on else 'left out on request'}; {reason}"
    return LedgerRow(
        effect=name,
        on=on,
        bound=bound.value,
        unit=unit,
        tolerance=tolerance,
        reason=reason,
        saves=bound.saves,
        on_request=choice.asked(name) is not None,
    )
