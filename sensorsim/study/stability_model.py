"""A hard case as data: what it stresses, what is measured, and the bound that must hold with its reason."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from sensorsim.errors import SensorsimError


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One hard case; `measure` returns what must not exceed `bound`."""

    name: str
    group: str
    stresses: str
    measured: str
    unit: str
    bound: float
    reason: str  # of the bound: source or argument
    measure: Callable[[], float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """A case with what was measured; `problem` tells of an error that came instead of a number."""

    case: Case
    result: float
    problem: str = ""

    @property
    def holds(self) -> bool:
        """Whether the bound holds; never for what is not a number."""
        return self.result <= self.case.bound

    @property
    def margin(self) -> float:
        """Bound over result; infinite where nothing at all was left."""
        if self.result == 0.0:
            return math.inf
        return self.case.bound / self.result

    def to_dict(self) -> dict[str, Any]:
        """All of it as plain values; what is not finite is None."""
        case = self.case
        return {
            "name": case.name,
            "group": case.group,
            "stresses": case.stresses,
            "measured": case.measured,
            "unit": case.unit,
            "bound": case.bound,
            "reason": case.reason,
            "result": self.result if math.isfinite(self.result) else None,
            "margin": self.margin if math.isfinite(self.margin) else None,
            "holds": self.holds,
            "problem": self.problem,
        }


def evaluate_case(case: Case) -> Outcome:
    """Measure one case; an error of this package's own counts as a failed case and is told."""
    try:
        return Outcome(case=case, result=float(case.measure()))
    except SensorsimError as error:
        return Outcome(case=case, result=math.nan, problem=str(error))
