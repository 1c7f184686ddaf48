"""Three simple vehicles made of boxes and cylinders; sizes are estimates of common ones [m]."""

from functools import cache

from sensorsim.trainer.articulation import GUN, TURRET
from sensorsim.trainer.rotations import FloatArray
from sensorsim.trainer.vehicle_shape import VehicleShape, box, cylinder, shape

Piece = tuple[str, FloatArray]


@cache
def built_in_vehicles() -> dict[str, VehicleShape]:
    """Truck, tank and car by name; the tank's turret and gun are articulated parts 1 and 2."""
    return {vehicle.name: vehicle for vehicle in (_truck(), _tank(), _car())}


def _wheels(places: tuple[float, ...], aside: float, radius: float) -> list[Piece]:
    return [
        ("wheels", cylinder((forward, side * aside, radius), radius, 0.3, 1)) for forward in places for side in (-1, 1)
    ]


def _truck() -> VehicleShape:
    pieces: list[Piece] = [
        ("skin", box((-1.2, 0.0, 2.1), (4.6, 2.4, 2.0))),
        ("skin", box((0.0, 0.0, 0.95), (7.0, 1.0, 0.3))),
        ("cabin", box((1.9, 0.0, 2.0), (1.4, 2.3, 1.6))),
        ("engine", box((3.0, 0.0, 1.5), (0.9, 1.8, 0.9))),
        ("exhaust", cylinder((1.1, 1.3, 1.9), 0.08, 1.8, 2)),
        *_wheels((2.6, -1.6, -2.8), 1.05, 0.5),
    ]
    return shape("truck", pieces)


def _tank() -> VehicleShape:
    pieces: list[Piece] = [
        ("skin", box((0.6, 0.0, 1.1), (5.2, 2.4, 0.9))),
        ("engine", box((-2.7, 0.0, 1.15), (1.4, 2.4, 1.0))),
        ("exhaust", box((-3.5, 0.0, 1.2), (0.2, 1.2, 0.4))),
        ("cabin", box((0.2, 0.0, 1.95), (2.6, 2.2, 0.8))),
        ("skin", cylinder((3.6, 0.0, 2.0), 0.09, 4.2, 0)),
        ("tracks", box((0.0, -1.5, 0.5), (6.6, 0.6, 1.0))),
        ("tracks", box((0.0, 1.5, 0.5), (6.6, 0.6, 1.0))),
    ]
    turret, gun = (0.2, 0.0, 1.55), (1.5, 0.0, 2.0)
    return shape("tank", pieces, joints=[(GUN, gun, [4]), (TURRET, turret, [3, 4])])


def _car() -> VehicleShape:
    pieces: list[Piece] = [
        ("skin", box((-0.6, 0.0, 0.65), (3.0, 1.7, 0.6))),
        ("engine", box((1.5, 0.0, 0.65), (1.2, 1.7, 0.55))),
        ("cabin", box((-0.5, 0.0, 1.2), (2.0, 1.5, 0.5))),
        ("exhaust", cylinder((-2.2, 0.5, 0.3), 0.05, 0.4, 0)),
        *_wheels((1.3, -1.3), 0.75, 0.31),
    ]
    return shape("car", pieces)
