"""Effects chosen by their bounds against all effects, pixel by pixel, and the programs that draw them."""

from dataclasses import replace
from datetime import date
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from effect_cases import DAYS, random_weather
from numpy.typing import NDArray
from small_world import town_features, write_town

from sensorsim.effects import DEFAULT_NOISE, NOISE_SHARE, EffectChoice, read_choice
from sensorsim.environment import Weather, read_weather
from sensorsim.errors import InputError
from sensorsim.render import EVERY_EFFECT, Camera, Renderer, World, build_world, look_at, station_camera
from sensorsim.scene import Scene, load_scene
from sensorsim.sensor import load_sensor
from sensorsim.study.gallery import FIGURES
from sensorsim.tables import BakeSettings

TOLERANCE = DEFAULT_NOISE * NOISE_SHARE
COARSE = BakeSettings(
    interpolation="barycentric", lobes=0.0,
    orientations="report10", reflectances=(0.1, 0.5, 0.9), degree=2, step=1800.0, slice_interval=3600.0,
    lead_in_days=1.0,
)  # fmt: skip
FINER = replace(COARSE, orientations="icosphere42")
AUTO = EffectChoice(base="auto")
SIZE = (96, 72)


def world(scene: Scene, weather: Weather, day: date, choice: EffectChoice, sensor: str = "flir") -> World:
    return build_world(scene, weather, image_day=day, settings=COARSE, effects=choice, sensor=load_sensor(sensor))


@cache
def hospital(level: str, day: date, choice: EffectChoice, sensor: str) -> World:
    return world(load_scene("hospital", level=level), read_weather(day.isoformat()), day, choice, sensor)


MOMENTS = sorted({(figure.level, figure.sensor, day) for figure in FIGURES for day, _ in figure.moments})


@pytest.mark.parametrize(("level", "sensor", "day"), MOMENTS)
def test_every_pixel_of_the_reports_images_is_within_tolerance_of_all_effects(
    level: str, sensor: str, day: date
) -> None:
    hours = sorted({
        hour for figure in FIGURES if (figure.level, figure.sensor) == (level, sensor)
        for moment, hour in figure.moments if moment == day
    })  # fmt: skip
    worlds = [hospital(level, day, choice, sensor) for choice in (EVERY_EFFECT, AUTO)]
    camera = station_camera(worlds[0].scene, "tower")
    with Renderer(worlds[0], load_sensor(sensor), size=SIZE) as full, Renderer(
        worlds[1], load_sensor(sensor), size=SIZE
    ) as lean:  # fmt: skip
        for hour in hours:
            compare(full, lean, camera, hour)


def compare(full: Renderer, lean: Renderer, camera: Camera, hour: float) -> None:
    """Both pictures within the tolerance of the ledger, which is that of the noise or of a grey step."""
    whole, chosen = (renderer.render(camera, hour * 3600.0) for renderer in (full, lean))
    plane = "radiance" if full.band_table is None else "apparent_temperature"
    allowed = chosen.ledger.rows[-1].tolerance
    assert chosen.ledger.plan.off, "nothing was left out"
    assert (
        np.abs(chosen.planes[plane] - whole.planes[plane]).max() <= allowed + 1e-7 * np.abs(whole.planes[plane]).max()
    )


@pytest.mark.parametrize("seed", range(5))
def test_every_pixel_of_random_scenes_in_random_weather_is_within_tolerance(seed: int, tmp_path: Path) -> None:
    rng = np.random.default_rng(100 + seed)
    features = town_features()
    for entry in features:
        entry["properties"]["height"] *= float(rng.uniform(0.5, 2.0)) if entry["properties"]["height"] else 0.0
    features[1]["properties"]["roof_word"] = str(rng.choice(["6730", "6710", "6550"]))
    scene = load_scene(write_town(tmp_path, [features[0], *[f for f in features[1:] if rng.uniform() < 0.7]]))
    camera = look_at([float(rng.uniform(-200, 200)), -180.0, float(rng.uniform(5, 90))], [0.0, 0.0, 5.0], 35.0)
    for sensor in ("flir", "lltv"):
        worlds = [world(scene, random_weather(seed), DAYS["winter"], choice, sensor) for choice in (EVERY_EFFECT, AUTO)]
        with Renderer(worlds[0], load_sensor(sensor), size=SIZE) as full, Renderer(
            worlds[1], load_sensor(sensor), size=SIZE
        ) as lean:  # fmt: skip
            for hour in (5.0, 13.5):
                compare(full, lean, camera, hour)


