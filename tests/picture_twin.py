"""A picture in NumPy, double precision, ray by ray: what the renderer is held to.

It shares no line with the shaders: surfaces are met by ray casting, shade comes from `surface_temperature`.
"""

from dataclasses import dataclass

import numpy as np
from gloss_twin import glossy
from numpy.typing import NDArray

from sensorsim.materials.gloss import load_gloss
from sensorsim.radiometry import BandTable
from sensorsim.render import Camera, Illumination, World
from sensorsim.tables import surface_temperature
from sensorsim.thermal import quadrant_view_factors

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Sight:
    """What each pixel's ray meets: surface row or -1, range [m], and the ray's unit direction."""

    surface: NDArray[np.int64]  # (h, w)
    range: FloatArray  # (h, w) [m], 0 where nothing is met
    view: FloatArray  # (h, w, 3)
    margin: FloatArray  # (h, w) least barycentric coordinate of the hit, or of the nearest miss: small near edges


def pixel_rays(camera: Camera, size: tuple[int, int]) -> FloatArray:
    """Unit directions (h, w, 3) through the middles of the pixels, row 0 at the top, from the camera's angles alone."""
    width, height = size
    half = np.tan(np.radians(0.5 * camera.horizontal_field_of_view))
    x = (2.0 * (np.arange(width) + 0.5) / width - 1.0) * half
    y = (1.0 - 2.0 * (np.arange(height) + 0.5) / height) * half * height / width
    right, up = np.broadcast_arrays(x[None, :], y[:, None])
    roll, pitch, yaw = np.radians([camera.roll, camera.pitch, camera.yaw])
    rolled = np.stack([np.cos(roll) * right + np.sin(roll) * up, np.cos(roll) * up - np.sin(roll) * right], axis=-1)
    across, high = rolled[..., 0], rolled[..., 1]
    ahead, rise = np.cos(pitch) - np.sin(pitch) * high, np.sin(pitch) + np.cos(pitch) * high
    ray = np.stack([np.sin(yaw) * ahead + np.cos(yaw) * across, np.cos(yaw) * ahead - np.sin(yaw) * across, rise], -1)
    return np.asarray(ray / np.linalg.norm(ray, axis=-1, keepdims=True))


def look(world: World, camera: Camera, size: tuple[int, int]) -> Sight:
    """Nearest front face along every ray, with a margin that tells pixels whose ray grazes an edge."""
    mesh = world.scene.mesh
    a, b, c = (mesh.position[mesh.triangle[:, corner]] for corner in range(3))
    owner = mesh.surface[mesh.triangle[:, 0]].astype(np.int64)
    view = pixel_rays(camera, size)
    rays = view.reshape(-1, 3)
    edge, other, offset = b - a, c - a, camera.position - a
    through = np.cross(offset, edge)
    facing = rays @ np.cross(other, edge).T
    front = facing > 1e-12
    scale = 1.0 / np.where(front, facing, 1.0)
    u = (rays @ np.cross(other, offset).T) * scale
    v = (rays @ through.T) * scale
    distance = np.sum(other * through, axis=1) * scale
    inside = np.minimum(np.minimum(u, v), 1.0 - u - v)
    hit = front & (inside >= 0.0) & (distance > 0.0)
    reach = np.where(hit, distance, np.inf)
    nearest = np.argmin(reach, axis=1)
    rows = np.arange(rays.shape[0])
    met = np.isfinite(reach[rows, nearest])
    relevant = front & (distance > 0.0) & (distance <= reach[rows, nearest][:, None] * 1.001)
    margin = np.where(relevant, np.abs(inside), np.inf).min(axis=1)
    shape = view.shape[:2]
    return Sight(
        surface=np.where(met, owner[nearest], -1).reshape(shape),
        range=np.where(met, reach[rows, nearest], 0.0).reshape(shape),
        view=view,
        margin=margin.reshape(shape),
    )


def temperatures(world: World, surface: NDArray[np.int64], time_of_day: float) -> FloatArray:
    """Temperature [K] of surfaces by the tables' own NumPy function."""
    normal, made = world.scene.surfaces.normal[surface], world.assignment
    return surface_temperature(world.tables, normal, made.wall_type[surface], made.reflectance[surface], time_of_day)


