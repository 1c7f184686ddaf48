"""What near surfaces of a scene see of each other, of the sky and of the ground.

A surface alone on the ground plane sees sky and ground by its tilt. What stands before it takes a share of that: of
the sky by as much as it stands above the horizon of the element that sees it, of the ground by as much as it stays
below. Third surfaces that stand between two are met by rays between sample points of both, so that the share they let
through is an estimate; everything else is exact to rounding. Neighbours below the threshold count as sky and ground.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from sensorsim.errors import InputError
from sensorsim.thermal.neighbour_pairs import areas_above, candidate_pairs
from sensorsim.thermal.polygon_view_factors import Outlines, mutual_areas
from sensorsim.thermal.view_factors import ground_view_factor, sky_view_factor
from sensorsim.thermal.visibility import sample_points, visible_shares

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]

HORIZON = 0.01  # view factor by which neighbours may stand on the wrong side of the horizon before they are too many


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Exchange:
    """What the hemisphere of each of n surfaces is filled with; sky, ground and neighbours add up to one.

    Row i of the compressed sparse rows holds the neighbours of surface i. factor is that of eq. 5 of [Report1978] for
    the part in sight, times kept[i], which is below one only where estimates made neighbours fill more than the sky
    or the ground behind them; such rows are not reciprocal. An excess of less than a hundredth on one side of the
    horizon is taken for an error of the division between both and goes to the other side.
    """

    rows: IntArray  # where each surface's neighbours start in the next two, and their number, shape (n + 1,)
    columns: IntArray  # neighbour, shape (m,)
    factor: FloatArray  # view factor to it [-], shape (m,)
    sky_share: FloatArray  # view factor to what is left of the sky [-], shape (n,)
    ground_share: FloatArray  # view factor to what is left of the ground [-], shape (n,)
    sky_taken: FloatArray  # view factor to neighbours in front of the sky [-], shape (n,)
    ground_taken: FloatArray  # view factor to neighbours in front of the ground [-], shape (n,)
    kept: FloatArray  # share of the factors found that is kept [-], shape (n,)

    @property
    def neighbour_share(self) -> FloatArray:
        """Sum of the view factors to neighbours [-], shape (n,)."""
        return np.asarray(self.sky_taken + self.ground_taken)

    def matrix(self) -> csr_array:
        """View factors [-] as a sparse matrix, shape (n, n)."""
        count = len(self.sky_share)
        return csr_array((self.factor, self.columns, self.rows), shape=(count, count))


def build_exchange(
    outlines: Outlines, *, acting: BoolArray | None = None, threshold: float = 0.005, rays: int = 8
) -> Exchange:
    """Exchange of surfaces in local axes with z up, each with all that fill more than the threshold of its hemisphere.

    acting (n,) tells which surfaces count as neighbours and as obstacles: all but those that are the ground itself.
    rays is the number of sample points per surface between which obstacles are looked for, 0 to look for none.
    Raises InputError for a threshold outside 0 to 1, a mask that does not fit, and rays below zero.
    """
    count = len(outlines.area)
    mask = np.ones(count, dtype=np.bool_) if acting is None else np.asarray(acting, dtype=np.bool_)
    if mask.shape != (count,):
        raise InputError("exchange", "acting", mask.shape, f"not one value for each of {count} surfaces", "give a mask")
    if not 0.0 < threshold < 1.0:
        raise InputError("exchange", "threshold", threshold, "not between 0 and 1", "give the least view factor wanted")
    if rays < 0:
        raise InputError("exchange", "rays", rays, "less than none", "give a number of points per surface, or 0")
    first, second = candidate_pairs(outlines, mask, threshold)
    mutual = mutual_areas(outlines, first, second)
    enough = mutual >= threshold * np.minimum(outlines.area[first], outlines.area[second])
    first, second, mutual = first[enough], second[enough], mutual[enough]
    through = np.ones(len(mutual))
    if rays > 0:
        through = visible_shares(outlines, sample_points(outlines, rays), mask, first, second)
    row, column = np.concatenate((first, second)), np.concatenate((second, first))
    whole, seen = np.concatenate((mutual, mutual)), np.concatenate((through, through))
    large = mask[column] & (whole * seen >= threshold * outlines.area[row])
    row, column, whole, seen = row[large], column[large], whole[large], seen[large]
    above = areas_above(outlines, row, column, whole) * seen
    return _fill(outlines, row, column, whole * seen / outlines.area[row], above / outlines.area[row])


def _fill(outlines: Outlines, row: IntArray, column: IntArray, factor: FloatArray, above: FloatArray) -> Exchange:
    """Sort the factors into rows; shrink those that fill more than there is, see `Exchange`."""
    count = len(outlines.area)
    sky, ground = sky_view_factor(outlines.normal), ground_view_factor(outlines.normal)
    higher = np.bincount(row, weights=above, minlength=count)
    lower = np.bincount(row, weights=factor - above, minlength=count)
    fill = np.maximum(higher / (sky + HORIZON), lower / (ground + HORIZON))
    kept = 1.0 / np.maximum(np.maximum(fill, higher + lower), 1.0)
    over, under = np.maximum(higher * kept - sky, 0.0), np.maximum(lower * kept - ground, 0.0)
    sky_taken = np.clip(higher * kept - over + under, 0.0, sky)
    ground_taken = np.clip(lower * kept - under + over, 0.0, ground)
    order = np.lexsort((column, row))
    return Exchange(
        rows=np.concatenate(([0], np.cumsum(np.bincount(row, minlength=count)))),
        columns=column[order],
        factor=(factor * kept[row])[order],
        sky_share=sky - sky_taken,
        ground_share=ground - ground_taken,
        sky_taken=sky_taken,
        ground_taken=ground_taken,
        kept=kept,
    )