def town(tmp_path: Path, choice: str, sensor: str = "flir", settings: BakeSettings = COARSE) -> World:
    scene = load_scene(write_town(tmp_path, town_features()))
    return build_world(
        scene, read_weather("winter"), image_day=DAYS["winter"], settings=settings, effects=read_choice(choice),
        sensor=load_sensor(sensor),
    )  # fmt: skip


def test_spare_histories_are_neither_solved_nor_different(tmp_path: Path) -> None:
    """What is solved of a scene's orientations alone is the same, to single precision of its level."""
    whole, lean = (town(tmp_path, choice, settings=FINER) for choice in ("all", "all,-spare_orientations"))
    assert lean.tables.orientations.normal.shape[0] < whole.tables.orientations.normal.shape[0]
    place = [int(np.argmax(whole.tables.orientations.normal @ normal)) for normal in lean.tables.orientations.normal]
    apart = whole.tables.coefficients[:, :, place].astype(np.float64) - lean.tables.coefficients
    apart[..., 0] += (whole.tables.level - lean.tables.level)[:, :, None]
    solved = np.isfinite(apart)
    assert 0.2 < solved.mean() < 1.0
    assert np.abs(apart[solved]).max() < 1e-5


def test_tables_of_one_scene_refuse_other_normals(tmp_path: Path) -> None:
    tables = town(tmp_path, "auto", settings=FINER).tables
    with pytest.raises(InputError, match="bake all effects"):
        tables.orientations.locate(np.array([[0.6, 0.48, -0.64]]))


def test_low_light_frames_need_no_temperatures_unless_a_plane_of_them_is_asked_for(tmp_path: Path) -> None:
    cold, warm = town(tmp_path, "auto", "lltv"), town(tmp_path, "+temperature", "lltv")
    assert not np.any(np.isfinite(cold.tables.coefficients))
    for baked, there in ((cold, False), (warm, True)):
        with Renderer(baked, load_sensor("lltv"), size=SIZE) as renderer:
            planes = renderer.render(look_at([0.0, -150.0, 40.0], [0.0, 0.0, 5.0], 40.0), 36000.0).planes
        assert ("surface_temperature" in planes) == there
    with pytest.raises(InputError, match="built without"):
        Renderer(cold, load_sensor("flir"), size=SIZE)


def test_short_paths_and_black_surfaces_are_drawn_without_air_and_mirrors(tmp_path: Path) -> None:
    baked = town(tmp_path, "auto")
    black = replace(baked, assignment=replace(baked.assignment, emissivity=np.ones_like(baked.assignment.emissivity)))
    near, far = look_at([0.0, 60.0, 2.0], [0.0, 60.2, 0.0], 10.0), look_at([0.0, -150.0, 40.0], [0.0, 0.0, 5.0], 40.0)
    for scene, camera, air, mirrors in (
        (baked, far, True, True),
        (baked, near, False, True),
        (black, far, True, False),
    ):
        with Renderer(scene, load_sensor("flir"), size=SIZE) as renderer:
            plan = renderer.render(camera, 36000.0).ledger.plan
        assert (plan.has("atmosphere"), plan.has("reflected_sky")) == (air, mirrors)


def test_sun_is_in_the_low_light_band_by_day_and_neither_it_nor_the_moon_before_dawn(tmp_path: Path) -> None:
    camera = look_at([0.0, -150.0, 40.0], [0.0, 0.0, 5.0], 40.0)
    with Renderer(town(tmp_path, "auto", "lltv"), load_sensor("lltv"), size=SIZE) as renderer:
        assert renderer.render(camera, 43200.0).ledger.plan.has("reflected_sun")
        assert renderer.render(camera, 0.0).illumination.beam > 0.0, "the moon is up at midnight"
        assert not renderer.render(camera, 18000.0).ledger.plan.has("reflected_sun")


ABOVE, ACROSS = (
    look_at([0.0, -150.0, 40.0], [0.0, 0.0, 5.0], 40.0),
    look_at([60.0, -80.0, 9.0], [60.0, 40.0, 9.0], 40.0),
)


