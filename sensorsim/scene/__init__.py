"""What is there: GeoJSON footprints with heights and material words become features, a surface table, a mesh, the
report's counts and named cameras; the hospital scene of [Report1978] at three levels of detail takes the same road
as any user's file."""

from sensorsim.scene.audit import Audit, Reading, WordUse, audit_scene
from sensorsim.scene.counts import Counts, count_features
from sensorsim.scene.extrude import Facet, extrude
from sensorsim.scene.features import INTERIORS, Feature, Part
from sensorsim.scene.levels import ALL_LEVELS, LEVELS, RESOLUTION
from sensorsim.scene.lineage import Lineage, trace
from sensorsim.scene.load import Scene, load_all_levels, load_scene, scene_names
from sensorsim.scene.mesh import Mesh, build_mesh, triangulate
from sensorsim.scene.place import CameraStation, SceneSite
from sensorsim.scene.projection import LocalFrame
from sensorsim.scene.surfaces import Surfaces, build_surfaces

__all__ = [
    "ALL_LEVELS",
    "INTERIORS",
    "LEVELS",
    "RESOLUTION",
    "Audit",
    "CameraStation",
    "Counts",
    "Facet",
    "Feature",
    "Lineage",
    "LocalFrame",
    "Mesh",
    "Part",
    "Reading",
    "Scene",
    "SceneSite",
    "Surfaces",
    "WordUse",
    "audit_scene",
    "build_mesh",
    "build_surfaces",
    "count_features",
    "extrude",
    "load_all_levels",
    "load_scene",
    "scene_names",
    "trace",
    "triangulate",
]
