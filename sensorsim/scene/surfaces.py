"""The surface table: one row per polygon, a structure of arrays."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.scene.extrude import Facet
from sensorsim.scene.features import Feature
from sensorsim.scene.projection import FloatArray

IntArray = NDArray[np.int32]
TextArray = NDArray[np.str_]
BoolArray = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Surfaces:
    """What each polygon is: its direction, size and owner, and the words that name its material."""

    normal: FloatArray  # unit, east, north, up, shape (n, 3)
    area: FloatArray  # [m2], shape (n,)
    feature: IntArray  # row of the scene's features, shape (n,)
    part: IntArray  # part within its feature, shape (n,)
    role: TextArray  # 'roof', 'wall', 'bottom' or 'plane', shape (n,)
    word: TextArray  # four-digit material word used: the wall's for walls and bottoms, else the roof's, shape (n,)
    by_class: (
        BoolArray  # whether the feature's construction class decides the section; its word may be empty, shape (n,)
    )
    interior: TextArray  # condition behind the surface, shape (n,)


def build_surfaces(features: Sequence[Feature], facets: Sequence[Sequence[Sequence[Facet]]]) -> Surfaces:
    """Surface table of features whose parts' facets are given as facets[feature][part]."""
    rows = [
        (facet, index, part_index)
        for index, parts in enumerate(facets)
        for part_index, part in enumerate(parts)
        for facet in part
    ]
    words = [_word(features[index], facet) for facet, index, _ in rows]
    return Surfaces(
        normal=np.array([facet.normal for facet, _, _ in rows], dtype=np.float64),
        area=np.array([facet.area for facet, _, _ in rows], dtype=np.float64),
        feature=np.array([index for _, index, _ in rows], dtype=np.int32),
        part=np.array([part for _, _, part in rows], dtype=np.int32),
        role=np.array([facet.role for facet, _, _ in rows]),
        word=np.array(words, dtype="<U4"),
        by_class=np.array([not word for word in words]),
        interior=np.array([features[index].interior for _, index, _ in rows], dtype="<U8"),
    )


def _word(feature: Feature, facet: Facet) -> str:
    return feature.wall_word_used if facet.role in ("wall", "bottom") else feature.roof_word_used
