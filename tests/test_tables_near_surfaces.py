"""Exchange between near surfaces on top of the tables: what it must leave alone, what it must change, what it costs."""

from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from small_world import DAY, SETTINGS, box, environment, feature, write_town

from sensorsim.environment import Environment, read_weather
from sensorsim.errors import InputError
from sensorsim.materials import load_catalogue
from sensorsim.render import Renderer, World, build_world, look_at
from sensorsim.scene import Scene, load_scene
from sensorsim.sensor import load_sensor
from sensorsim.tables import near_surface_offsets, near_surfaces, surface_temperature
from sensorsim.tables.assign import assign_wall_types
from sensorsim.thermal import build_exchange, outlines_of_mesh

TIMES = np.arange(0.0, 86401.0, SETTINGS.slice_interval)
HEIGHT = 9.0


def _scene(features: list[dict[str, object]]) -> Scene:
    with TemporaryDirectory() as folder:
        return load_scene(write_town(Path(folder), features))


def _house(east: float, north: float, width: float, depth: float) -> dict[str, object]:
    return feature(box(east, north, width, depth), HEIGHT, roof_word="6730", wall_word="2040", interior="unheated")


@cache
def court() -> Scene:
    """Four brick houses around a yard of 16 m by 16 m."""
    return _scene([_house(0, 12, 32, 8), _house(0, -12, 32, 8), _house(12, 0, 8, 15.9), _house(-12, 0, 8, 15.9)])


def inner_walls(scene: Scene) -> np.ndarray:
    """Rows of the walls that look into the yard."""
    outlines = outlines_of_mesh(scene.mesh.position, scene.mesh.triangle, scene.mesh.surface)
    inwards = np.einsum("sk,sk->s", outlines.normal, outlines.centre) < -1.0
    return np.flatnonzero(inwards & (scene.surfaces.role == "wall") & (np.abs(outlines.centre[:, :2]).max(axis=1) < 9))


@cache
def world() -> World:
    return build_world(court(), read_weather("winter"), image_day=DAY, settings=replace(SETTINGS, exchange=True))


def _offsets(scene: Scene, weather: Environment, *, ground: int = 93) -> near_surfaces.SurfaceOffsets:
    catalogue = load_catalogue()
    assignment = assign_wall_types(scene, catalogue)
    soil = catalogue.wall_type(ground, "none")
    return near_surface_offsets(scene, assignment, weather, ground=soil, settings=SETTINGS, time_of_day=TIMES)


def test_isothermal_surroundings_change_nothing() -> None:
    """Air, sky, ground and rooms at 290 K, no sun, a ground of brick, which has nothing to dry: to 1e-6 K."""
    weather = environment()
    even, none = np.full_like(weather.air_temperature, 290.0), np.zeros_like(weather.air_temperature)
    still = replace(
        weather, air_temperature=even, sky_temperature=even, beam_irradiance=none, diffuse_irradiance=none,
        quadrant_irradiance=np.zeros_like(weather.quadrant_irradiance),
    )  # fmt: skip
    offsets = _offsets(court(), still, ground=20)
    assert offsets.surface.size >= 4
    assert np.max(np.abs(offsets.offset)) <= 1e-6
    assert offsets.passes == 1


def test_a_courtyards_walls_stay_warmer_at_night_and_are_near() -> None:
    offsets, walls = world().offsets, inner_walls(court())
    assert offsets is not None
    assert walls.size == 4
    assert np.all(np.isin(walls, offsets.surface))
    night = [offsets.at(hour * 3600.0, court().surfaces.area.size)[walls] for hour in (0.0, 3.0, 6.0, 22.0)]
    assert np.min(night) > 0.2
    assert np.max(night) < 5.0
    assert offsets.left <= near_surfaces.SETTLED


