"""Turrets that turn and guns that rise: where their triangles go, and where a picture shows them."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from small_world import town
from test_trainer_pictures import SENSORS, VIEW, frame
from trainer_world import Host
from trainer_world import entity as entity_control

from sensorsim.errors import InputError
from sensorsim.trainer.articulation import GUN, TURRET, Joint, posed, posture_of
from sensorsim.trainer.dialect import CIGI_33, CIGI_40, Dialect
from sensorsim.trainer.encode import make_packet
from sensorsim.trainer.fleet import Fleet
from sensorsim.trainer.frame_request import EntityRequest
from sensorsim.trainer.host_state import Part
from sensorsim.trainer.scene_pictures import ScenePictures
from sensorsim.trainer.things import things_asked
from sensorsim.trainer.vehicle_file import number_of, read_vehicle
from sensorsim.trainer.vehicle_shape import VehicleShape, box
from sensorsim.trainer.vehicles import built_in_vehicles

TEN = 36000.0
TANK = built_in_vehicles()["tank"]
TURRET_AT, GUN_AT = np.array([0.2, 0.0, -1.55]), np.array([1.5, 0.0, -2.0])
MUZZLE = np.array([5.7, 0.0, -2.0])  # forward, right, down [m]: the middle of the gun's end at rest


def muzzle(**parts: dict[str, float]) -> np.ndarray:
    """Middle of the gun's end of a tank with these parts."""
    numbers = {"turret": TURRET, "gun": GUN}
    corners, _ = posed(TANK.triangles, TANK.joints, posture_of({numbers[name]: Part(values=said)
                                                                  for name, said in parts.items()}))  # fmt: skip
    end = np.isclose(TANK.triangles, MUZZLE, atol=0.1).all(axis=2) & np.isclose(TANK.triangles[..., 0], MUZZLE[0])
    rim = corners[end]
    assert len(rim) > 12
    return np.asarray(0.5 * (rim.min(axis=0) + rim.max(axis=0)))


def test_a_vehicle_at_rest_is_its_shape() -> None:
    corners, there = posed(TANK.triangles, TANK.joints, ())
    assert corners is TANK.triangles
    assert there.all()
    np.testing.assert_allclose(muzzle(), MUZZLE, atol=1e-9)
    assert [joint.number for joint in TANK.joints] == [GUN, TURRET]  # the inner one first


@pytest.mark.parametrize("yaw", [0.0, 37.0, 90.0, -120.0, 360.0])
@pytest.mark.parametrize("pitch", [0.0, 20.0, -8.0])
def test_a_gun_rises_in_its_turret_and_turns_with_it(yaw: float, pitch: float) -> None:
    length, turn, rise = MUZZLE[0] - GUN_AT[0], np.radians(yaw), np.radians(pitch)
    ahead = GUN_AT[0] - TURRET_AT[0] + length * np.cos(rise)  # of the turret's axis
    expected = [TURRET_AT[0] + ahead * np.cos(turn), ahead * np.sin(turn), MUZZLE[2] - length * np.sin(rise)]
    np.testing.assert_allclose(muzzle(turret={"yaw": yaw}, gun={"pitch": pitch}), expected, atol=0.02)  # of its rim


def test_offsets_move_a_part_along_the_bodys_axes_and_roll_turns_it_about_its_own() -> None:
    np.testing.assert_allclose(
        muzzle(gun={"xoff": -0.4, "yoff": 0.3, "zoff": -0.1}), MUZZLE + np.array([-0.4, 0.3, -0.1])
    )
    np.testing.assert_allclose(muzzle(gun={"roll": 30.0}), MUZZLE, atol=1e-9)  # a prism of twelve sides


