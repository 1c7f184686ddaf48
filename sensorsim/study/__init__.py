"""Studies: the report's figures drawn again, what its text says of them, and one wall against time."""

from sensorsim.study.gallery import FIGURES, Figure, make_gallery
from sensorsim.study.wall_plot import plot_wall, require_plot

__all__ = ["FIGURES", "Figure", "make_gallery", "plot_wall", "require_plot"]
