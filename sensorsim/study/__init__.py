"""Studies: the report's figures drawn again, and what its text says of them."""

from sensorsim.study.gallery import FIGURES, Figure, make_gallery

__all__ = ["FIGURES", "Figure", "make_gallery"]
