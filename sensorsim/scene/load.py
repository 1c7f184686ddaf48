"""A scene from a name or a file: features, surface table, mesh, counts and cameras in one frozen piece."""

from dataclasses import dataclass, replace
from itertools import chain
from pathlib import Path

from sensorsim.errors import InputError
from sensorsim.resources import assets_folder
from sensorsim.scene.counts import Counts, count_features
from sensorsim.scene.extrude import extrude
from sensorsim.scene.features import Feature
from sensorsim.scene.levels import ALL_LEVELS, LEVELS, check_level
from sensorsim.scene.lineage import Lineage, trace
from sensorsim.scene.mesh import Mesh, build_mesh
from sensorsim.scene.place import PLACE_FILE, CameraStation, SceneSite, derive_place, read_place
from sensorsim.scene.projection import LocalFrame
from sensorsim.scene.reader import read_collection, read_features
from sensorsim.scene.surfaces import Surfaces, build_surfaces


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Scene:
    """What is there, at one level of detail or at all of them, with their lineage, to choose from while it is drawn.

    Local axes: x east, y north, z up from the site's ground [m].
    """

    name: str
    level: str
    site: SceneSite
    features: tuple[Feature, ...]
    surfaces: Surfaces
    mesh: Mesh
    counts: Counts
    cameras: tuple[CameraStation, ...]
    notes: tuple[str, ...]
    files: tuple[Path, ...]  # what was read
    lineage: Lineage | None = None  # of the features where all levels are there

    @property
    def frame(self) -> LocalFrame:
        """Longitude and latitude to local metres and back."""
        return LocalFrame(longitude=self.site.longitude, latitude=self.site.latitude)

    def camera(self, name: str) -> CameraStation:
        """The camera of that name; InputError where there is none."""
        for station in self.cameras:
            if station.name == name:
                return station
        known = ", ".join(station.name for station in self.cameras)
        raise InputError(self.name, "camera", name, "no such camera", f"use one of {known}")


def scene_names() -> tuple[str, ...]:
    """Names of the scenes that come with the package."""
    return tuple(sorted(folder.name for folder in _scenes_folder().iterdir() if (folder / PLACE_FILE).is_file()))


def load_scene(name_or_path: str | Path, *, level: str = "IIIB") -> Scene:
    """A scene that comes with the package, by name, or any GeoJSON file of footprints with heights, by path.

    A file whose top-level member `level` differs from the level asked for is refused; one without it is taken as it
    is at every level. Site and cameras come from a `scene.toml` in the same folder, else from the outlines.
    Raises InputError for an unknown name or level and for whatever in the file cannot be honoured.
    """
    check_level(name_or_path, level)
    name, file = _find(name_or_path, level)
    document = read_collection(file)
    if (held := document.get("level")) is not None and check_level(file, held) != level:
        raise InputError(file, "level", level, f"the file holds level {held}", f"ask for {held} or another file")
    features = read_features(file, document)
    place_file = file.parent / PLACE_FILE
    site, cameras = read_place(place_file) if place_file.is_file() else derive_place(name, features)
    files = (file, place_file) if place_file.is_file() else (file,)
    return _built(name, level, site, cameras, features, _notes(file, document), files)


def load_all_levels(name: str) -> Scene:
    """A scene that comes with the package with the features of all its levels, from coarse to fine, and their lineage.

    Its level is ALL_LEVELS; the numbers of its features begin with their level. InputError for an unknown name, and
    for a file, which holds one level.
    """
    if name not in scene_names():
        remedy = f"use one of {', '.join(scene_names())}, or name a level"
        raise InputError(name, "level", ALL_LEVELS, "there is no such scene with several levels", remedy)
    each = [load_scene(name, level=level) for level in LEVELS]
    features = tuple(
        replace(feature, number=f"{scene.level} {feature.number}") for scene in each for feature in scene.features
    )
    notes = tuple(dict.fromkeys(chain.from_iterable(scene.notes for scene in each)))
    files = tuple(dict.fromkeys(chain.from_iterable(scene.files for scene in each)))
    whole = _built(name, ALL_LEVELS, each[0].site, each[0].cameras, features, notes, files)
    return replace(whole, lineage=trace([scene.features for scene in each], whole.frame))


def _built(
    name: str, level: str, site: SceneSite, cameras: tuple[CameraStation, ...], features: tuple[Feature, ...],
    notes: tuple[str, ...], files: tuple[Path, ...],
) -> Scene:  # fmt: skip
    """The scene of these features, with their surfaces and triangles."""
    frame = LocalFrame(longitude=site.longitude, latitude=site.latitude)
    facets = [[extrude(part, frame) for part in feature.parts] for feature in features]
    return Scene(
        name=name,
        level=level,
        site=site,
        features=features,
        surfaces=build_surfaces(features, facets),
        mesh=build_mesh(chain.from_iterable(chain.from_iterable(facets))),
        counts=count_features(features),
        cameras=cameras,
        notes=notes,
        files=files,
    )


def _scenes_folder() -> Path:
    return assets_folder() / "scenes"


def _find(name_or_path: str | Path, level: str) -> tuple[str, Path]:
    path = Path(name_or_path)
    if str(name_or_path) in scene_names():
        return path.name, _scenes_folder() / path.name / f"{path.name}_{level}.geojson"
    if path.is_file():
        return path.stem, path
    remedy = f"use one of {', '.join(scene_names())} or the path of a GeoJSON file"
    raise InputError(name_or_path, "scene", str(name_or_path), "no such scene or file", remedy)


def _notes(file: Path, document: dict[str, object]) -> tuple[str, ...]:
    notes = document.get("notes", [])
    if not isinstance(notes, list) or not all(isinstance(note, str) for note in notes):
        raise InputError(file, "notes", notes, "not a list of texts", "write a list of quoted sentences")
    return tuple(str(note) for note in notes)
