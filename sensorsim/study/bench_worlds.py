"""The same world with more of one thing: what a frame's time grows with."""

from dataclasses import fields, replace

import numpy as np

from sensorsim.render import World
from sensorsim.scene import Mesh, Surfaces
from sensorsim.tables.assign import Assignment


def with_triangles(world: World, times: int) -> World:
    """Every triangle `times` over, in the same place and of the same surface: the later ones lie behind the first."""
    mesh = world.scene.mesh
    more = replace(mesh, triangle=np.concatenate([mesh.triangle] * times))
    return replace(world, scene=replace(world.scene, mesh=more))


def with_surfaces(world: World, times: int) -> World:
    """The table of the surfaces `times` over; corners take turns among the copies."""
    scene, mesh, count = world.scene, world.scene.mesh, world.scene.surfaces.area.size
    surfaces = Surfaces(
        **{field.name: np.concatenate([getattr(scene.surfaces, field.name)] * times) for field in fields(Surfaces)}
    )
    copy = (mesh.surface + count * (mesh.surface % times)).astype(mesh.surface.dtype)
    drawn = Mesh(position=mesh.position, surface=copy, triangle=mesh.triangle)
    rows = {
        field.name: np.concatenate([getattr(world.assignment, field.name)] * times)
        for field in fields(Assignment)
        if isinstance(getattr(world.assignment, field.name), np.ndarray)
    }
    assigned = replace(world.assignment, **rows)
    return replace(world, scene=replace(scene, surfaces=surfaces, mesh=drawn), assignment=assigned)


def with_wall_types(world: World, times: int) -> World:
    """The coefficient matrix `times` over; surfaces take turns among the copies."""
    tables, assignment = world.tables, world.assignment
    walls = len(tables.wall_types)
    lobes = tables.lobes
    if lobes is not None:
        copies = {name: np.concatenate([getattr(lobes, name)] * times, axis=1) for name in ("weight", "gain")}
        lobes = replace(lobes, **copies)
    more = replace(
        tables, wall_types=tables.wall_types * times, lead_in=tables.lead_in * times, lobes=lobes,
        coefficients=np.concatenate([tables.coefficients] * times, axis=1),
        level=np.concatenate([tables.level] * times, axis=1), loss=np.concatenate([tables.loss] * times, axis=1),
    )  # fmt: skip
    turn = np.arange(assignment.wall_type.size) % times
    rows = (assignment.wall_type + walls * turn).astype(assignment.wall_type.dtype)
    assigned = replace(assignment, wall_types=assignment.wall_types * times, wall_type=rows)
    return replace(world, tables=more, assignment=assigned)
