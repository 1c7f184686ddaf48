"""Features of a scene: rows of the feature analysis sheet with their footprints.

Columns and their names are those of the feature analysis sheets, figures 3, 5 and 7 of [Report1978].
"""

from dataclasses import dataclass
from typing import Literal

from sensorsim.scene.projection import FloatArray

Interior = Literal["heated", "cooled", "unheated", "open", "none"]

INTERIORS: tuple[Interior, ...] = ("heated", "cooled", "unheated", "open", "none")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Part:
    """One footprint between two heights; a plane polygon where base and top are equal."""

    footprint: FloatArray  # longitude, latitude [deg], shape (n, 2), counter-clockwise seen from above, not closed
    holes: tuple[FloatArray, ...]  # the same, clockwise
    base: float  # above the scene's ground [m]
    top: float  # above the scene's ground [m]
    has_bottom: bool  # False where the solid stands on another one's roof, and for planes

    @property
    def is_plane(self) -> bool:
        """Whether the part has no height, and so is one polygon."""
        return self.top == self.base

    @property
    def rings(self) -> tuple[FloatArray, ...]:
        """The footprint, then its holes."""
        return (self.footprint, *self.holes)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Feature:
    """One row of the feature analysis sheet, its material words and its parts; None where the sheet has a dash."""

    number: str  # column A, feature analysis code number
    description: str
    feature_type: int | None  # B: 0 point, 1 line, 2 area
    surface_material: int | None  # C
    height: float  # D, predominant height [m]; a part's own base and top may differ from it
    number_of_structures: int | None  # E, coded density
    tree_coverage: float | None  # F [%]
    roof_coverage: float | None  # G [%]
    feature_id: int | None  # H
    directivity: int | None  # I
    point_dimension: float | None  # J [m]
    level: int | None  # K
    roof_word: str | None  # as printed in figure 10; None where the feature is not listed there
    wall_word: str | None
    roof_word_used: str  # empty where the construction class decides, as the next
    wall_word_used: str
    word_note: str  # why the words used were chosen; empty where figure 10 is unambiguous
    interior: Interior
    interior_note: str
    note: str  # on the outline and heights; may be empty
    parts: tuple[Part, ...]
    construction_class: str | None = None  # by section 3.5, for surfaces that no word describes
    interior_stated: bool = True  # False where `interior` is only what solids or planes usually have
    heat_gain: float = 0.0  # of people, lamps and machines inside [W per m2 of floor]
