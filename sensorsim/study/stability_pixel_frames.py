"""Frames of cards: squares that face the camera, so that every pixel's true surface, range and radiance is known."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from sensorsim.environment import single_term
from sensorsim.radiometry import build_band_table
from sensorsim.render import Camera, Illumination, Picture, Renderer, World
from sensorsim.render.illumination import SKY_ENTRIES
from sensorsim.scene.mesh import Mesh
from sensorsim.sensor import load_sensor
from sensorsim.study.stability_model import Case
from sensorsim.study.stability_world import NOON, small_world
from sensorsim.tables import surface_temperature

SIZE = (96, 96)  # [pixel]
FIELD = 1.0  # [deg]


def card(squares: Sequence[tuple[float, float, float, float, int]]) -> Mesh:
    """Squares (east and up of the middle, side, north [m], surface) that face south, drawn in this order."""
    corner = np.array([[-0.5, 0.0, -0.5], [0.5, 0.0, -0.5], [0.5, 0.0, 0.5], [-0.5, 0.0, 0.5]])
    place = [np.array([east, north, up]) + side * corner for east, up, side, north, _ in squares]
    two = np.array([[0, 1, 2], [0, 2, 3]])
    return Mesh(
        position=np.concatenate(place),
        surface=np.repeat(np.array([square[4] for square in squares], dtype=np.int32), 4),
        triangle=np.concatenate([two + 4 * row for row in range(len(squares))]).astype(np.int32),
    )


def look(world: World, mesh: Mesh, *, illumination: Illumination | None = None, field: float = FIELD) -> Picture:
    """What the thermal sensor sees of a card from the origin, looking north."""
    shown = replace(world, scene=replace(world.scene, mesh=mesh))
    camera = Camera(position=np.zeros(3), yaw=0.0, pitch=0.0, horizontal_field_of_view=field)
    with Renderer(shown, load_sensor("flir"), size=SIZE) as renderer:
        return renderer.render(camera, NOON, illumination=illumination)


def _every_texel() -> float:
    """Temperatures of a card with every orientation and wall type, the last ones included, less those of NumPy."""
    world = small_world()
    count, orientations = world.assignment.wall_type.size, world.tables.orientations.normal
    rows = np.arange(count)
    normal = orientations[::-1][rows % len(orientations)]
    wall = (len(world.tables.wall_types) - 1 - rows) % len(world.tables.wall_types)
    world = replace(
        world,
        scene=replace(world.scene, surfaces=replace(world.scene.surfaces, normal=normal)),
        assignment=replace(world.assignment, wall_type=wall),
    )
    side = int(np.ceil(np.sqrt(count)))
    squares = [(row % side - 0.5 * (side - 1), row // side - 0.5 * (side - 1), 1.0, 100.0, int(row)) for row in rows]
    planes = look(world, card(squares), field=2.0 * float(np.degrees(np.arctan(0.5 * side / 100.0)))).planes
    seen, shown = planes["surface_id"].ravel(), planes["surface_temperature"].ravel().astype(np.float64)
    if set(seen.tolist()) - {-1} != set(rows.tolist()):
        return np.inf
    exact = surface_temperature(world.tables, normal, wall, world.assignment.reflectance, NOON)
    return float(np.abs(shown - exact[seen])[seen >= 0].max())


def _hidden(distance: float, apart: float, nearest: float | None) -> float:
    """Share of pixels that show a wall `apart` [m] behind another one, whichever is drawn first."""
    front, back = (0.0, 0.0, 0.1 * distance, distance, 0), (0.0, 0.0, 0.1 * distance, distance + apart, 1)
    near = [] if nearest is None else [(0.0, -0.5 * nearest, 0.01 * nearest, nearest, 2)]
    shares = [
        float(np.mean(look(small_world(), card([*order, *near])).planes["surface_id"] != 0))
        for order in ((front, back), (back, front))
    ]
    return max(shares)


def _range_miss(distance: float) -> float:
    """Range less the true one, over it, at every pixel."""
    planes = look(small_world(), card([(0.0, 0.0, 0.1 * distance, distance, 0)])).planes
    across = (2.0 * (np.arange(SIZE[0]) + 0.5) / SIZE[0] - 1.0) * np.tan(np.radians(0.5 * FIELD))
    exact = distance * np.sqrt(1.0 + across[None, :] ** 2 + across[:, None] ** 2)
    return float(np.abs(planes["range"] / exact - 1.0).max())


def _enclosure(distance: float) -> float:
    """How far the apparent temperature of an isothermal enclosure is from its temperature, through haze."""
    kelvin, world = 288.15, small_world()
    tables = replace(
        world.tables,
        coefficients=np.zeros_like(world.tables.coefficients),
        level=np.full_like(world.tables.level, kelvin),
        lobes=None,
        ground_temperature=np.full_like(world.tables.ground_temperature, kelvin),
    )
    radiance = float(build_band_table(load_sensor("flir").band).radiance_at(kelvin))
    light = Illumination(
        sun_direction=np.array([0.0, -0.6, 0.8]), beam=0.0, quadrant=np.zeros(4), sky=np.full(SKY_ENTRIES, radiance),
        ground_radiance=radiance, air=single_term(2e-4, radiance),
    )  # fmt: skip
    mesh = card([(0.0, 0.0, 0.01 * distance, distance, 0)])
    planes = look(replace(world, tables=tables), mesh, illumination=light).planes
    return float(np.abs(planes["apparent_temperature"].astype(np.float64) - kelvin).max())


def _case(
    name: str, stresses: str, measured: str, bound: float, reason: str, measure: Callable[[], float], unit: str
) -> Case:
    return Case(
        name=name, group="frames", stresses=stresses, measured=measured, unit=unit, bound=bound, reason=reason,
        measure=measure,
    )  # fmt: skip


_DEPTH = "share of pixels that show the wall behind, whichever is drawn first"

CASES = (
    _case(
        "every orientation and wall type on one card",
        "the first and the last texel of every row and column of the tables",
        "temperature of pixels less that of the tables in NumPy",
        5e-3,
        "what separates shader and NumPy at most",
        _every_texel,
        "K",
    ),
    *(
        _case(
            f"walls {apart:g} m apart at {distance:g} m, {words}",
            "a depth buffer of 24 bits, whose resolution falls with the square of the range",
            _DEPTH,
            0.0,
            f"{distance:g} m squared over the near plane and 2^24 is {resolution:.1g} m",
            partial(_hidden, distance, apart, near),
            "-",
        )
        for distance, apart, near, words, resolution in (
            (1e4, 0.01, None, "nothing near", 1.2e-3),
            (5e4, 0.1, None, "nothing near", 6e-3),
            (1e4, 1.0, 100.0, "something at 100 m", 0.12),
            (1e3, 1.0, 1.0, "something at 1 m", 0.12),
        )
    ),
    *(
        _case(
            f"range of {distance:g} m",
            "single precision far from the camera",
            "range less the true one, over it",
            1e-6,
            "a few roundings of float32, 6e-8 each",
            partial(_range_miss, distance),
            "-",
        )
        for distance in (100.0, 1e4, 1e5)
    ),
    *(
        _case(
            f"isothermal enclosure at {distance:g} m",
            "a transmittance that goes to 0 and a radiance that must not change",
            "apparent temperature less that of the enclosure",
            1e-3,
            "Kirchhoff's law",
            partial(_enclosure, distance),
            "K",
        )
        for distance in (100.0, 1e4, 1e6)
    ),
)
