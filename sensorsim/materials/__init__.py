"""What the scene is made of: the codes of the report's figure 9 as layered constructions with surface properties.

`load_catalogue` reads them from TOML, every number with its source; `parse_word` takes the four-digit material word
apart; a `WallType` is what the thermal model solves; `load_construction` reads a stack of layers from a file; a
`ConstructionClass` gives a feature of which only the kind is known the standard sections of that kind.
"""

from sensorsim.materials.catalogue import Catalogue, load_catalogue
from sensorsim.materials.classes import ConstructionClass, Section
from sensorsim.materials.code import MaterialWord, parse_word
from sensorsim.materials.construction import Construction, construction_names, load_construction
from sensorsim.materials.cover import Cover, Leafless
from sensorsim.materials.entry import Choice, Quantity
from sensorsim.materials.layers import SHAPES, Layer, ThermalPath
from sensorsim.materials.material import ROUGHNESS_CLASSES, Material
from sensorsim.materials.mixture import Component, Coverage, component_shares, part_reflectances
from sensorsim.materials.optical import nir_reflectance
from sensorsim.materials.readings import Reading
from sensorsim.materials.wall_type import ENCLOSED, INTERIORS, Room, WallPart, WallType

__all__ = [
    "ENCLOSED",
    "INTERIORS",
    "ROUGHNESS_CLASSES",
    "SHAPES",
    "Catalogue",
    "Choice",
    "Component",
    "Construction",
    "ConstructionClass",
    "Cover",
    "Coverage",
    "Layer",
    "Leafless",
    "Material",
    "MaterialWord",
    "Quantity",
    "Reading",
    "Room",
    "Section",
    "ThermalPath",
    "WallPart",
    "WallType",
    "component_shares",
    "construction_names",
    "load_catalogue",
    "load_construction",
    "nir_reflectance",
    "parse_word",
    "part_reflectances",
]
