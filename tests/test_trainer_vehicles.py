"""Vehicles: shapes that are closed, parts that warm as they should, and pictures that show them in their place."""

import json
import socket
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from pyproj import Transformer
from small_world import town
from test_trainer_pictures import SENSORS, VIEW, frame

from sensorsim.errors import InputError
from sensorsim.render import Renderer, look_at
from sensorsim.scene import LocalFrame
from sensorsim.tables.shade import surface_temperature
from sensorsim.thermal.view_factors import quadrant_view_factors
from sensorsim.trainer.appearance import thermal_state
from sensorsim.trainer.dis_feed import DisFeed
from sensorsim.trainer.dis_listener import HeardEntity
from sensorsim.trainer.fleet import EMISSIVITY, Fleet, skin_wall
from sensorsim.trainer.frame_request import EntityRequest
from sensorsim.trainer.host_state import Component
from sensorsim.trainer.local_place import LocalPlace
from sensorsim.trainer.part_heat import COOLING, IDLE, WARMING, Doing, excess_after, steady_excess
from sensorsim.trainer.scene_pictures import ScenePictures
from sensorsim.trainer.things import ENGINE, FIRE, Thing, things_asked, things_heard
from sensorsim.trainer.udp import Endpoint
from sensorsim.trainer.vehicle_file import part_of, read_vehicle
from sensorsim.trainer.vehicle_shape import METAL, PARTS, VehicleShape, box, cylinder, face_area
from sensorsim.trainer.vehicles import built_in_vehicles

TEN = 36000.0
ENGINE_ROW = PARTS.index("engine")


def volume(triangles: np.ndarray) -> float:
    """Enclosed volume; positive where corners go counter-clockwise seen from outside."""
    return float(np.einsum("ij,ij->i", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])).sum() / 6.0)


def thing(**values: object) -> Thing:
    plain: dict[str, object] = {
        "key": (1,), "model": "tank", "position": (0.0, -120.0, 0.0), "angles": (0.0, 0.0, 0.0), "engine_on": False,
        "speed": 0.0, "burning": False,
    }  # fmt: skip
    return Thing(**(plain | values))  # type: ignore[arg-type]


def entity(**values: object) -> EntityRequest:
    plain: dict[str, object] = {
        "number": 5, "type_number": 2, "position": (0.0, -120.0, 0.0), "angles": (90.0, 0.0, 0.0), "alpha": 1.0,
        "parts": {}, "components": {},
    }  # fmt: skip
    return EntityRequest(**(plain | values))  # type: ignore[arg-type]


def test_boxes_and_cylinders_are_closed_and_face_outwards() -> None:
    assert volume(box((5.0, -3.0, 2.0), (2.0, 3.0, 4.0))) == pytest.approx(24.0)
    exact = 12 * 0.5 * np.sin(np.pi / 6.0) * 0.25 * 4.0  # a prism of twelve sides
    for axis in range(3):
        drum = cylinder((1.0, 2.0, 3.0), 0.5, 4.0, axis)
        assert volume(drum) == pytest.approx(exact)
        extent = np.ptp(drum.reshape(-1, 3), axis=0)
        assert extent[axis] == pytest.approx(4.0)
        edges = np.sort(np.round(np.concatenate([drum[:, [a, b]] for a, b in ((0, 1), (1, 2), (2, 0))]), 9), axis=1)
        assert len(np.unique(edges.reshape(-1, 6), axis=0)) * 2 == len(edges)


def test_built_in_vehicles_stand_on_the_ground_and_have_their_parts() -> None:
    for name, vehicle in built_in_vehicles().items():
        assert vehicle.triangles[:, :, 2].max() == pytest.approx(0.0, abs=0.35)  # down is positive
        assert vehicle.triangles[:, :, 2].min() < -1.0
        assert {"engine", "exhaust", "cabin", "skin"} <= {PARTS[row] for row in vehicle.part}
        assert ("tracks" in {PARTS[row] for row in vehicle.part}) == (name == "tank")
        assert face_area(vehicle.triangles).min() > 0.0


