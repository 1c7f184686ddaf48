"""What a scene holds, which words its materials go by and which readings were chosen: plain data for a report."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass

import numpy as np

from sensorsim.errors import InputError
from sensorsim.scene.counts import Counts
from sensorsim.scene.features import Feature
from sensorsim.scene.levels import LEVELS
from sensorsim.scene.lineage import Lineage
from sensorsim.scene.load import Scene


@dataclass(frozen=True, slots=True, kw_only=True)
class WordUse:
    """One material word and where it is used."""

    word: str
    material: str | None  # the catalogue's name of its first two digits, None where the catalogue has none
    reflectance: float  # its last two digits [-]
    roofs: tuple[str, ...]  # numbers of the features whose roof, or plane, has it
    walls: tuple[str, ...]  # numbers of the features whose walls have it
    surfaces: int
    area: float  # [m2]
    note: str  # the reading of a word outside the catalogue; empty for others


@dataclass(frozen=True, slots=True, kw_only=True)
class Reading:
    """Features that figure 10 leaves out, names twice or contradicts, or that go by class; the words used for them."""

    numbers: tuple[str, ...]
    description: str
    roof_word: str | None  # as printed
    wall_word: str | None
    roof_word_used: str
    wall_word_used: str
    note: str


@dataclass(frozen=True, slots=True, kw_only=True)
class LevelKin:
    """How the features of one level stand in those of the next coarser one."""

    level: str
    features: int
    ground: int  # planes, which change level together
    overlap: int  # solids that cover ground of a coarser one
    near: tuple[str, ...]  # that only lie beside one of their kind: numbers
    none: tuple[str, ...]  # that the coarser level lacks
    childless: tuple[str, ...]  # that the next finer level lacks


@dataclass(frozen=True, slots=True, kw_only=True)
class Audit:
    """The audit of one scene at one level."""

    scene: str
    level: str
    place: str
    counts: Counts
    solids: int
    planes: int
    words: tuple[WordUse, ...]  # in the order of the words
    readings: tuple[Reading, ...]
    interiors: Mapping[str, tuple[str, ...]]  # condition: numbers of features
    cameras: tuple[str, ...]
    notes: tuple[str, ...]
    levels: tuple[LevelKin, ...] = ()  # of a scene with all its levels, from coarse to fine

    def to_dict(self) -> dict[str, object]:
        """The same as dictionaries, lists and plain values, ready for JSON."""
        return asdict(self)


def audit_scene(scene: Scene, catalogue_codes: Mapping[int, str], word_notes: Mapping[str, str]) -> Audit:
    """Audit of a scene against a catalogue's codes (code: name) and its notes on words (word: reading chosen).

    InputError where a feature still waits for the sections of its construction class, which a catalogue resolves.
    """
    for feature in scene.features:
        if not (feature.roof_word_used and feature.wall_word_used):
            problem, remedy = "its sections are not resolved", "resolve the scene with the catalogue first"
            entry = f"feature {feature.number}: construction_class"
            raise InputError(scene.name, entry, feature.construction_class, problem, remedy)
    parts = [part for feature in scene.features for part in feature.parts]
    return Audit(
        scene=scene.name,
        level=scene.level,
        place=scene.site.name,
        counts=scene.counts,
        solids=sum(not part.is_plane for part in parts),
        planes=sum(part.is_plane for part in parts),
        words=_word_uses(scene, catalogue_codes, word_notes),
        readings=_readings(scene.features),
        interiors=_grouped(scene.features, lambda feature: feature.interior),
        cameras=tuple(camera.name for camera in scene.cameras),
        notes=scene.notes,
        levels=() if scene.lineage is None else _kin(scene, scene.lineage),
    )


def _grouped(features: tuple[Feature, ...], key: Callable[[Feature], str]) -> dict[str, tuple[str, ...]]:
    """Numbers of features by a key, in file order."""
    groups: dict[str, list[str]] = {}
    for feature in features:
        groups.setdefault(key(feature), []).append(feature.number)
    return {name: tuple(numbers) for name, numbers in groups.items()}


def _kin(scene: Scene, lineage: Lineage) -> tuple[LevelKin, ...]:
    def numbers(rows: Iterable[int]) -> tuple[str, ...]:
        return tuple(scene.features[row].number for row in rows)

    found, childless = [], lineage.childless()
    for number, level in enumerate(LEVELS):
        here = lineage.level == number
        found.append(
            LevelKin(
                level=level,
                features=int(np.sum(here)),
                ground=int(np.sum(here & lineage.is_ground)),
                overlap=int(np.sum(here & (lineage.kin == "overlap"))),
                near=numbers(np.flatnonzero(here & (lineage.kin == "near"))),
                none=numbers(np.flatnonzero(here & (lineage.kin == "none"))),
                childless=numbers(row for row in childless if lineage.level[row] == number),
            )
        )
    return tuple(found)


def _word_uses(scene: Scene, codes: Mapping[int, str], notes: Mapping[str, str]) -> tuple[WordUse, ...]:
    roofs = _grouped(scene.features, lambda feature: feature.roof_word_used)
    solids = tuple(feature for feature in scene.features if not feature.parts[0].is_plane)
    walls = _grouped(solids, lambda feature: feature.wall_word_used)
    table = scene.surfaces
    return tuple(
        WordUse(
            word=word,
            material=codes.get(int(word[:2])),
            reflectance=int(word[2:]) / 100.0,
            roofs=roofs.get(word, ()),
            walls=walls.get(word, ()),
            surfaces=int((table.word == word).sum()),
            area=float(table.area[table.word == word].sum()),
            note=notes.get(word, ""),
        )
        for word in sorted({*roofs, *walls, *table.word.tolist()})
    )


def _readings(features: tuple[Feature, ...]) -> tuple[Reading, ...]:
    noted: dict[tuple[object, ...], list[Feature]] = {}
    for feature in features:
        if feature.word_note:
            words = (feature.roof_word, feature.wall_word, feature.roof_word_used, feature.wall_word_used)
            noted.setdefault((*words, feature.word_note), []).append(feature)
    return tuple(
        Reading(
            numbers=tuple(feature.number for feature in group),
            description=group[0].description,
            roof_word=group[0].roof_word,
            wall_word=group[0].wall_word,
            roof_word_used=group[0].roof_word_used,
            wall_word_used=group[0].wall_word_used,
            note=group[0].word_note,
        )
        for group in noted.values()
    )
