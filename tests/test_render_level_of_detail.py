"""The three levels of the hospital as levels of detail of one scene: what is shown from where, and no flicker."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from small_world import DAY, SETTINGS, town

from sensorsim.environment import read_weather
from sensorsim.errors import InputError
from sensorsim.render import Camera, Renderer, World, build_world, look_at
from sensorsim.render.detail import DetailRule
from sensorsim.render.shown import Cut, Families, families
from sensorsim.scene import LEVELS, Scene, load_all_levels, load_scene
from sensorsim.sensor import load_sensor

COARSE = replace(SETTINGS, orientations="report10", step=600.0)
SIZE = (160, 120)
RULE = DetailRule(pixels=4.0)


@cache
def scene() -> Scene:
    return load_all_levels("hospital")


@cache
def boxes() -> Families:
    return families(scene())


@cache
def world(level: str) -> World:
    place = scene() if level == "auto" else load_scene("hospital", level=level)
    return build_world(place, read_weather("winter"), image_day=DAY, settings=COARSE)


def camera(distance: float, field: float = 15.0) -> Camera:
    """From the south-west, a little above the ground."""
    return look_at([-0.8 * distance, -0.6 * distance, 0.1 * distance + 20.0], [0.0, 0.0, 0.0], field)


def cameras(count: int) -> list[Camera]:
    rng = np.random.default_rng(8)
    found = []
    for reach in np.geomspace(200.0, 5e5, count):
        place = reach * rng.normal(size=3)
        at = [place[0], place[1], abs(place[2]) + 2.0]
        found.append(look_at(at, rng.uniform(-500.0, 500.0, 3), float(rng.uniform(1.0, 90.0))))
    return found


def test_near_by_all_is_of_the_finest_level_and_far_away_of_the_coarsest() -> None:
    level = boxes().lineage.level
    for near in (camera(10.0), camera(3000.0)):
        np.testing.assert_array_equal(boxes().cut(near, SIZE, DetailRule()).shown, level == 2)
    far = boxes().cut(camera(1e7), SIZE, DetailRule())
    np.testing.assert_array_equal(far.shown, level == 0)


def test_of_a_feature_and_what_stands_in_it_one_is_shown() -> None:
    """Up the lineage of every feature of the finest level that has kin at both others, exactly one is in a picture."""
    lineage = boxes().lineage
    whole = [row for row in np.flatnonzero(lineage.level == 2) if lineage.parent[lineage.parent[row]] >= 0]
    whole = [row for row in whole if lineage.parent[row] >= 0]
    assert len(whole) > 60
    for view in cameras(300):
        shown = boxes().cut(view, SIZE, RULE).shown
        for row in whole:
            above = lineage.parent[row]
            assert int(shown[row]) + int(shown[above]) + int(shown[lineage.parent[above]]) == 1
        ground = np.unique(lineage.level[shown & lineage.is_ground])
        assert ground.size == 1
        assert np.sum(shown & lineage.is_ground) == np.sum(lineage.is_ground & (lineage.level == ground[0]))


def test_features_of_one_picture_are_of_several_levels() -> None:
    """Seen along the strip, what is near is finer than what is far."""
    place = np.array([-2300.0, -2000.0, 100.0])
    cut = boxes().cut(look_at(place, [0.0, 0.0, 0.0], 60.0), (120, 90), RULE)
    lineage = boxes().lineage
    middle = 0.5 * (boxes().lowest + boxes().highest)
    away = np.linalg.norm(middle - place, axis=1)
    linked = cut.shown & ((lineage.parent >= 0) | (lineage.kin == "root"))
    means = [away[linked & (lineage.level == level)].mean() for level in range(3)]
    assert means[0] > means[1] > means[2]


def test_what_has_no_kin_appears_by_its_own_size() -> None:
    """The church, 49 m across: there while it covers more than the rule's pixels, gone where it covers fewer."""
    row = next(row for row, one in enumerate(scene().features) if one.number == "IIIB 42")
    size, angle = boxes().size[row], 2.0 * np.tan(np.radians(7.5)) / SIZE[0]
    place = 0.5 * (boxes().lowest[row] + boxes().highest[row])
    for share, there in ((0.98, True), (1.02, False)):
        distance = share * size / (RULE.pixels * angle) + 0.5 * size
        view = Camera(
            position=place + np.array([0.0, 0.0, distance]), yaw=0.0, pitch=-90.0, horizontal_field_of_view=15.0
        )  # fmt: skip
        assert bool(boxes().cut(view, SIZE, RULE).shown[row]) == there


