"""The programs that draw surfaces and background: one for each set of effects that changes what is compiled."""

from collections.abc import Mapping
from itertools import product

from sensorsim.effects import EffectPlan

Defines = Mapping[str, int]


def surface_defines(plan: EffectPlan, *, emissive: bool) -> Defines:
    """Defines of the program that draws surfaces by this plan.

    Light of sky and ground in a reflective band has no define of its own: no frame is without it but on request, and
    then it is drawn with nothing to add.
    """
    return {
        "EMISSIVE": int(emissive),
        "TEMPERATURE": int(emissive or plan.has("temperature")),
        "MIRRORED": int(emissive and plan.has("reflected_sky")),
        "SUN": int(not emissive and plan.has("reflected_sun")),
        "PATH": int(plan.has("atmosphere")),
    }


def background_defines(plan: EffectPlan) -> Defines:
    """Defines of the program that draws sky and far ground by this plan."""
    return {"PATH": int(plan.has("atmosphere"))}


def all_surface_defines() -> tuple[Defines, ...]:
    """Every set of defines that any plan can give to the program of the surfaces."""
    choices = ("temperature", "reflected_sky", "reflected_sun", "atmosphere")
    found: dict[tuple[tuple[str, int], ...], Defines] = {}
    for emissive, *on in product((False, True), repeat=len(choices) + 1):
        plan = EffectPlan(off=tuple(name for name, computed in zip(choices, on, strict=True) if not computed))
        defines = surface_defines(plan, emissive=emissive)
        found[tuple(defines.items())] = defines
    return tuple(found.values())
