"""The programs that draw surfaces and background: one for each set of effects that changes what is compiled."""

from collections.abc import Mapping
from itertools import product

import moderngl

from sensorsim.effects import EffectPlan
from sensorsim.gpu.mesh import MeshBuffers
from sensorsim.render.passes import Pass, background_pass, surface_pass

Defines = Mapping[str, int]


def surface_defines(plan: EffectPlan, *, emissive: bool, lobes: bool) -> Defines:
    """Defines of the program that draws surfaces by this plan, from tables with lobes of the sun or without.

    Light of sky and ground in a reflective band has no define of its own: no frame is without it but on request, and
    then it is drawn with nothing to add.
    """
    temperature = emissive or plan.has("temperature")
    return {
        "EMISSIVE": int(emissive),
        "TEMPERATURE": int(temperature),
        "LOBES": int(temperature and lobes),
        "MIRRORED": int(emissive and plan.has("reflected_sky")),
        "SUN": int(not emissive and plan.has("reflected_sun")),
        "PATH": int(plan.has("atmosphere")),
    }


def background_defines(plan: EffectPlan) -> Defines:
    """Defines of the program that draws sky and far ground by this plan."""
    return {"PATH": int(plan.has("atmosphere"))}


def all_plans() -> tuple[EffectPlan, ...]:
    """One plan for each way in which plans can differ for a program."""
    names = ("temperature", "reflected_sky", "reflected_sun", "atmosphere")
    return tuple(
        EffectPlan(off=tuple(name for name, off in zip(names, left_out, strict=True) if off))
        for left_out in product((False, True), repeat=len(names))
    )


def all_surface_defines(*, lobes: bool) -> tuple[Defines, ...]:
    """Every set of defines that any plan can give to the program of the surfaces, from one kind of tables."""
    found = [
        surface_defines(plan, emissive=emissive, lobes=lobes) for emissive in (False, True) for plan in all_plans()
    ]
    return tuple({tuple(defines.items()): defines for defines in found}.values())


class Programs:
    """The programs that one sensor's frames have called for so far, each built when it is first needed."""

    def __init__(
        self, ctx: moderngl.Context, mesh: MeshBuffers, generated: Mapping[str, str], *, emissive: bool,
        lobes: bool,
    ) -> None:  # fmt: skip
        self.ctx, self.mesh, self.generated = ctx, mesh, generated
        self.emissive, self.lobes = emissive, lobes
        self.built: dict[tuple[str, tuple[tuple[str, int], ...]], Pass] = {}

    def surfaces(self, plan: EffectPlan) -> Pass:
        """The program that draws surfaces by this plan."""
        defines = surface_defines(plan, emissive=self.emissive, lobes=self.lobes)
        key = "surfaces", tuple(defines.items())
        if key not in self.built:
            self.built[key] = surface_pass(self.ctx, self.mesh, self.generated, defines)
        return self.built[key]

    def background(self, plan: EffectPlan) -> Pass:
        """The program that draws sky and far ground by this plan."""
        defines = background_defines(plan)
        key = "background", tuple(defines.items())
        if key not in self.built:
            self.built[key] = background_pass(self.ctx, self.generated, defines)
        return self.built[key]
