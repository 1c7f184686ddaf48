"""The plane of the fit's error: what it holds, where it comes from, and that frames without it do not pay for it."""

import json
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from small_world import DAY, town, town_features, write_town

from sensorsim.cli import main
from sensorsim.environment import build_environment, longest_lead_in
from sensorsim.errors import InputError
from sensorsim.frames import capture, read_plane, take_frame
from sensorsim.frames.fit_error import fit_error_plane, surface_fit_error
from sensorsim.materials import load_catalogue
from sensorsim.render import Renderer, World, station_camera
from sensorsim.render.survey import ground_plane
from sensorsim.sensor import load_sensor
from sensorsim.tables import bake_tables, preset, surface_temperature
from sensorsim.tables.full_solve import distinct_surfaces, fine_environment, fine_settings, solve_surfaces


def test_error_is_what_the_tables_miss_of_the_full_solve_at_the_time() -> None:
    """At 10 h, a sample of the full solve, and half way between two of its samples."""
    world = town()
    distinct, environment = (
        distinct_surfaces(world.scene.surfaces.normal, world.assignment),
        fine_environment(world.weather, DAY),
    )
    surfaces = distinct.surfaces
    solved = solve_surfaces(
        environment,
        surfaces,
        ground=ground_plane(load_catalogue(), world.season),
        record=environment.image_window.start + np.array([600, 601]),
        settings=fine_settings(world.tables.settings),
    )
    for at, exact in ((36000.0, solved[0]), (36030.0, solved.mean(axis=0))):
        fit = surface_temperature(world.tables, surfaces.normal, surfaces.wall_type, surfaces.reflectance, at)
        expected = np.abs(fit - exact)[distinct.row_of]
        np.testing.assert_allclose(surface_fit_error(world, at), expected, rtol=0.0, atol=1e-9)
        assert 0.001 < expected.max() < 20.0


def test_finer_tables_miss_less() -> None:
    """At a quarter to ten, half way between two slices of the town's tables and on one of the default's."""
    world = town()
    settings = preset("standard")
    lead_in = longest_lead_in(world.weather, DAY)
    environment = build_environment(world.weather, image_day=DAY, lead_in_days=lead_in, step=settings.step)
    ground = ground_plane(load_catalogue(), world.season)
    finer = bake_tables(environment, world.assignment.wall_types, ground=ground, settings=settings)
    coarse, fine = (surface_fit_error(each, 35100.0) for each in (world, replace(world, tables=finer)))
    assert np.sqrt(np.mean(fine**2)) < np.sqrt(np.mean(coarse**2))


@pytest.mark.parametrize("at", [0.0, 86400.0])
def test_error_is_finite_at_both_ends_of_the_day(at: float) -> None:
    error = surface_fit_error(town(), at)
    assert error.shape == (town().scene.surfaces.normal.shape[0],)
    assert np.all(np.isfinite(error))
    assert np.all(error >= 0.0)


def test_plane_shows_each_surfaces_error_and_minus_one_for_the_sky() -> None:
    plane = fit_error_plane(np.array([0.5, 0.0, 2.0]), np.array([[-1, 0], [2, 1]]))
    np.testing.assert_array_equal(plane, [[-1.0, 0.5], [2.0, 0.0]])


def test_frame_has_the_plane_only_where_it_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    world, calls = town(), []

    def count(place: World, at: float) -> np.ndarray:
        calls.append(at)
        return surface_fit_error(place, at)

    monkeypatch.setattr(capture, "surface_fit_error", count)
    with Renderer(world, load_sensor("flir"), size=(48, 36)) as renderer:
        camera = station_camera(world.scene, "overhead")
        plain = take_frame(renderer, camera, "1976-02-07T10:00")
        assert calls == []
        asked = take_frame(renderer, camera, "1976-02-07T10:00", fit_error=True)
    assert calls == [36000.0]
    assert "fit_error" not in plain.planes
    assert "fit_error" not in plain.settings
    with pytest.raises(InputError, match="plane = 'fit_error': not in this frame"):
        plain.plane("fit_error")
    plane, surface = asked.plane("fit_error"), asked.plane("surface_id").data
    assert (plane.unit, plane.no_surface) == ("K", -1.0)
    error = surface_fit_error(world, 36000.0)
    np.testing.assert_array_equal(plane.data[surface >= 0], error[surface[surface >= 0]])
    np.testing.assert_array_equal(plane.data[surface < 0], -1.0)
    told = asked.settings["fit_error"]
    assert told["largest_of_all_surfaces_K"] == error.max()
    for name, other in plain.planes.items():
        np.testing.assert_array_equal(asked.plane(name).data, other.data)


def test_command_writes_the_plane_and_says_so_in_the_sidecar(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    out = tmp_path / "frame.png"
    words = (
        "render", write_town(tmp_path, town_features()), "--at", "1976-02-07T10:00", "--out", out, "--size", "48x36",
        "--preset", "report", "--planes", "fit_error,surface_id", "--camera", "-150,-140,60,45,-18",
    )  # fmt: skip
    monkeypatch.setattr(sys, "argv", ["sensorsim", *map(str, words)])
    with pytest.raises(SystemExit) as left:
        main()
    assert left.value.code in (0, None)
    sidecar = json.loads(out.with_suffix(".json").read_text())
    entry = next(each for each in sidecar["planes"] if each["name"] == "fit_error")
    assert (entry["unit"], entry["no_surface"]) == ("K", -1.0)
    assert entry["max"] <= sidecar["settings"]["fit_error"]["largest_of_all_surfaces_K"] + 1e-6
    plane = read_plane(out.with_suffix(".exr"), "fit_error").data
    surface = read_plane(out.with_suffix(".exr"), "surface_id").data
    np.testing.assert_array_equal(plane == -1.0, surface == -1)
    assert plane[surface >= 0].min() >= 0.0