@pytest.mark.parametrize(
    ("triangles", "part"),
    [(np.zeros((0, 3, 3)), np.zeros(0, int)), (np.zeros((1, 3, 3)), np.zeros(1, int)),
     (np.full((1, 3, 3), np.nan), np.zeros(1, int)), (box((0, 0, 0), (1, 1, 1)), np.full(12, 99))],
)  # fmt: skip
def test_a_shape_that_is_none_is_refused(triangles: np.ndarray, part: np.ndarray) -> None:
    with pytest.raises(InputError):
        VehicleShape(name="none", triangles=triangles, part=part)


def test_a_part_goes_to_its_state_with_its_time_constant() -> None:
    running, off = Doing(engine_on=True), Doing(engine_on=False)
    cold = np.zeros(len(PARTS))
    one = excess_after(cold, running, float(WARMING[ENGINE_ROW]))
    assert one[ENGINE_ROW] == pytest.approx(IDLE[ENGINE_ROW] * (1.0 - np.exp(-1.0)))
    np.testing.assert_allclose(excess_after(cold, running, 1e6), steady_excess(running))
    back = excess_after(steady_excess(running), off, float(COOLING[ENGINE_ROW]))
    assert back[ENGINE_ROW] == pytest.approx(IDLE[ENGINE_ROW] * np.exp(-1.0))
    halves = excess_after(excess_after(cold, running, 100.0), running, 200.0)
    np.testing.assert_allclose(halves, excess_after(cold, running, 300.0))
    assert excess_after(one, running, -5.0) is one
    assert steady_excess(off).max() == 0.0
    assert steady_excess(Doing(engine_on=True, speed=1e9)).max() < 250.0
    assert steady_excess(Doing(engine_on=False, burning=True)).min() == 300.0


def test_component_control_and_appearance_switch_the_engine() -> None:
    told = {ENGINE: Component(state=1, words=()), FIRE: Component(state=1, words=())}
    (running,) = things_asked([entity(components=told)])
    assert (running.engine_on, running.burning, running.model) == (True, True, "tank")
    (silent,) = things_asked([entity(type_number=1), entity(type_number=0), entity(type_number=77)])
    assert (silent.engine_on, silent.model) == (None, "truck")
    for appearance, on in ((1 << 22, True), (0, False), (1 << 22 | 3 << 3, False)):
        heard = HeardEntity(
            identity=(1, 2, 3), kind=(1, 1, 225, 1, 0, 0, 0), marking="", position=(0.0, 0.0, 0.0),
            angles=(0.0, 0.0, 0.0), speed=4.0, thermal=thermal_state(appearance, 1),
        )  # fmt: skip
        air = replace(heard, kind=(1, 2, 225, 1, 0, 0, 0))
        (known,) = things_heard([heard, air])
        assert (known.engine_on, known.model, known.speed) == (on, "tank", 4.0)


def test_an_engine_started_warms_and_is_forgotten_with_its_vehicle() -> None:
    fleet = Fleet(built_in_vehicles())
    rows = built_in_vehicles()["tank"].part == ENGINE_ROW

    def engine(time: float, **values: object) -> float:
        solids = fleet.solids([thing(**values)], time, town(), TEN)
        assert solids is not None
        return float(solids.temperature[rows].mean())

    cold = engine(0.0)
    assert engine(600.0, engine_on=True) - cold == pytest.approx(IDLE[ENGINE_ROW] * (1.0 - np.exp(-1.0)))
    assert fleet.solids([], 601.0, town(), TEN) is None
    assert engine(602.0, engine_on=True) - cold == pytest.approx(IDLE[ENGINE_ROW])  # new: long in its state


