"""What the air before a scene can change of a radiance, at most: from its terms, the heights and the longest range."""

from dataclasses import dataclass

import numpy as np

from sensorsim.effects.face import FloatArray
from sensorsim.environment import AirPath


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class AirBefore:
    """The air between a camera and all that it may see; heights are above the scene's origin."""

    path: AirPath
    camera_height: float  # [m]
    surface_heights: tuple[float, float]  # lowest and highest of surfaces that may be in view [m]
    longest_range: float  # of them [m]
    ground_range: float  # of the ground plane where it may be in view [m]; 0 where it is not, infinite at the horizon
    facing_light: float = 1.0  # greatest cosine of the angle between a ray of the picture and the sun or moon [-]

    @property
    def worst_opacity(self) -> float:
        """1 - tau [-] of the longest path to a surface, or more."""
        return float(self.path.weight @ self._opacity(self.longest_range, self.surface_heights))

    def dimmed(self, radiance: float) -> float:
        """Least radiance [W m-2 sr-1] through it of anything that radiates so much or more.

        Each term leaves a share and puts the rest of a glow in its place, so that it gives the lesser of both or more.
        """
        least, _ = self._glow((*self.surface_heights, 0.0))
        return float(self.path.weight @ np.minimum(radiance, least))

    @property
    def brightest(self) -> float:
        """Greatest radiance [W m-2 sr-1] of any endless path through it."""
        return float(self._glow((*self.surface_heights, 0.0))[1].max())

    def change(self, dimmest: float, brightest: float) -> float:
        """Greatest change [W m-2 sr-1] of surfaces whose radiance is between these."""
        return self._change(dimmest, brightest, self.longest_range, self.surface_heights)

    def ground_change(self, radiance: float) -> float:
        """The same of the ground plane where it may be in view."""
        return self._change(radiance, radiance, self.ground_range, (0.0,))

    def _change(self, dimmest: float, brightest: float, distance: float, heights: tuple[float, ...]) -> float:
        """A term takes (1 - t) of a radiance and puts as much of a glow in its place, from those along the path."""
        least, most = self._glow(heights)
        apart = np.maximum(np.maximum(brightest - least, most - dimmest), 0.0)
        return float(self.path.weight @ (self._opacity(distance, heights) * apart))

    def _opacity(self, distance: float, heights: tuple[float, ...]) -> FloatArray:
        """1 - t (k,) [-] of each term where the air is densest all along the path."""
        densest = self.path.densest(np.array([self.camera_height, *heights]))
        depth = np.where(densest > 0.0, distance, 0.0) * np.where(densest > 0.0, densest, 1.0)
        return np.asarray(-np.expm1(-depth))

    def _glow(self, heights: tuple[float, ...]) -> tuple[FloatArray, FloatArray]:
        """Least and greatest source (k,) [W m-2 sr-1] along the path: without the sun, and as near to it as may be."""
        near, slope = self.path.source_at(self.camera_height)
        along = near + np.outer(np.array([self.camera_height, *heights]) - self.camera_height, slope)
        g = self.path.asymmetry
        nearest = self.facing_light if g > 0.0 else -1.0  # haze of g below 0 sends most of it back
        ahead = self.path.beam_source * ((1.0 + g * g) / (1.0 + g * g - 2.0 * g * nearest)) ** 1.5
        return along.min(axis=0), along.max(axis=0) + ahead
