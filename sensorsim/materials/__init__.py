"""What the scene is made of: the codes of the report's figure 9 as layered constructions with surface properties.

`load_catalogue` reads them from TOML, every number with its source; `parse_word` takes the four-digit material word
apart; a `WallType` is what the thermal model solves; `load_construction` reads a stack of layers from a file.
"""

from sensorsim.materials.catalogue import Catalogue, load_catalogue
from sensorsim.materials.code import MaterialWord, parse_word
from sensorsim.materials.construction import Construction, Layer, construction_names, load_construction
from sensorsim.materials.cover import Cover, Leafless
from sensorsim.materials.entry import Choice, Quantity
from sensorsim.materials.material import INTERIORS, ROUGHNESS_CLASSES, Material, WallPart, WallType
from sensorsim.materials.mixture import Component, Coverage, component_shares, part_reflectance
from sensorsim.materials.optical import nir_reflectance
from sensorsim.materials.readings import Reading

__all__ = [
    "INTERIORS",
    "ROUGHNESS_CLASSES",
    "Catalogue",
    "Choice",
    "Component",
    "Construction",
    "Cover",
    "Coverage",
    "Layer",
    "Leafless",
    "Material",
    "MaterialWord",
    "Quantity",
    "Reading",
    "WallPart",
    "WallType",
    "component_shares",
    "construction_names",
    "load_catalogue",
    "load_construction",
    "nir_reflectance",
    "parse_word",
    "part_reflectance",
]
