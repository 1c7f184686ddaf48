"""Which effects are on: what the thermal march, the baker and the shader variants obey."""

from dataclasses import dataclass

from sensorsim.effects.catalogue import EFFECTS, NAMES, SURFACE
from sensorsim.errors import InputError


@dataclass(frozen=True, slots=True, kw_only=True)
class EffectPlan:
    """The effects that are left out, sorted; all others are computed. Equal plans give equal tables."""

    off: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Refuse names that are no effects; keep one order."""
        for name in self.off:
            require_known(name)
        object.__setattr__(self, "off", tuple(name for name in NAMES if name in self.off))

    def has(self, name: str) -> bool:
        """Whether the effect is computed."""
        require_known(name)
        return name not in self.off

    def any_of(self, *names: str) -> bool:
        """Whether one of the effects at least is computed."""
        return any(self.has(name) for name in names)

    def without(self, *names: str) -> "EffectPlan":
        """The plan with these left out as well."""
        return EffectPlan(off=(*self.off, *names))

    @property
    def surface(self) -> "EffectPlan":
        """What matters to the tables: the plan with all effects of the frame on."""
        return EffectPlan(
            off=tuple(effect.name for effect in EFFECTS if effect.stage == SURFACE and not self.has(effect.name))
        )


def require_known(name: str, where: str = "effects") -> None:
    """Refuse what is no effect, with the list of those that are."""
    if name not in NAMES:
        raise InputError(where, "effect", name, "unknown or not modelled", f"use one of {', '.join(NAMES)}")


EVERYTHING = EffectPlan()