def _flight(steady: bool, distances: np.ndarray) -> list[Cut]:
    cuts: list[Cut] = []
    for distance in distances:
        cuts.append(boxes().cut(camera(float(distance)), SIZE, RULE, cuts[-1] if steady and cuts else None))
    return cuts


def test_a_shaken_camera_at_a_border_does_not_flicker() -> None:
    """Expected: with the last picture in mind each feature changes once; without, many times."""
    base = next(d for d in np.geomspace(2e4, 2e5, 4000) if boxes().cut(camera(d), SIZE, RULE).shown[0])
    shaken = base * (1.0 + 0.02 * np.random.default_rng(3).uniform(-1.0, 1.0, 200))
    for steady, least, most in ((True, 0, 1), (False, 50, 200)):
        shown = np.array([cut.shown[0] for cut in _flight(steady, shaken)])
        assert least <= np.count_nonzero(np.diff(shown)) <= most


@pytest.mark.parametrize("speed", [30.0, 250.0, 700.0])
def test_a_passage_changes_each_feature_at_most_once_on_the_way_in(speed: float) -> None:
    """At 30 pictures a second from 200 km away; steps of 40 pictures, which changes nothing of what is counted."""
    cuts = _flight(True, np.arange(2e5, 1e3, -speed / 30.0 * 40.0 * 10.0))
    shown = np.array([cut.shown for cut in cuts])
    assert np.all(np.count_nonzero(np.diff(shown, axis=0), axis=0) <= 2)
    np.testing.assert_array_equal(shown[-1], boxes().lineage.level == 2)


@pytest.mark.parametrize("sensor", ["flir", "lltv"])
def test_pictures_near_by_and_far_away_are_those_of_one_level(sensor: str) -> None:
    """Bit for bit, whole frames and those for display alone, and back again."""
    rule = DetailRule(pixels=16.0)
    with (
        Renderer(world("auto"), load_sensor(sensor), size=SIZE, detail=rule) as mixed,
        Renderer(world("IIIB"), load_sensor(sensor), size=SIZE) as fine,
        Renderer(world("IA"), load_sensor(sensor), size=SIZE) as coarse,
    ):
        for view, alone in ((camera(1500.0, 3.0), fine), (camera(3e4), coarse), (camera(900.0, 3.0), fine)):
            for planes in (("display",), ("radiance", "range", "display")):
                ours = mixed.render(view, 36000.0, planes=planes).planes
                theirs = alone.render(view, 36000.0, planes=planes).planes
                for plane in planes:
                    np.testing.assert_array_equal(ours[plane], theirs[plane])
            assert np.unique(theirs["display"]).size > 3


def test_both_roads_show_the_same_level_whichever_is_taken_first() -> None:
    for first in (("display",), None):
        with Renderer(world("auto"), load_sensor("flir"), size=SIZE, detail=RULE) as renderer:
            codes = []
            for distance in (4e4, 2e3):
                renderer.render(camera(distance), 36000.0, planes=first)
                for planes in (None, ("display",)):
                    codes.append(renderer.render(camera(distance), 36000.0, planes=planes).planes["display"])
        for whole, quick in (codes[:2], codes[2:]):
            assert np.abs(whole.astype(int) - quick.astype(int)).max() <= 1


def test_a_scene_of_one_level_has_nothing_to_choose_and_exchange_needs_one() -> None:
    with pytest.raises(InputError, match="no other level"):
        families(town().scene)
    with pytest.raises(InputError, match="exchange"):
        build_world(scene(), read_weather("winter"), image_day=DAY, settings=replace(COARSE, exchange=True))
    assert tuple(LEVELS) == ("IA", "IIA", "IIIB")