def emitted(
    world: World, surface: NDArray[np.int64], time_of_day: float, light: Illumination, table: BandTable,
    view: FloatArray,
) -> FloatArray:  # fmt: skip
    """Radiance [W m-2 sr-1] that leaves surfaces in an emissive band: own emission and reflected surroundings.

    view (n, 3): unit directions from the sensor to the surfaces.
    """
    normal, made = world.scene.surfaces.normal[surface], world.assignment
    emissivity = made.emissivity[surface]
    sky_share = 0.5 * (1.0 + normal[:, 2])
    around = sky_share * light.sky_radiance + (1.0 - sky_share) * light.ground_radiance
    codes = np.array([wall.code for wall in made.wall_types])[made.wall_type[surface]]
    towards = np.sum(view * normal, axis=-1)
    mirrored = view[:, 2] - 2.0 * towards * normal[:, 2]
    for gloss, shown in zip(load_gloss(), light.mirror_tables(emissive=True)["mirror_table"], strict=True):
        held = np.isin(codes, gloss.codes)
        along = emissivity if gloss.normal_emissivity is None else np.full_like(emissivity, gloss.normal_emissivity)
        emissivity = np.where(held, gloss.emissivity(along, -towards), emissivity)
        around = np.where(held, np.interp(mirrored, np.linspace(-1.0, 1.0, shown.size), shown), around)
    own = table.radiance_at(temperatures(world, surface, time_of_day))
    return np.asarray(emissivity * own + (1.0 - emissivity) * around)


def reflected(world: World, surface: NDArray[np.int64], light: Illumination, view: FloatArray) -> FloatArray:
    """Radiance [W m-2 sr-1] that leaves surfaces in a reflective band: sun, four quarters of the sky, sunlit ground.

    view (n, 3): unit directions from the sensor to the surfaces.
    """
    normal, made = world.scene.surfaces.normal[surface], world.assignment
    reflectance = made.nir_reflectance[surface]
    sun = light.beam * np.maximum(normal @ light.sun_direction, 0.0)
    diffuse = 4.0 * quadrant_view_factors(normal) @ light.quadrant
    diffuse += np.pi * light.ground_radiance * 0.5 * (1.0 - normal[:, 2])
    leaves = reflectance * (sun + diffuse) / np.pi
    codes = np.array([wall.code for wall in made.wall_types])[made.wall_type[surface]]
    for gloss in load_gloss():
        held = np.isin(codes, gloss.codes)
        leaves[held] = glossy(gloss, reflectance[held], normal[held], view[held], diffuse[held], light)
    return np.asarray(leaves)


def through_air(
    source: FloatArray, distance: FloatArray, camera: Camera, view: FloatArray, light: Illumination
) -> FloatArray:
    """Radiance at the sensor [W m-2 sr-1] over distances [m] along unit directions of view (..., 3)."""
    height = float(camera.position[2])
    return light.air.seen_from(height).apparent_radiance(
        source, distance, height, height + distance * view[..., 2], view @ light.sun_direction
    )


def background(camera: Camera, view: FloatArray, light: Illumination) -> FloatArray:
    """Radiance [W m-2 sr-1] where no surface is: the sky by elevation, and the ground plane through the air."""
    sine = np.linspace(0.0, 1.0, light.sky.size)
    sky = np.interp(view[..., 2], sine, light.sky)
    if light.glow is not None:
        cosine = np.linspace(-1.0, 1.0, light.glow.indicatrix.size)
        around = np.interp(view @ light.sun_direction, cosine, light.glow.indicatrix)
        sky = sky + np.interp(view[..., 2], sine, light.glow.gradation) * around
    down = np.maximum(-view[..., 2], 1e-12)
    distance = max(camera.position[2], 0.0) / down
    ground = through_air(np.asarray(light.ground_radiance), distance, camera, view, light)
    return np.asarray(np.where(view[..., 2] >= 0.0, sky, ground))
