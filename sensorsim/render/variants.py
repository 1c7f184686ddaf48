"""The programs that draw surfaces and background: one for each set of effects that changes what is compiled.

What costs a multiplication has no program of its own: a sun that is left out is a beam of zero, mirrors in reflective
bands are a number of the light, and tables without lobes have a number of lobes of zero.
"""

from collections.abc import Mapping
from itertools import product

import moderngl

from sensorsim.effects import EffectPlan
from sensorsim.gpu.mesh import MeshBuffers
from sensorsim.render.passes import Pass, background_pass, surface_pass

Defines = Mapping[str, int]
DECIDING = ("temperature", "reflected_sky", "specular", "atmosphere")  # effects that programs differ by


def surface_defines(plan: EffectPlan, *, emissive: bool) -> Defines:
    """Defines of the program that draws surfaces by this plan."""
    return {
        "EMISSIVE": int(emissive),
        "TEMPERATURE": int(emissive or plan.has("temperature")),
        "MIRRORED": int(plan.has("reflected_sky")) * (1 + int(plan.has("specular"))) if emissive else 2,
        "PATH": int(plan.has("atmosphere")),
    }


def background_defines(plan: EffectPlan) -> Defines:
    """Defines of the program that draws sky and far ground by this plan, in any band."""
    return {"PATH": int(plan.has("atmosphere"))}


def all_plans() -> tuple[EffectPlan, ...]:
    """One plan for each way in which plans can differ for a program."""
    return tuple(
        EffectPlan(off=tuple(name for name, off in zip(DECIDING, left_out, strict=True) if off))
        for left_out in product((False, True), repeat=len(DECIDING))
    )


class Programs:
    """The programs that one sensor's frames have called for so far, each built when it is first needed."""

    def __init__(
        self, ctx: moderngl.Context, mesh: MeshBuffers, generated: Mapping[str, str], *, emissive: bool
    ) -> None:
        self.ctx, self.mesh, self.generated, self.emissive = ctx, mesh, generated, emissive
        self.built: dict[tuple[str, tuple[tuple[str, int], ...]], Pass] = {}

    def surfaces(self, plan: EffectPlan) -> Pass:
        """The program that draws surfaces by this plan."""
        defines = surface_defines(plan, emissive=self.emissive)
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
