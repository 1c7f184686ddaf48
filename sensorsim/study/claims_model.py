"""A sentence of the report as a claim: what is measured, which number has to exceed which, and the reason where the
model says otherwise.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from sensorsim.study.claims_evidence import Evidence

Numbers = Mapping[str, float]

NOTICEABLE, SIGNIFICANT = 0.5, 2.0  # [K] a few and a good ten times the noise of a FLIR
UNIFORM = 1.0  # [K] standard deviation of shades up to which surfaces count as of one shade


@dataclass(frozen=True, slots=True, kw_only=True)
class Relation:
    """`larger` exceeds `times` the `smaller` by more than `by`; each a measured number's name, or a number."""

    larger: str | float
    smaller: str | float
    times: float
    by: float

    def holds(self, numbers: Numbers) -> bool:
        """Whether the measured numbers stand so."""
        return _value(self.larger, numbers) > self.times * _value(self.smaller, numbers) + self.by

    def __str__(self) -> str:
        factor = "" if self.times == 1.0 else f"{self.times:g} x "
        return f"{self.larger} > {factor}{self.smaller}" + (f" + {self.by:g}" if self.by else "")


def more(larger: str | float, *, than: str | float, times: float = 1.0, by: float = 0.0) -> Relation:
    """The relation, written as it is said."""
    return Relation(larger=larger, smaller=than, times=times, by=by)


@dataclass(frozen=True, slots=True, kw_only=True)
class Claim:
    """What a sentence of [Report1978] says of a picture, in other words, and how it is measured."""

    id: str
    section: str
    content: str
    unit: str  # of the numbers that have no other
    measure: Callable[[Evidence], Numbers]
    relations: tuple[Relation, ...]  # all have to hold
    reason: str = ""  # why it does not come out; empty where it does
    instead: tuple[Relation, ...] = ()  # what the reason says of the numbers


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """A claim with what was measured."""

    claim: Claim
    numbers: Numbers

    @property
    def holds(self) -> bool:
        """Whether the sentence comes out."""
        return all(relation.holds(self.numbers) for relation in self.claim.relations)

    @property
    def reason_holds(self) -> bool:
        """Whether the numbers stand as the recorded reason says; true where there is none."""
        return all(relation.holds(self.numbers) for relation in self.claim.instead)

    def to_dict(self) -> dict[str, Any]:
        """All of it as plain values."""
        return {
            "id": self.claim.id,
            "section": self.claim.section,
            "content": self.claim.content,
            "unit": self.claim.unit,
            "numbers": dict(self.numbers),
            "relations": [str(relation) for relation in self.claim.relations],
            "holds": self.holds,
            "reason": self.claim.reason,
            "instead": [str(relation) for relation in self.claim.instead],
        }


def _value(entry: str | float, numbers: Numbers) -> float:
    return numbers[entry] if isinstance(entry, str) else entry
