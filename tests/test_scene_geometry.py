"""Laws of the extruded solids and their triangles, on shapes with closed forms and on the hospital scene."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from sensorsim.scene import LEVELS, LocalFrame, Scene, load_scene, triangulate

FRAME = LocalFrame(longitude=-84.02, latitude=39.82)
Ring = list[tuple[float, float]]

RECTANGLE: Ring = [(0, 0), (30, 0), (30, 20), (0, 20)]
ELL: Ring = [(0, 0), (30, 0), (30, 10), (10, 10), (10, 25), (0, 25)]
STAR: Ring = [
    (math.cos(math.pi * k / 5) * (20.0 if k % 2 else 7.0), math.sin(math.pi * k / 5) * (20.0 if k % 2 else 7.0))
    for k in range(10)
]
COURT: Ring = [(10, 5), (20, 5), (20, 15), (10, 15)]


def write_scene(folder: Path, rings: list[Ring], **properties: object) -> Path:
    """A GeoJSON file of one polygon given in local metres about FRAME's origin."""
    coordinates = []
    for ring in rings:
        degrees = FRAME.degrees_from_metres(np.array(ring, dtype=float)).tolist()
        coordinates.append([*degrees, degrees[0]])
    feature = {
        "type": "Feature",
        "properties": properties,
        "geometry": {"type": "Polygon", "coordinates": coordinates},
    }
    file = folder / "outline.geojson"
    file.write_text(json.dumps({"type": "FeatureCollection", "features": [feature]}))
    return file


def shoelace(ring: Ring) -> float:
    return 0.5 * abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1], strict=True)))


def perimeter(ring: Ring) -> float:
    return sum(math.dist(a, b) for a, b in zip(ring, ring[1:] + ring[:1], strict=True))


@pytest.fixture(params=LEVELS)
def hospital(request: pytest.FixtureRequest) -> Scene:
    return load_scene("hospital", level=request.param)


@pytest.mark.parametrize("rings", [[RECTANGLE], [ELL], [STAR], [RECTANGLE, COURT]], ids=["box", "L", "star", "court"])
@pytest.mark.parametrize("turn", [1, -1], ids=["as given", "reversed"])
def test_areas_match_closed_forms_whatever_the_winding(tmp_path: Path, rings: list[Ring], turn: int) -> None:
    scene = load_scene(write_scene(tmp_path, [ring[::turn] for ring in rings], height=12.0))
    table = scene.surfaces
    flat = shoelace(rings[0]) - sum(shoelace(hole) for hole in rings[1:])
    assert table.area[table.role == "roof"].sum() == pytest.approx(flat, rel=1e-6)
    assert table.area[table.role == "bottom"].sum() == pytest.approx(flat, rel=1e-6)
    walls = sum(perimeter(ring) for ring in rings) * 12.0
    assert table.area[table.role == "wall"].sum() == pytest.approx(walls, rel=1e-6)


@pytest.mark.parametrize("rings", [[RECTANGLE], [ELL], [STAR], [RECTANGLE, COURT]], ids=["box", "L", "star", "court"])
def test_enclosed_volume_by_the_divergence_theorem_is_area_times_height(tmp_path: Path, rings: list[Ring]) -> None:
    scene = load_scene(write_scene(tmp_path, rings, height=12.0, base=3.0))
    corners = scene.mesh.position[scene.mesh.triangle]
    volume = np.einsum("ti,ti->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6.0
    flat = shoelace(rings[0]) - sum(shoelace(hole) for hole in rings[1:])
    assert volume == pytest.approx(flat * 9.0, rel=1e-6)


@pytest.mark.parametrize("rings", [[ELL], [STAR], [RECTANGLE, COURT]], ids=["L", "star", "court"])
def test_triangles_fill_concave_outlines_exactly(rings: list[Ring]) -> None:
    arrays = tuple(np.array(ring, dtype=float) for ring in rings)
    triangles = triangulate(arrays)
    corners = np.concatenate(arrays)[triangles]
    sides = corners[:, 1:] - corners[:, :1]
    areas = 0.5 * (sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0])
    assert (areas > 0.0).all()
    flat = shoelace(rings[0]) - sum(shoelace(hole) for hole in rings[1:])
    assert areas.sum() == pytest.approx(flat, rel=1e-12)
    assert len(triangles) == len(np.concatenate(arrays)) + 2 * (len(rings) - 1) - 2


def test_closed_solids_have_no_net_area(hospital: Scene) -> None:
    table = hospital.surfaces
    for index, feature in enumerate(hospital.features):
        for part_index, part in enumerate(feature.parts):
            rows = (table.feature == index) & (table.part == part_index)
            net = table.area[rows] @ table.normal[rows]
            if part.is_plane:
                assert rows.sum() == 1
            else:
                open_base = 0.0 if part.has_bottom else float(table.area[rows & (table.role == "roof")].sum())
                np.testing.assert_allclose(net, [0.0, 0.0, open_base], atol=1e-6)


def test_triangles_lie_on_their_surface_and_fill_it(hospital: Scene) -> None:
    mesh, table = hospital.mesh, hospital.surfaces
    rows = mesh.surface[mesh.triangle]
    assert (rows == rows[:, :1]).all()
    corners = mesh.position[mesh.triangle]
    doubled = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = 0.5 * np.einsum("ti,ti->t", doubled, table.normal[rows[:, 0]])
    np.testing.assert_allclose(area, 0.5 * np.linalg.norm(doubled, axis=1), rtol=1e-6, atol=1e-6)
    np.testing.assert_allclose(np.bincount(rows[:, 0], weights=area), table.area, rtol=1e-9)


def test_corners_are_shared_within_a_polygon_only(hospital: Scene) -> None:
    mesh = hospital.mesh
    assert len(mesh.position) == hospital.counts.edges
    assert np.unique(mesh.triangle).size == len(mesh.position)
    assert (np.diff(mesh.surface) >= 0).all()


def test_normals_follow_the_role(hospital: Scene) -> None:
    table = hospital.surfaces
    np.testing.assert_allclose(np.linalg.norm(table.normal, axis=1), 1.0, rtol=1e-12)
    assert (table.normal[np.isin(table.role, ["roof", "plane"])] == [0.0, 0.0, 1.0]).all()
    assert (table.normal[table.role == "bottom"] == [0.0, 0.0, -1.0]).all()
    assert (table.normal[table.role == "wall"][:, 2] == 0.0).all()
