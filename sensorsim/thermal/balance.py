"""The balances of both faces of a block of columns: what radiation, air and vapour bring is what conduction takes away.

They are not linear: a Newton iteration in two unknowns, with the cube roots of the films stepped along.
Saturation pressure over water is the polynomial of [Lowe1977], which vectorises where an exponential does not.
"""

from sensorsim.constants import ZERO_CELSIUS
from sensorsim.thermal.boundary import FloatArray
from sensorsim.thermal.lanes import (
    EXCHANGE,
    EXTERIOR,
    EXTERIOR_FILM,
    FILM_CUBED,
    FREE,
    FREE_COLDER,
    INTERIOR,
    INTERIOR_FILM,
    LATENT,
    LATENT_SLOPE,
    LATER,
    LEFT,
    LOAD,
    MOVED,
    RIGHT,
    Index,
    inner,
)

Room = tuple[float, float, float, float, float]  # air, radiation, forced film cubed, free film cubed, grey
ITERATION_LIMIT = 100
TOLERANCE = 1e-4  # [K] and [W m-2 K-1] last move of temperatures and films together; Newton squares it
LEAST_FILM = 1e-3  # [W m-2 K-1] keeps the cube root from dividing by zero in perfectly still air
COLDEST_WATER = -100.0  # [C] below which the saturation polynomial is held


@inner
def balance(
    lanes: Index, w: FloatArray, exchange: FloatArray, grey: float, air: float, vapour: float, room: Room, wet: bool,
    at: float,
) -> int:  # fmt: skip
    """Bring both faces of the lanes that are marked as moving into balance; returns how many did not get there."""
    moving = 0
    for _ in range(ITERATION_LIMIT):
        if wet:
            evaporate(lanes, w, vapour, at)
        moving = _approach(lanes, w, exchange, grey, air, room)
        if moving == 0:
            break
    return moving


@inner
def _approach(lanes: Index, w: FloatArray, exchange: FloatArray, grey: float, air: float, room: Room) -> int:
    """One Newton step of both faces of the lanes that still move, whether or not others do; returns how many go on."""
    a, b, c, d = exchange[0], exchange[1], exchange[2], exchange[3]
    room_air, radiation, cubed, free, room_grey = room
    third, moving = 1.0 / 3.0, 0
    for j in range(lanes):
        ext, inn, old, room_old = w[EXTERIOR + j], w[INTERIOR + j], w[EXTERIOR_FILM + j], w[INTERIOR_FILM + j]
        gap, room_gap, square, room_square = air - ext, room_air - inn, old * old, room_old * room_old
        both = 1.0 / (square * room_square)  # one division for two
        warmer, colder = w[FREE + j], w[FREE_COLDER + j]
        own = warmer if gap < 0.0 else colder
        lift, room_lift = own * abs(gap) * both * room_square, free * abs(room_gap) * both * square
        h = max((2.0 * old + w[FILM_CUBED + j] * both * room_square + lift) * third, LEAST_FILM)
        room_h = max((2.0 * room_old + cubed * both * square + room_lift) * third, LEAST_FILM)
        film = h if w[FILM_CUBED + j] + own > 0.0 else 0.0
        room_film = room_h if cubed + free > 0.0 else 0.0
        kelvin, room_kelvin = ext + ZERO_CELSIUS, inn + ZERO_CELSIUS
        cube, room_cube = grey * kelvin * kelvin * kelvin, room_grey * room_kelvin * room_kelvin * room_kelvin
        lack = w[LOAD + j] + film * gap - cube * kelvin - w[LATENT + j] - a * ext + b * inn + w[LEFT + j]
        room_lack = radiation + room_film * room_gap - room_cube * room_kelvin + c * ext - d * inn + w[RIGHT + j]
        slope = a + film + lift * third + 4.0 * cube + w[LATENT_SLOPE + j]
        room_slope = d + room_film + room_lift * third + 4.0 * room_cube
        scale = 1.0 / (slope * room_slope - b * c)
        move, room_move = (lack * room_slope + b * room_lack) * scale, (room_lack * slope + c * lack) * scale
        moved, still = abs(move) + abs(room_move) + abs(h - old) + abs(room_h - room_old), w[MOVED + j] <= TOLERANCE
        w[EXTERIOR_FILM + j], w[INTERIOR_FILM + j] = old if still else h, room_old if still else room_h
        w[EXTERIOR + j] = ext if still else max(ext + move, -ZERO_CELSIUS)
        w[INTERIOR + j] = inn if still else max(inn + room_move, -ZERO_CELSIUS)
        w[MOVED + j] = 0.0 if still else moved
        moving += 0 if still or moved <= TOLERANCE else 1
    return moving


@inner
def evaporate(lanes: Index, w: FloatArray, vapour: float, at: float) -> None:
    """Latent heat that leaves a wet face and its slope per kelvin of it."""
    for j in range(lanes):
        t = max(w[EXTERIOR + j], COLDEST_WATER)
        high = 3.031240396e-4 + t * (2.034080948e-6 + t * 6.136820929e-9)
        pressure = 610.7799961 + t * (44.36518521 + t * (1.428945805 + t * (2.650648471e-2 + t * high)))
        high = 4.0 * 3.031240396e-4 + t * (5.0 * 2.034080948e-6 + t * 6.0 * 6.136820929e-9)
        rise = 44.36518521 + t * (2.0 * 1.428945805 + t * (3.0 * 2.650648471e-2 + t * high))
        exchange = (1.0 - at) * w[EXCHANGE + j] + at * w[LATER + EXCHANGE + j]
        w[LATENT + j], w[LATENT_SLOPE + j] = exchange * (pressure - vapour), exchange * max(rise, 0.0)