@pytest.mark.parametrize("camera", [ABOVE, ACROSS])
@pytest.mark.parametrize("left_out", ["atmosphere", "reflected_sky", "specular"])
def test_bound_of_an_effect_of_the_frame_is_above_what_it_changes(
    left_out: str, camera: Camera, tmp_path: Path
) -> None:
    pictures: list[NDArray[np.float64]] = []
    for choice in ("all", f"all,-{left_out}"):
        with Renderer(town(tmp_path, choice), load_sensor("flir"), size=SIZE) as renderer:
            picture = renderer.render(camera, 36000.0)
        pictures.append(picture.planes["apparent_temperature"])
    change = float(np.abs(pictures[0] - pictures[1]).max())
    assert TOLERANCE < change <= picture.ledger.row(left_out).bound


@pytest.mark.parametrize("atmosphere", ["standard", "report", "none"])
@pytest.mark.parametrize("sensor", ["flir", "lltv"])
def test_bound_of_the_air_is_above_what_it_changes_in_fog_and_none(
    atmosphere: str, sensor: str, tmp_path: Path
) -> None:
    scene, weather = load_scene(write_town(tmp_path, town_features())), read_weather("winter")
    plane = "radiance" if sensor == "lltv" else "apparent_temperature"
    for visibility in (300.0, 50000.0):
        pictures = []
        for choice in ("all", "all,-atmosphere"):
            baked = build_world(
                scene, weather, image_day=DAYS["winter"], settings=COARSE, visibility=visibility,
                effects=read_choice(choice), sensor=load_sensor(sensor),
            )  # fmt: skip
            with Renderer(baked, load_sensor(sensor), size=SIZE, atmosphere=atmosphere) as renderer:
                pictures.append(renderer.render(ACROSS, 36000.0))
        change = float(np.abs(pictures[0].planes[plane] - pictures[1].planes[plane]).max())
        bound = pictures[1].ledger.row("atmosphere").bound
        assert change <= bound * (1.0 + 1e-6)
        assert (change > 0.0) == (bound > 0.0) == (atmosphere != "none")


def test_mirrors_are_drawn_where_a_glossy_surface_may_be_in_view_alone(tmp_path: Path) -> None:
    baked = town(tmp_path, "auto")  # with a hall of sheet metal, a mast, walls of brick and a lawn
    lawn = look_at([-150.0, 150.0, 30.0], [-150.0, 170.0, 0.0], 20.0)
    with Renderer(baked, load_sensor("flir"), size=SIZE) as renderer:
        found = [renderer.render(camera, 36000.0).ledger for camera in (ABOVE, lawn)]
    assert [ledger.plan.has("specular") for ledger in found] == [True, False]
    assert found[1].row("specular").bound == 0.0


def test_every_pixel_from_tables_with_lobes_is_within_tolerance_of_all_effects(tmp_path: Path) -> None:
    """The default bake."""
    with Renderer(town(tmp_path, "all", settings=BakeSettings()), load_sensor("flir"), size=SIZE) as full, Renderer(
        town(tmp_path, "auto", settings=BakeSettings()), load_sensor("flir"), size=SIZE
    ) as lean:  # fmt: skip
        assert full.world.tables.lobes is not None
        for hour in (6.0, 10.0, 14.5):
            compare(full, lean, ACROSS, hour)


@pytest.mark.parametrize(
    ("sensor", "left"), [("flir", "-atmosphere"), ("lltv", "-atmosphere"), ("lltv", "-atmosphere,-reflected_sun")]
)
def test_frames_for_display_alone_leave_out_air_and_sunlight_on_the_quick_road(
    sensor: str, left: str, tmp_path: Path
) -> None:
    """Within a code of the whole frame, and unlike the frame that has them."""
    baked = town(tmp_path, "auto", sensor)
    shown = {}
    for choice in ("all", f"all,{left}"):
        chosen = replace(baked, choice=read_choice(choice))
        with Renderer(chosen, load_sensor(sensor), size=SIZE) as renderer:
            whole = renderer.render(ACROSS, 36000.0)
            quick = renderer.render(ACROSS, 36000.0, planes=("display",), display=whole.display)
            assert renderer._quick is not None
        assert np.abs(quick.planes["display"].astype(int) - whole.planes["display"]).max() <= 1
        shown[choice] = quick.planes["display"].astype(int)
    assert np.abs(np.subtract(*shown.values())).max() > 3
