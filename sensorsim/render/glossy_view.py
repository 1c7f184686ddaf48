"""Glossy surfaces that may be in a picture in a reflective band: from where on they are seen, for their bounds."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from sensorsim.effects import Gleam, Glossy, diffuse_irradiance, gleam
from sensorsim.render.camera import Camera
from sensorsim.render.illumination import Illumination
from sensorsim.render.mirror import facet_table, gloss_records
from sensorsim.render.ranges import half_field
from sensorsim.render.surface_table import surface_codes
from sensorsim.scene import Mesh, Scene
from sensorsim.tables.assign import Assignment

FloatArray = NDArray[np.float64]


def gleam_in_view(
    scene: Scene, assignment: Assignment, camera: Camera, size: tuple[int, int], surface: NDArray[np.int64],
    illumination: Illumination,
) -> Gleam:  # fmt: skip
    """Bounds of what those of the surfaces (s,) that are glossy show."""
    kind, facet = _records(assignment)
    row = surface[kind[surface] >= 0]
    if not row.size:
        return Gleam()
    normal, (eye, reach) = scene.surfaces.normal[row], _directions(scene.mesh, camera, size, row)
    glossy = Glossy(
        normal=normal, eye=eye, reach=reach, kind=kind[row], reflectance=assignment.nir_reflectance[row],
        facet=facet[row], facets=facet_table(illumination.wind_speed),
        even=max(float(illumination.sky.max()), illumination.ground_radiance), glow=illumination.glow,
    )  # fmt: skip
    light = diffuse_irradiance(normal, illumination.quadrant, illumination.ground_radiance)
    return gleam(glossy, np.asarray(illumination.sun_direction), illumination.beam, light)


def _directions(
    mesh: Mesh, camera: Camera, size: tuple[int, int], row: NDArray[np.int64]
) -> tuple[FloatArray, FloatArray]:
    """Unit vectors (s, 3) towards the camera from surfaces, and how far (s,) any other that shows lies from them.

    By the ball around a surface, or by the whole picture where that is narrower.
    """
    middle, radius = (ball[row] for ball in _balls(mesh))
    away = camera.position - middle
    distance = np.linalg.norm(away, axis=1)
    inside = radius >= distance
    angle = np.arcsin(np.minimum(radius / np.where(inside, 1.0, distance), 1.0))
    reach = np.where(inside, np.inf, 2.0 * np.sin(0.5 * angle))
    whole = 2.0 * np.sin(0.5 * half_field(camera, size))
    wide = reach >= whole
    eye = np.where(wide[:, None], -camera.axes()[0], away / np.where(distance > 0.0, distance, 1.0)[:, None])
    return eye, np.where(wide, whole, reach)


@lru_cache(maxsize=8)
def _balls(mesh: Mesh) -> tuple[FloatArray, FloatArray]:
    """Middle (s, 3) and radius (s,) of a ball around each surface [m]."""
    count = int(mesh.surface.max()) + 1
    lowest, highest = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    np.minimum.at(lowest, mesh.surface, mesh.position)
    np.maximum.at(highest, mesh.surface, mesh.position)
    return 0.5 * (lowest + highest), 0.5 * np.linalg.norm(highest - lowest, axis=1)


@lru_cache(maxsize=8)
def _records(assignment: Assignment) -> tuple[NDArray[np.int64], FloatArray]:
    """Kind of gloss (s,) or -1, and a facet's reflectance along the normal (s,)."""
    record = gloss_records(surface_codes(assignment), assignment.emissivity, assignment.nir_reflectance)
    return record[:, 0].astype(np.int64), record[:, 2]
