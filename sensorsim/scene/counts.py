"""Features, surfaces, vertices and edges, counted as [Report1978] counts them.

A solid of n sides is n walls, a roof and a bottom (n + 2 surfaces, n + 1 without a bottom), 2 n vertices and, with
edges counted once for each polygon they bound, 4 n + 2 n edges (n fewer without a bottom). A plane polygon of v
corners is one surface, v vertices and v edges. With this rule all nine printed totals come out.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from sensorsim.scene.features import Feature, Part


@dataclass(frozen=True, slots=True, kw_only=True)
class Counts:
    """Sizes of a scene, the report's way."""

    features: int
    surfaces: int
    vertices: int
    edges: int


def _part_counts(part: Part) -> tuple[int, int, int]:
    sides = sum(len(ring) for ring in part.rings)
    if part.is_plane:
        return 1, sides, sides
    bottom = 1 if part.has_bottom else 0
    return sides + 1 + bottom, 2 * sides, (5 + bottom) * sides


def count_features(features: Iterable[Feature]) -> Counts:
    """Counts of a scene's features."""
    listed = tuple(features)
    parts = [_part_counts(part) for feature in listed for part in feature.parts]
    surfaces, vertices, edges = (sum(column) for column in zip(*parts, strict=True))
    return Counts(features=len(listed), surfaces=surfaces, vertices=vertices, edges=edges)
