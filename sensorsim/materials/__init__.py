"""What the scene is made of: the codes of the report's figure 9 as layered constructions with surface properties.

`load_catalogue` reads them from TOML, every number with its source; `parse_word` takes the four-digit material word
apart; a `WallType` is what the thermal model solves; `load_construction` reads a stack of layers from a file.
"""

from sensorsim.materials.catalogue import Catalogue, load_catalogue
from sensorsim.materials.code import MaterialWord, parse_word
from sensorsim.materials.construction import Construction, Layer, construction_names, load_construction
from sensorsim.materials.entry import Choice, Quantity
from sensorsim.materials.material import INTERIORS, ROUGHNESS_CLASSES, Material, WallType
from sensorsim.materials.optical import nir_reflectance
from sensorsim.materials.readings import Reading

__all__ = [
    "INTERIORS",
    "ROUGHNESS_CLASSES",
    "Catalogue",
    "Choice",
    "Construction",
    "Layer",
    "Material",
    "MaterialWord",
    "Quantity",
    "Reading",
    "WallType",
    "construction_names",
    "load_catalogue",
    "load_construction",
    "nir_reflectance",
    "parse_word",
]
