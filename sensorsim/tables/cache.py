"""Baked tables on disk, found by a hash of everything that made them: weather, wall types, settings and the code.

A file is written whole or not at all. It carries the hash of its own arrays; one that is damaged, cut off or foreign
is baked again, never trusted. Folder: SENSORSIM_CACHE (or `off`), else `sensorsim` in the user's cache folder.
"""

import hashlib
import io
import os
import zipfile
from collections.abc import Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np

from sensorsim.effects import EVERYTHING, EffectPlan
from sensorsim.environment import Environment
from sensorsim.files import placed_whole
from sensorsim.materials import WallType
from sensorsim.tables.bake import Progress, bake_tables
from sensorsim.tables.coefficients import ShadeTables
from sensorsim.tables.lobes import Lobes
from sensorsim.tables.scope import Scope, wants_lobes, whole_scope
from sensorsim.tables.settings import BakeSettings
from sensorsim.thermal.lead_in import lead_in_of

CACHE_VARIABLE = "SENSORSIM_CACHE"
KEPT = 64  # files; the ones not used for longest go first
_SEEN_ONLY = ("visibility", "aerosol")  # bear on what a sensor sees, not on how warm a wall is
_ARRAYS = ("time_of_day", "coefficients", "level", "loss", "towards", "ground_temperature")
_LOBES = ("sun", "direction", "weight", "gain")
_CODE = ("constants.py", "effects", "environment", "materials", "thermal", "tables")


def cached_tables(
    environment: Environment,
    wall_types: Sequence[WallType],
    *,
    ground: WallType,
    settings: BakeSettings,
    progress: Progress | None = None,
    plan: EffectPlan = EVERYTHING,
    scope: Scope | None = None,
) -> ShadeTables:
    """The same as `bake_tables`, from disk where it has been baked before with the same inputs and code."""
    folder = cache_folder()
    scope = whole_scope(wall_types, settings) if scope is None else scope

    def bake() -> ShadeTables:
        return bake_tables(
            environment, wall_types, ground=ground, settings=settings, progress=progress, plan=plan, scope=scope
        )

    if folder is None:
        return bake()
    path = folder / f"{inputs_digest(environment, wall_types, ground, settings, plan=plan, scope=scope)}.npz"
    lobes = wants_lobes(settings, scope, plan)
    arrays = _read(path, (*_ARRAYS, *_LOBES) if lobes else _ARRAYS)
    if arrays is not None:
        return ShadeTables(
            day=environment.image_start.date(),
            wall_types=tuple(wall_types),
            orientations=scope.lookup,
            lobes=Lobes(**{name: arrays[name] for name in _LOBES}) if lobes else None,
            settings=settings,
            lead_in=tuple(lead_in_of(wall, environment, own=settings.lead_in_days is None) for wall in wall_types),
            **{name: arrays[name] for name in _ARRAYS},
        )
    tables = bake()
    _write(path, tables)
    return tables


def cache_folder() -> Path | None:
    """Where tables are kept, or None where that is switched off."""
    chosen = os.environ.get(CACHE_VARIABLE, "")
    if chosen.lower() == "off":
        return None
    home = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
    return Path(chosen) if chosen else Path(home) / "sensorsim"


def inputs_digest(
    environment: Environment, wall_types: Sequence[WallType], ground: WallType, settings: BakeSettings, *,
    plan: EffectPlan = EVERYTHING, scope: Scope | None = None,
) -> str:  # fmt: skip
    """SHA-256 of all that decides the tables."""
    scope = whole_scope(wall_types, settings) if scope is None else scope
    digest = hashlib.sha256()
    for field in fields(environment):
        if field.name in _SEEN_ONLY:
            continue
        value = getattr(environment, field.name)
        digest.update(field.name.encode())
        digest.update(value.tobytes() if isinstance(value, np.ndarray) else repr(value).encode())
    tabled = replace(settings, exchange=False)  # comes on top of the tables
    digest.update(repr((tuple(wall_types), ground, tabled, plan.surface, scope.reflectances, scope.lit)).encode())
    digest.update(scope.solved.tobytes() + scope.needed.tobytes())
    package = Path(__file__).resolve().parent.parent
    for name in _CODE:
        source = package / name
        for path in sorted(source.glob("*.py")) if source.is_dir() else [source]:
            digest.update(path.read_bytes())
    return digest.hexdigest()


def _arrays_digest(arrays: dict[str, Any]) -> str:
    digest = hashlib.sha256()
    for name in arrays:
        digest.update(f"{name}{arrays[name].dtype}{arrays[name].shape}".encode())
        digest.update(np.ascontiguousarray(arrays[name]).tobytes())
    return digest.hexdigest()


def _read(path: Path, names: Sequence[str]) -> dict[str, Any] | None:
    """Arrays of a cache file, or None where there is none that can be trusted."""
    try:
        with np.load(io.BytesIO(path.read_bytes()), allow_pickle=False) as file:
            arrays = {name: file[name] for name in names}
            sound = str(file["digest"]) == _arrays_digest(arrays)
        os.utime(path)
    except (OSError, KeyError, ValueError, EOFError, zipfile.BadZipFile):
        return None
    return arrays if sound else None


def _write(path: Path, tables: ShadeTables) -> None:
    """Put a cache file in place; a folder that cannot be written is no error, only no cache."""
    arrays = {name: getattr(tables, name) for name in _ARRAYS}
    if tables.lobes is not None:
        arrays |= {name: getattr(tables.lobes, name) for name in _LOBES}
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with placed_whole(path) as (partial,):
            np.savez(partial, digest=np.array(_arrays_digest(arrays)), **arrays)
        _forget_old(path.parent)
    except OSError:
        return


def _forget_old(folder: Path) -> None:
    files = sorted(folder.glob("*.npz"), key=lambda path: path.stat().st_mtime, reverse=True)
    for path in files[KEPT:]:
        path.unlink(missing_ok=True)