def test_only_surfaces_that_lose_more_than_the_share_are_near() -> None:
    scene, offsets = court(), world().offsets
    outlines = outlines_of_mesh(scene.mesh.position, scene.mesh.triangle, scene.mesh.surface)
    share = build_exchange(outlines, acting=scene.surfaces.role != "plane").neighbour_share
    assert offsets is not None
    np.testing.assert_array_equal(offsets.surface, np.flatnonzero(share > near_surfaces.NEAR_SHARE))
    others = np.setdiff1d(np.arange(share.size), offsets.surface)
    assert np.all(offsets.at(40000.0, share.size)[others] == 0.0)


def test_a_scene_without_near_surfaces_marches_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise AssertionError

    monkeypatch.setattr(near_surfaces, "surface_histories", refuse)
    monkeypatch.setattr(near_surfaces, "ground_temperature", refuse)
    offsets = _offsets(_scene([_house(0, 0, 10, 10), _house(400, 0, 10, 10)]), environment())
    assert (offsets.surface.size, offsets.passes) == (0, 0)
    np.testing.assert_array_equal(offsets.at(3600.0, 12), 0.0)


def test_offsets_are_exact_at_slices_and_straight_between_them() -> None:
    offsets, count = world().offsets, court().surfaces.area.size
    assert offsets is not None
    for k in (0, 1, 20, TIMES.size - 1):
        np.testing.assert_array_equal(offsets.at(TIMES[k], count)[offsets.surface], offsets.offset[k])
    first, second = offsets.at(TIMES[20], count), offsets.at(TIMES[21], count)
    between = offsets.at(0.75 * TIMES[20] + 0.25 * TIMES[21], count)
    np.testing.assert_allclose(between, 0.75 * first + 0.25 * second, rtol=0.0, atol=1e-9)


def test_tables_are_the_same_with_and_without_and_off_is_the_default() -> None:
    plain = build_world(court(), read_weather("winter"), image_day=DAY, settings=SETTINGS)
    assert plain.offsets is None
    np.testing.assert_array_equal(plain.tables.coefficients, world().tables.coefficients)


def test_the_picture_shows_table_and_offset() -> None:
    """Every pixel of the yard's walls: temperature of the table and the offset of the moment, in single precision."""
    count, made = court().surfaces.area.size, world()
    yard = look_at(np.array([-6.0, -6.0, 5.0]), np.array([8.0, 8.0, 3.0]), 80.0)
    with Renderer(made, load_sensor("flir"), size=(48, 36)) as renderer:
        for hour in (13.25, 3.1, 13.25):
            planes = renderer.render(yard, 3600.0 * hour).planes
            table = surface_temperature(
                made.tables, court().surfaces.normal, made.assignment.wall_type, made.assignment.reflectance,
                3600.0 * hour,
            )  # fmt: skip
            assert made.offsets is not None
            whole = table + made.offsets.at(3600.0 * hour, count)
            seen = planes["surface_id"] >= 0
            row = planes["surface_id"][seen]
            np.testing.assert_allclose(planes["surface_temperature"][seen], whole[row], rtol=0.0, atol=2e-4)
            assert np.max(np.abs(whole - table)[row]) > 0.1


def test_too_many_surfaces_are_refused_by_number(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(near_surfaces, "MOST_SURFACES", 3)
    with pytest.raises(InputError, match=r"town\.geojson: exchange = \d+: more than 3 surfaces see each other; leave"):
        _offsets(court(), environment())


def test_a_pane_lets_through_what_it_does_not_send_back() -> None:
    """Glass goes into the tables with its transmittance; its neighbours get what it reflects alone."""
    glass = feature(box(0, 0, 9, 9), 9.0, roof_word="6730", wall_word="4008", interior="heated")
    assignment = assign_wall_types(_scene([glass]), load_catalogue())
    returned = assignment.reflectance - assignment.transmittance
    walls = assignment.transmittance > 0.0
    assert walls.sum() == 5  # with the bottom
    np.testing.assert_allclose(returned[walls], 0.08, atol=1e-12)
    assert np.all(returned >= 0.0)
