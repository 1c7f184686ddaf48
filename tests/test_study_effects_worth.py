"""What effects are worth on the report's images: never more than their bounds, and nothing where they are absent."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path

import pytest

from sensorsim.study.effects_page import HEAD, row, write_effects_page
from sensorsim.study.effects_worth import EffectWorth, image_count, measure_effects
from sensorsim.study.gallery import FIGURES, WINTER
from sensorsim.tables import BakeSettings

COARSE = BakeSettings(
    interpolation="barycentric", lobes=0.0, orientations="icosphere42", reflectances=(0.1, 0.9), degree=1,
    step=1800.0, slice_interval=3600.0, lead_in_days=1.0,
)  # fmt: skip


@cache
def worths() -> Mapping[str, EffectWorth]:
    """On the images of level IA, small and coarse."""
    found = measure_effects(settings=COARSE, size=(64, 48), places=[("IA", WINTER)], bakes=1)
    return {worth.effect: worth for worth in found}


@pytest.mark.parametrize("effect", ["rain", "snow"])
def test_effect_that_the_images_do_not_call_for_changes_nothing(effect: str) -> None:
    assert worths()[effect].kelvin_max == worths()[effect].white_max == 0.0


@pytest.mark.parametrize("effect", ["direct_sun", "thermal_sky", "forced_convection", "reflected_sky", "atmosphere"])
def test_effect_that_they_call_for_is_seen_in_all_of_the_band(effect: str) -> None:
    worth = worths()[effect]
    assert 0.1 < worth.kelvin_rms <= worth.kelvin_max <= worth.kelvin_bound
    assert worth.called >= 4


def test_exchange_is_measured_though_no_image_calls_for_it() -> None:
    worth = worths()["exchange"]
    assert worth.called == 0
    assert 0.05 < worth.kelvin_max <= worth.kelvin_bound
    assert worth.bake_ms > 0.0


def test_histories_that_no_surface_shows_are_worth_time_and_nothing_else() -> None:
    worth = worths()["spare_orientations"]
    assert worth.kelvin_max < 1e-3
    assert worth.bake_ms > 0.0


def test_no_image_changes_by_more_than_its_bound() -> None:
    assert all(worth.holds for worth in worths().values())
    assert 0.1 < worths()["reflected_sun"].white_max < 2.0


def test_page_tells_all_effects_and_colours_a_bound_that_fails(tmp_path: Path) -> None:
    found = list(worths().values())
    write_effects_page(tmp_path / "page.html", found, image_count())
    assert 'class="alarm"' not in (tmp_path / "page.html").read_text()
    found[1] = EffectWorth(effect="direct_sun", kelvin_max=3.0, kelvin_bound=2.0, holds=False, squares=[4.0])
    write_effects_page(tmp_path / "page.html", found, image_count())
    text = (tmp_path / "page.html").read_text()
    assert text.count('class="alarm"') == 1
    assert all(f"<td>{worth.effect}</td>" in text for worth in found)
    assert {len(row(worth)) for worth in found} == {len(HEAD)}


def test_images_are_counted_once() -> None:
    shown = [(figure.level, figure.sensor, *moment) for figure in FIGURES for moment in figure.moments]
    assert image_count() == len(set(shown)) < len(shown)