def test_a_vehicle_that_moves_has_warm_tracks_though_nobody_said_so() -> None:
    fleet, tracks = Fleet(built_in_vehicles()), built_in_vehicles()["tank"].part == PARTS.index("tracks")
    excess = []
    for step in range(600):
        going = thing(engine_on=None, speed=None, position=(0.0, -120.0 + 8.0 * step, 0.0))
        solids = fleet.solids([going], float(step), town(), TEN)
        assert solids is not None
        excess.append(float(solids.temperature[tracks].mean()))
    assert excess[-1] - excess[0] > 5.0
    jump = fleet.solids([thing(engine_on=None, speed=None, position=(4000.0, 0.0, 0.0))], 600.0, town(), TEN)
    assert jump is not None
    assert abs(float(jump.temperature[tracks].mean()) - excess[-1]) < 0.1


def test_the_skin_is_the_sunlit_metal_of_the_tables() -> None:
    walls = town().tables.wall_types
    assert walls[skin_wall(town())].code == METAL
    cold = Fleet(built_in_vehicles()).solids([thing()], 0.0, town(), TEN)
    assert cold is not None
    sun = town().environment.at(TEN).sun_direction
    facing = cold.normal @ sun
    lit, unlit = cold.temperature[facing > 0.95 * facing.max()], cold.temperature[facing < 0.0]
    assert lit.mean() > unlit.mean() + 1.0
    np.testing.assert_allclose(np.linalg.norm(cold.normal, axis=1), 1.0)


def test_vehicles_found_together_are_as_each_is_alone() -> None:
    """Many faces look the same way: what is found for all of them at once is what is found face by face."""
    several = [thing(key=(1,), angles=(10.0, 0.0, 0.0)), thing(key=(2,), model="truck", angles=(200.0, 5.0, -3.0))]
    together = Fleet(built_in_vehicles()).solids(several, 0.0, town(), TEN)
    alone = [Fleet(built_in_vehicles()).solids([one], 0.0, town(), TEN) for one in several]
    assert together is not None
    for name in ("temperature", "quarters", "normal"):
        expected = np.concatenate([getattr(one, name) for one in alone])
        np.testing.assert_allclose(getattr(together, name), expected, rtol=1e-12, atol=1e-12)
    wall, count = skin_wall(town()), len(together.normal)
    upright = np.round(together.normal, 9) + 0.0  # the free film of [Walton1983] leaps by 0.02 % from up to down
    skin = surface_temperature(town().tables, upright, np.full(count, wall), np.full(count, 0.25), TEN)
    np.testing.assert_allclose(together.temperature, skin, atol=1e-5)
    np.testing.assert_allclose(together.quarters, quadrant_view_factors(together.normal), atol=1e-7)


@pytest.mark.parametrize("planes", [None, ("display",)], ids=["all planes", "display alone"])
def test_a_vehicle_stands_in_the_picture_where_it_is(planes: tuple[str, ...] | None) -> None:
    eye = replace(VIEW, position=(0.0, -150.0, 8.0), angles=(0.0, -14.0, 0.0), left=-20.0, right=20.0)
    with ScenePictures(town(), SENSORS, (64, 48), planes=planes) as source:
        empty = source(frame(eye))[0]
        shown = source(frame(eye, entities=(entity(components={FIRE: Component(state=1, words=())}),)))[0]
        low_light = source(frame(replace(eye, view_type=1), entities=(entity(),)))[0]
        no_tank = source(frame(replace(eye, view_type=1)))[0]
    changed = shown["display"] != empty["display"]
    assert changed[20:28, 28:36].mean() > 0.5
    assert shown["display"][22:26, 30:34].mean() > 200.0  # on fire
    assert np.any(low_light["display"] != no_tank["display"])
    if planes is None:
        count = town().scene.surfaces.area.size
        there = shown["surface_id"] == count
        assert 20 < there.sum() < 600
        assert set(shown["feature"][there]) == {-1}
        np.testing.assert_array_equal(shown["surface_id"][~there], empty["surface_id"][~there])
        assert shown["range"][there].mean() == pytest.approx(np.hypot(30.0, 7.0), abs=3.0)
        assert shown["surface_temperature"][there].min() > 500.0