def test_lengths_areas_and_the_hull_stay() -> None:
    corners, _ = posed(TANK.triangles, TANK.joints, ((TURRET, True, (0.1, 0.2, 0.3, 5.0, 6.0, 70.0)),))
    turret = TANK.joints[1].carries
    np.testing.assert_array_equal(corners[~turret], TANK.triangles[~turret])
    sides = [np.linalg.norm(shape[turret] - np.roll(shape[turret], 1, axis=1), axis=2)
             for shape in (corners, TANK.triangles)]  # fmt: skip
    np.testing.assert_allclose(sides[0], sides[1], atol=1e-12)


def test_a_part_that_is_not_enabled_is_gone_with_what_it_carries() -> None:
    fleet = Fleet(built_in_vehicles())
    tank = EntityRequest(
        number=5, type_number=2, position=(0.0, -120.0, 0.0), angles=(90.0, 0.0, 0.0), alpha=1.0, components={},
        parts={TURRET: Part(enabled=False)},
    )  # fmt: skip
    bare = fleet.solids(things_asked([tank]), 0.0, town(), TEN)
    gunless = fleet.solids(things_asked([replace(tank, parts={GUN: Part(enabled=False)})]), 0.1, town(), TEN)
    assert bare is not None
    assert gunless is not None
    assert len(bare.triangles) == np.sum(~TANK.joints[1].carries)
    assert len(gunless.triangles) == np.sum(~TANK.joints[0].carries)
    assert bare.triangles[..., 2].max() < 1.8
    lone = VehicleShape(
        name="tank", triangles=TANK.triangles, part=TANK.part,
        joints=(Joint(number=TURRET, pivot=(0.0, 0.0, 0.0), carries=np.ones(len(TANK.part), dtype=np.bool_)),),
    )  # fmt: skip
    assert Fleet({"tank": lone}).solids(things_asked([tank]), 0.0, town(), TEN) is None


def said(dialect: Dialect, *packets: tuple[str, dict[str, float]], frames: int = 1) -> EntityRequest:
    """The tank that a host made of its packets, some frames later."""
    host = Host(dialect)
    first = entity_control(0.0, 0.0, 0.0, entity_id=5, entity_type=2, extrapolation_enable=1)
    if dialect is CIGI_33:
        tank = [first]
    else:
        names = ("lat_xoff", "lon_yoff", "alt_zoff")
        place = {name: first.values[name] for name in names}
        tank = [host.packet("entity_control", entity_id=5, entity_state=1, entity_type=2, extrapolation_enable=1),
                make_packet(dialect, "entity_position", entity_id=5, **place)]  # fmt: skip
    host.frame(*tank, *(host.packet(name, entity_id=5, **values) for name, values in packets), extrapolation_enable=1)
    assert host.said == ()
    for _ in range(frames - 1):
        host.frame(extrapolation_enable=1)
    (request,) = host.ig.frame_request().entities
    return replace(request, position=(0.0, -120.0, 0.0), angles=(0.0, 0.0, 0.0))


BY_LONG = ("art_part_control", {"part_id": 1, "part_enable": 1, "yaw_enable": 1, "yaw": 90.0})
BY_SHORT = ("short_art_part_control", {"part_id_1": 1, "dof_select_1": 4, "dof_1": 90.0, "part_enable_1": 1})
BY_RATE = ("rate_control", {"part_id": 1, "apply_to_part": 1, "yaw_rate": 60.0})  # 1.5 s of it


