"""Layers of slabs, cylinders and spheres: how area, volume and resistance of a shell go with its depth.

Section 3.1.4 of [Report1978] has all three. Everything is per unit of exterior area, so that a curved wall is solved
as a flat one whose cells and resistances grow or shrink with depth. With n = 0, 1, 2 for slab, cylinder and sphere the
area at radius r is (r / radius)^n of the exterior area. Differences of nearly equal radii are written as products, so
that a shell of a huge radius is a slab to rounding.
"""

from dataclasses import dataclass

import numpy as np

from sensorsim.errors import InputError
from sensorsim.materials import SHAPES


@dataclass(frozen=True, slots=True, kw_only=True)
class Shells:
    """The shape of a wall that layers are stacked in, from its exterior face inwards."""

    shape: str = "slab"  # one of SHAPES
    radius: float | None = None  # of the exterior face [m]; None for a slab

    def __post_init__(self) -> None:
        """Refuse an unknown shape, a curved one without a radius, a flat one with one."""
        if self.shape not in SHAPES:
            raise InputError("wall", "shape", self.shape, "unknown shape", f"use one of {', '.join(SHAPES)}")
        if self.shape == "slab" and self.radius is not None:
            raise InputError("wall", "radius", self.radius, "a slab has none", "leave it out or name another shape")
        if self.shape != "slab" and not (self.radius is not None and 0.0 < self.radius < np.inf):
            problem = f"a {self.shape} needs one above 0"
            raise InputError("wall", "radius", self.radius, problem, "give that of the exterior face in metres")

    def area(self, depth: float) -> float:
        """Area at a depth [m] over the exterior area [-]; exactly 0 at the centre."""
        inward = self._radius_at(depth)
        if self.radius is None:
            return 1.0
        return (inward / self.radius) ** (1 if self.shape == "cylinder" else 2)

    def volume(self, depth: float, thickness: float) -> float:
        """Volume of a shell [m3 per m2 of exterior area] whose outer face lies at `depth` [m]."""
        if self.radius is None:
            return thickness
        b, a = self._radius_at(depth), self._radius_at(depth + thickness)
        if self.shape == "cylinder":
            return thickness * (a + b) / (2.0 * self.radius)
        return thickness * (a * a + a * b + b * b) / (3.0 * self.radius**2)

    def resistance(self, depth: float, thickness: float) -> float:
        """Resistance of a shell times its conductivity [m]: r ln(b / a), r^2 (1 / a - 1 / b); infinite to a centre."""
        if self.radius is None or thickness == 0.0:
            return thickness
        b, a = self._radius_at(depth), self._radius_at(depth + thickness)
        if a == 0.0:
            return float(np.inf)
        if self.shape == "cylinder":
            return self.radius * float(np.log1p(thickness / a))
        return self.radius**2 * thickness / (a * b)

    def middle(self, depth: float, thickness: float) -> float:
        """How far [m] below the outer face of a shell the radius lies whose square is the mean of r^2 over it.

        A temperature that goes with r^2, as around a centre, takes its mean over the cell there.
        """
        if self.radius is None:
            return 0.5 * thickness
        b, a = self._radius_at(depth), self._radius_at(depth + thickness)
        if self.shape == "cylinder":
            fall = 0.5 * thickness * (a + b)
        else:
            cubes = 2.0 * b**3 + 4.0 * b**2 * a + 6.0 * b * a**2 + 3.0 * a**3
            fall = thickness * cubes / (5.0 * (b * b + a * b + a * a))
        return fall / (b + float(np.sqrt(b * b - fall)))

    def _radius_at(self, depth: float) -> float:
        """Radius at a depth; within rounding of the centre it is the centre, beyond it an error."""
        if self.radius is None:
            return 0.0
        left = self.radius - depth
        if left < -1e-9 * self.radius:
            problem, remedy = f"layers reach {depth:g} m deep", "make the layers thinner or the radius larger"
            raise InputError("wall", "radius", self.radius, problem, remedy)
        return left if left > 1e-9 * self.radius else 0.0