def test_radiance_of_a_vehicle_is_that_of_a_grey_body_and_walls_hide_it() -> None:
    camera = look_at([0.0, -140.0, 1.5], [0.0, -120.0, 1.2], 30.0)
    fleet = Fleet(built_in_vehicles())
    hot = fleet.solids([thing(burning=True)], 0.0, town(), TEN)
    assert hot is not None
    with Renderer(town(), SENSORS[0], size=(64, 48), atmosphere="none") as renderer:
        planes = renderer.render(camera, TEN, solids=hot).planes
        light = renderer.illuminate(TEN)
        behind = replace(hot, triangles=hot.triangles + np.array([-40.0, 180.0, 0.0]))
        walled = look_at([-40.0, -60.0, 1.5], [-40.0, 0.0, 1.2], 30.0)
        hidden = renderer.render(walled, TEN, solids=behind).planes
        assert renderer.band_table is not None
        there = planes["surface_id"] == town().scene.surfaces.area.size
        black = renderer.band_table.radiance_at(planes["surface_temperature"][there].astype(np.float64))
    around = planes["radiance"][there] - EMISSIVITY * black
    low, high = sorted(((1.0 - EMISSIVITY) * light.ground_radiance, (1.0 - EMISSIVITY) * light.sky_radiance))
    assert there.any()
    assert around.min() > low - 0.02
    assert around.max() < high + 0.02
    assert not np.any(hidden["surface_id"] == town().scene.surfaces.area.size)


def test_models_of_files_have_parts_by_name_and_stand_as_gltf_says(tmp_path: Path) -> None:
    scene = trimesh.Scene()
    scene.add_geometry(trimesh.creation.box((2.0, 1.0, 4.0)), node_name="Hull")
    raised = trimesh.transformations.translation_matrix([0.0, 1.0, 1.5])
    scene.add_geometry(trimesh.creation.box((1.0, 0.5, 1.0)), node_name="Engine_Deck", transform=raised)
    scene.export(tmp_path / "thing.glb")
    model = read_vehicle(tmp_path / "thing.glb")
    assert model.name == "thing"
    assert np.ptp(model.triangles.reshape(-1, 3), axis=0) == pytest.approx([4.0, 2.0, 1.75])
    engine = model.triangles[model.part == ENGINE_ROW].reshape(-1, 3)
    assert engine.mean(axis=0) == pytest.approx([1.5, 0.0, -1.0])
    assert volume(model.triangles) == pytest.approx(8.5)
    trimesh.creation.box((1.0, 1.0, 1.0)).export(tmp_path / "block.obj")
    assert len(read_vehicle(tmp_path / "block.obj").part) == 12
    assert [part_of(name) for name in ("Wheel.FL", "left track", "Tailpipe exhaust", "hull")] == [
        "wheels", "tracks", "exhaust", "skin"
    ]  # fmt: skip


def test_model_files_that_are_none_are_refused(tmp_path: Path) -> None:
    (tmp_path / "bad.glb").write_bytes(b"glTF nonsense")
    (tmp_path / "a.fbx").write_bytes(b"")
    for name in ("bad.glb", "a.fbx", "missing.obj"):
        with pytest.raises(InputError):
            read_vehicle(tmp_path / name)


def test_vehicles_of_a_dis_exercise_are_heard_on_a_port() -> None:
    vectors = json.loads((Path(__file__).parent / "data" / "dis_vectors.json").read_text())["packets"]
    packet = next(one for one in vectors if one["kind"][:2] == [1, 1])
    longitude, latitude, _ = Transformer.from_crs("EPSG:4978", "EPSG:4979", always_xy=True).transform(
        *packet["location"]
    )
    place = LocalPlace(frame=LocalFrame(longitude=longitude, latitude=latitude), altitude=0.0)
    with DisFeed(Endpoint(port=0), place) as feed, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        assert feed(0.0) == []
        other.sendto(bytes.fromhex(packet["hex"]), ("127.0.0.1", feed.port))
        other.sendto(b"nonsense", ("127.0.0.1", feed.port))
        time.sleep(0.05)
        (heard,) = feed(0.1)
        assert heard.key[:3] == tuple(packet["identity"])
        assert heard.model == "tank"
        assert np.hypot(*heard.position[:2]) < 5.0
        assert feed(60.0) == []
