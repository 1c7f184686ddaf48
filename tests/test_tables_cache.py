"""Tables on disk: the same as baked, rebuilt when damaged, another file for other inputs, off when asked."""

from dataclasses import replace
from datetime import date
from pathlib import Path

import numpy as np
import pytest

from sensorsim.environment import build_environment, read_weather
from sensorsim.materials import load_catalogue
from sensorsim.tables import CACHE_VARIABLE, BakeSettings, cached_tables
from sensorsim.tables.cache import inputs_digest

SETTINGS = BakeSettings(orientations="report26", step=1800.0, slice_interval=3600.0, lead_in_days=1.0)
ENVIRONMENT = build_environment(read_weather("winter"), image_day=date(1976, 2, 7), lead_in_days=1.0, step=1800.0)
CATALOGUE = load_catalogue()
WALLS = (CATALOGUE.wall_type(20, "heated"),)
GROUND = CATALOGUE.wall_type(93, "none")


def _bake(progress: list[str]) -> np.ndarray:
    tables = cached_tables(
        ENVIRONMENT, WALLS, ground=GROUND, settings=SETTINGS, progress=lambda name, _done, _total: progress.append(name)
    )
    return tables.coefficients


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv(CACHE_VARIABLE, str(tmp_path / "cache"))
    return tmp_path / "cache"


def test_second_bake_comes_from_disk_unchanged(folder: Path) -> None:
    work: list[str] = []
    first, second = _bake(work), _bake(work)
    assert len(work) == 1
    np.testing.assert_array_equal(first, second)
    assert [path.suffix for path in folder.iterdir()] == [".npz"]


@pytest.mark.parametrize("damage", ["cut off", "one byte changed", "empty", "foreign"])
def test_damaged_file_is_rebuilt_not_trusted(folder: Path, damage: str) -> None:
    work: list[str] = []
    first = _bake(work)
    (path,) = folder.iterdir()
    content = bytearray(path.read_bytes())
    middle = len(content) // 2
    content[middle] ^= 0xFF
    other = folder.parent / "other.npz"
    np.savez(
        other,
        digest=np.array("0" * 64),
        time_of_day=np.zeros(2),
        coefficients=first,
        ground_temperature=np.zeros(2),
        level=np.zeros((2, 1)),
        loss=np.zeros((2, 1, 5)),
        towards=np.zeros((2, 2)),
        sun=np.zeros((2, 3)),
        direction=np.zeros((1, 3)),
        weight=np.zeros((2, 1, 2, 2)),
    )
    spoiled = {"cut off": bytes(content[:middle]), "one byte changed": bytes(content), "empty": b""}
    path.write_bytes(spoiled.get(damage, other.read_bytes()))
    np.testing.assert_array_equal(_bake(work), first)
    assert len(work) == 2
    np.testing.assert_array_equal(_bake(work), first)
    assert len(work) == 2


def test_every_input_has_a_part_in_the_name() -> None:
    plain = inputs_digest(ENVIRONMENT, WALLS, GROUND, SETTINGS)
    warmer = replace(ENVIRONMENT, air_temperature=ENVIRONMENT.air_temperature + 1e-6)
    colder_room = (CATALOGUE.wall_type(20, "open"),)
    others = {
        inputs_digest(warmer, WALLS, GROUND, SETTINGS),
        inputs_digest(ENVIRONMENT, colder_room, GROUND, SETTINGS),
        inputs_digest(ENVIRONMENT, WALLS, CATALOGUE.wall_type(91, "none"), SETTINGS),
        inputs_digest(ENVIRONMENT, WALLS, GROUND, replace(SETTINGS, degree=1)),
    }
    assert len(others | {plain}) == 5


def test_cache_can_be_switched_off_and_its_folder_may_be_unwritable(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(CACHE_VARIABLE, "off")
    work: list[str] = []
    first = _bake(work)
    monkeypatch.setenv(CACHE_VARIABLE, str(tmp_path / "file"))
    (tmp_path / "file").write_text("no folder")
    np.testing.assert_array_equal(_bake(work), first)
    assert len(work) == 2
