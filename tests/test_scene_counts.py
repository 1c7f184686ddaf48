"""The report's printed totals and the rule that gives them."""

import numpy as np
import pytest

from sensorsim.scene import Counts, load_scene

PRINTED = {
    "IA": Counts(features=12, surfaces=111, vertices=188, edges=544),
    "IIA": Counts(features=21, surfaces=131, vertices=285, edges=611),
    "IIIB": Counts(features=87, surfaces=684, vertices=1155, edges=3203),
}  # [Report1978] 2.2.1 to 2.2.3


@pytest.mark.parametrize("level", PRINTED)
def test_counts_are_those_of_the_report(level: str) -> None:
    assert load_scene("hospital", level=level).counts == PRINTED[level]


@pytest.mark.parametrize("level", PRINTED)
def test_counting_rule_agrees_with_the_polygons_built(level: str) -> None:
    scene = load_scene("hospital", level=level)
    assert len(scene.surfaces.area) == scene.counts.surfaces
    assert scene.mesh.surface.max() + 1 == scene.counts.surfaces
    table = scene.surfaces
    owner = (table.feature * 100 + table.part)[scene.mesh.surface]
    corners = np.column_stack((owner, scene.mesh.position.round(6)))
    walls_need_bottoms = sum(
        len(part.footprint) for feature in scene.features for part in feature.parts if not part.is_plane
    )
    assert len(np.unique(corners, axis=0)) == scene.counts.vertices
    assert (table.role == "wall").sum() == walls_need_bottoms


@pytest.mark.parametrize(("level", "sides", "solids", "corners", "planes"), [
    ("IA", 89, 10, 10, 2), ("IIA", 83, 15, 119, 19), ("IIIB", 512, 77, 131, 18),
])  # fmt: skip
def test_totals_close_with_these_solids_and_planes(
    level: str, sides: int, solids: int, corners: int, planes: int
) -> None:
    parts = [part for feature in load_scene("hospital", level=level).features for part in feature.parts]
    outlines = [len(part.footprint) for part in parts if not part.is_plane]
    areas = [len(part.footprint) for part in parts if part.is_plane]
    assert (sum(outlines), len(outlines), sum(areas), len(areas)) == (sides, solids, corners, planes)
