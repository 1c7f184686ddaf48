"""The audit tells all that was read and every reading chosen."""

import json

import pytest

from sensorsim.scene import INTERIORS, LEVELS, Audit, audit_scene, load_scene

CODES = {code: f"material {code}" for code in (9, 10, 12, 20, 22, 25, 26, 30, 31, 32, 33, 50, 67, 80, 90, 94, 95, 96)}
NOTES = {"3430": "read as 3130", "3630": "read as 3030"}


def _audit(level: str) -> Audit:
    return audit_scene(load_scene("hospital", level=level), CODES, NOTES)


@pytest.mark.parametrize("level", LEVELS)
def test_audit_becomes_json_and_accounts_for_all_surfaces(level: str) -> None:
    audit, scene = _audit(level), load_scene("hospital", level=level)
    assert json.loads(json.dumps(audit.to_dict()))["counts"]["edges"] == scene.counts.edges
    assert sum(use.surfaces for use in audit.words) == scene.counts.surfaces
    assert sum(use.area for use in audit.words) == pytest.approx(float(scene.surfaces.area.sum()), rel=1e-12)
    numbers = [number for group in audit.interiors.values() for number in group]
    assert sorted(numbers) == sorted(feature.number for feature in scene.features)
    assert set(audit.interiors) <= set(INTERIORS)
    assert {"tower", "hospital", "cement_plant", "overhead"} == set(audit.cameras)


def test_words_outside_the_catalogue_are_told_with_their_reading() -> None:
    outside = {use.word: use for use in _audit("IA").words if use.material is None}
    assert set(outside) == {"3430", "3434", "3630"}
    assert outside["3630"].walls == ("2", "4", "7", "8")
    assert outside["3630"].note == "read as 3030"
    assert outside["3434"].reflectance == pytest.approx(0.34)


@pytest.mark.parametrize(("level", "numbers", "words"), [
    ("IA", ("9",), ("3230", "3238", "3230", "3238")),
    ("IA", ("12",), (None, None, "3320", "3320")),
    ("IIA", ("9", "10", "11"), (None, None, "3030", "3030")),
    ("IIA", ("12",), ("3230", "3238", "3230", "3238")),
    ("IIIB", ("48",), ("2000", "2040", "2000", "2040")),
    ("IIIB", ("81", "82", "84", "85", "86"), (None, None, "9020", "9020")),
    ("IIIB", ("87",), (None, None, "8038", "8038")),
])  # fmt: skip
def test_gaps_and_contradictions_of_figure_10_are_told(
    level: str, numbers: tuple[str, ...], words: tuple[str | None, ...]
) -> None:
    (reading,) = (reading for reading in _audit(level).readings if reading.numbers == numbers)
    assert (reading.roof_word, reading.wall_word, reading.roof_word_used, reading.wall_word_used) == words
    assert reading.note


def test_every_word_not_as_printed_has_its_reason() -> None:
    for level in LEVELS:
        for feature in load_scene("hospital", level=level).features:
            printed = (feature.roof_word, feature.wall_word)
            if printed != (feature.roof_word_used, feature.wall_word_used):
                assert feature.word_note