@pytest.mark.parametrize("dialect", [CIGI_33, CIGI_40], ids=["3.3", "4.0"])
@pytest.mark.parametrize(("how", "frames"), [(BY_LONG, 1), (BY_SHORT, 1), (BY_RATE, 91)], ids=["long", "short", "rate"])
def test_a_turret_turned_by_the_host_points_its_gun_there_in_the_picture(
    dialect: Dialect, how: tuple[str, dict[str, float]], frames: int
) -> None:
    """From straight above, north up: the gun of a tank that heads north lies north of it, and east once turned."""
    eye = replace(VIEW, position=(0.0, -120.0, 40.0), angles=(0.0, -90.0, 0.0), left=-20.0, right=20.0)
    ahead, turned = said(dialect), said(dialect, how, frames=frames)
    assert turned.parts[1].values["yaw"] == pytest.approx(90.0)
    with ScenePictures(town(), SENSORS, (256, 192), planes=None) as source:
        shown = [source(frame(eye, entities=(tank,)))[0]["surface_id"] for tank in (ahead, turned)]
    there = [picture == town().scene.surfaces.area.size for picture in shown]

    def pixel(east: float, north: float) -> tuple[int, int]:
        """Row and column of a point 2 m above the ground [m], from the tank's middle."""
        scale = 128.0 / np.tan(np.radians(20.0)) / 38.0
        return round(95.5 - scale * north), round(127.5 + scale * east)

    north, east = pixel(0.0, 5.2), pixel(5.0, 0.2)
    assert [picture[north] for picture in there] == [True, False]
    assert [picture[east] for picture in there] == [False, True]
    assert all(picture[pixel(0.0, 0.5)] for picture in there)


def test_nodes_of_models_are_joints_by_name(tmp_path: Path) -> None:
    shift = trimesh.transformations.translation_matrix
    scene = trimesh.Scene()
    scene.add_geometry(trimesh.creation.box((2.0, 1.0, 4.0)), node_name="Hull")
    scene.graph.update(frame_to="Turret_ring", frame_from="Hull", matrix=shift([0.0, 1.0, 0.5]))
    scene.add_geometry(trimesh.creation.box((1.0, 0.5, 1.0)), node_name="turret_mesh", parent_node_name="Turret_ring")
    scene.add_geometry(
        trimesh.creation.box((0.1, 0.1, 2.0)), node_name="Gun", parent_node_name="Turret_ring",
        transform=shift([0.0, 0.0, 1.5]),
    )  # fmt: skip
    scene.add_geometry(trimesh.creation.box((0.2, 0.2, 0.2)), node_name="hatch part 17", parent_node_name="Hull")
    scene.export(tmp_path / "tank.glb")
    model = read_vehicle(tmp_path / "tank.glb")
    joints = {joint.number: joint for joint in model.joints}
    assert {number: int(joint.carries.sum()) for number, joint in joints.items()} == {17: 12, GUN: 12, TURRET: 24}
    assert joints[TURRET].pivot == pytest.approx((0.5, 0.0, -1.0))
    assert joints[GUN].pivot == pytest.approx((2.0, 0.0, -1.0))
    order = [joint.number for joint in model.joints]
    assert order.index(GUN) < order.index(TURRET)
    corners, _ = posed(model.triangles, model.joints, ((TURRET, True, (0.0, 0.0, 0.0, 0.0, 0.0, 90.0)),))
    gun = corners[joints[GUN].carries].reshape(-1, 3)
    assert gun.mean(axis=0) == pytest.approx([0.5, 1.5, -1.0])


@pytest.mark.parametrize(
    ("name", "number"),
    [("Turret", 1), ("main_gun.001", 2), ("part_12", 12), ("hatch part 7b", 7), ("part_300", None), ("hull", None),
     ("counterpart1", None), ("part", None)],
)  # fmt: skip
def test_names_of_parts(name: str, number: int | None) -> None:
    assert number_of(name) == number


@pytest.mark.parametrize(
    ("pivot", "count"), [((0.0, 0.0, 0.0), 11), ((float("nan"), 0.0, 0.0), 12), ((0.0, float("inf"), 0.0), 12)]
)
def test_a_joint_that_is_not_of_its_shape_is_refused(pivot: tuple[float, float, float], count: int) -> None:
    joint = Joint(number=1, pivot=pivot, carries=np.ones(count, dtype=np.bool_))
    with pytest.raises(InputError, match="joint"):
        VehicleShape(name="a", triangles=box((0, 0, 0), (1, 1, 1)), part=np.zeros(12, int), joints=(joint,))
