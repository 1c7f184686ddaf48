"""How far the tables of a world miss the full solve, surface by surface, at the moment of a frame."""

import numpy as np

from sensorsim.materials import load_catalogue
from sensorsim.render import World
from sensorsim.render.world import ground_plane
from sensorsim.tables import surface_temperature
from sensorsim.tables.full_solve import FINE_STEP, distinct_surfaces, fine_environment, fine_settings, solve_surfaces
from sensorsim.tables.orientations import FloatArray, IntArray


def surface_fit_error(world: World, time_of_day: float) -> FloatArray:
    """Error (s,) [K], without its sign, of every surface's fit at a time of the image day [s].

    Against the full solve of each of the scene's distinct surfaces under the sky that the tables were baked for:
    seconds of work, so it is done for frames that ask for it.
    """
    settings, distinct = world.tables.settings, distinct_surfaces(world.scene.surfaces.normal, world.assignment)
    surfaces, environment = distinct.surfaces, fine_environment(world.weather, world.tables.day)
    position = environment.image_window.start + time_of_day / FINE_STEP
    before = min(int(position), environment.time.size - 2)
    solved = solve_surfaces(
        environment, surfaces, ground=ground_plane(load_catalogue(), world.season),
        record=np.array([before, before + 1]), settings=fine_settings(settings),
    )  # fmt: skip
    exact = solved[0] + (position - before) * (solved[1] - solved[0])
    fit = surface_temperature(
        world.tables, surfaces.normal, surfaces.wall_type, surfaces.reflectance, time_of_day
    )  # fmt: skip
    return np.asarray(np.abs(fit - exact)[distinct.row_of])


def fit_error_plane(error: FloatArray, surface_id: IntArray) -> FloatArray:
    """Errors (s,) [K] as an image by the surfaces (height, width) that its pixels see; -1 where they see none."""
    return np.where(surface_id < 0, -1.0, error[np.maximum(surface_id, 0)])
