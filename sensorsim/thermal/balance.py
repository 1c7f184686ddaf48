"""The balances of both faces of a block of columns: what radiation, air and vapour bring is what conduction takes away.

They are not linear: a Newton iteration in two unknowns, with the cube roots of the films stepped along, as their
inverses, which takes no division. All lanes take two steps; those that then have not settled go on.
Saturation pressure over water is the polynomial of [Lowe1977], which vectorises where an exponential does not.
"""

from sensorsim.constants import ZERO_CELSIUS
from sensorsim.thermal.boundary import FloatArray
from sensorsim.thermal.lanes import (
    ABSORBED,
    EXCHANGE,
    EXTERIOR,
    FILM_CUBED,
    FORCED,
    FREE,
    FREE_COLDER,
    INTERIOR,
    INTERIOR_PER_FILM,
    INTERIOR_RISE,
    INTERIOR_RISE_BEFORE,
    INTERIOR_START,
    LATENT,
    LATENT_SLOPE,
    LATER,
    LEFT,
    LOAD,
    MOVED,
    PER_FILM,
    RIGHT,
    RISE,
    RISE_BEFORE,
    START,
    UNBOUNDED,
    VAPOUR_EXCHANGE,
    Index,
    inner,
    scalar,
    wide,
)

# absorbed, forced film cubed, free films cubed of a warmer and a colder face per kelvin, from the cells to both faces
Loads = tuple[float, float, float, float, float, float]
Room = tuple[float, float, float, float, float]  # air, radiation, forced film cubed, free film cubed, grey
Guess = tuple[float, float, float]  # where to look for the faces: of the rise of stage, last step, and one before
Exchange = tuple[float, float, float, float, float]  # a row of `Cells.exchange`
ITERATION_LIMIT = 100
TOLERANCE = 2e-3  # [K] last move of the temperatures, and of the films by what they do to them; Newton squares it
LEAST_GAP = 0.1  # [K] to the air, for what a film does: one that is far too large leaves none
MOST_PER_FILM = 1e3  # [W-1 m2 K] of perfectly still air
COLDEST_WATER = -100.0  # [C] below which the saturation polynomial is held
A, B, C = 1.0 / 3.0, 2.0 / 9.0, 14.0 / 81.0  # of (1 - x)^(-1/3)


@scalar
def step_film(root: float, cubed: float) -> tuple[float, float]:
    """Inverse cube root by one step of fourth order from a near one, and how far it went; from afar it comes nearer."""
    lack = max(1.0 - cubed * (root * root * root), -1.0)
    after = min(root + root * lack * ((A + lack * B) + lack * lack * C), MOST_PER_FILM)
    return after, A * abs(lack) if after < MOST_PER_FILM else 0.0


@scalar
def newton(
    face: tuple[float, float], room_face: tuple[float, float], loads: Loads, latent: tuple[float, float],
    exchange: Exchange, grey: float, air: float, room: Room,
) -> tuple[float, float, float, float, float]:  # fmt: skip
    """One step for both faces, which are temperature [C] and inverse film; returns both, and how far they went [K].

    What needs a film comes last in every sum, as films are known late: processors wait here more than they compute.
    """
    a, b, c, d, _ = exchange
    room_air, radiation, room_cubed, free, room_grey = room
    absorbed, cubed, warmer, colder, left, right = loads
    (ext, old), (inn, room_old) = face, room_face
    gap, room_gap = air - ext, room_air - inn
    lift, room_lift = max(colder * gap, -warmer * gap), free * abs(room_gap)
    cubed, room_cubed = cubed + lift, room_cubed + room_lift
    (root, turned), (room_root, room_turned) = step_film(old, cubed), step_film(room_old, room_cubed)
    square, room_square = root * root, room_root * room_root
    kelvin, room_kelvin = ext + ZERO_CELSIUS, inn + ZERO_CELSIUS
    cube, room_cube = grey * kelvin * (kelvin * kelvin), room_grey * room_kelvin * (room_kelvin * room_kelvin)
    lack = absorbed + left - latent[0] + b * inn - a * ext - cube * kelvin + cubed * gap * square
    room_lack = radiation + right + c * ext - d * inn - room_cube * room_kelvin + room_cubed * room_gap * room_square
    slope = a + latent[1] + 4.0 * cube + (cubed + A * lift) * square
    room_slope = d + 4.0 * room_cube + (room_cubed + A * room_lift) * room_square
    scale = 1.0 / (slope * room_slope - b * c)
    move, room_move = (lack * room_slope + b * room_lack) * scale, (room_lack * slope + c * lack) * scale
    moved = abs(move) + abs(room_move) + turned * (abs(gap) + LEAST_GAP) + room_turned * (abs(room_gap) + LEAST_GAP)
    return max(ext + move, -ZERO_CELSIUS), max(inn + room_move, -ZERO_CELSIUS), root, room_root, moved


@scalar
def ahead(start: float, stage: float, rise: float, before: float, guess: Guess) -> float:
    """Where a face is looked for."""
    return start + guess[0] * (stage - start) + guess[1] * rise + guess[2] * before


@scalar
def evaporation(temperature: float, exchange: float, vapour: float) -> tuple[float, float]:
    """Latent heat [W m-2] that leaves a wet face and its slope per kelvin of it."""
    t = max(temperature, COLDEST_WATER)
    high = 3.031240396e-4 + t * (2.034080948e-6 + t * 6.136820929e-9)
    pressure = 610.7799961 + t * (44.36518521 + t * (1.428945805 + t * (2.650648471e-2 + t * high)))
    high = 4.0 * 3.031240396e-4 + t * (5.0 * 2.034080948e-6 + t * 6.0 * 6.136820929e-9)
    rise = 44.36518521 + t * (2.0 * 1.428945805 + t * (3.0 * 2.650648471e-2 + t * high))
    return exchange * (pressure - vapour), exchange * max(rise, 0.0)


@scalar
def acting(w: FloatArray, j: int, at: float, guess: Guess) -> tuple[float, float, float, float, float]:
    """Absorbed load, forced film cubed and vapour exchange of a lane at a fraction `at`, where faces are looked for."""
    rest = 1.0 - at
    forced = rest * w[FORCED + j] + at * w[LATER + FORCED + j]
    absorbed, cubed = rest * w[ABSORBED + j] + at * w[LATER + ABSORBED + j], forced * forced * forced
    steam = rest * w[EXCHANGE + j] + at * w[LATER + EXCHANGE + j]
    ext = ahead(w[START + j], w[EXTERIOR + j], w[RISE + j], w[RISE_BEFORE + j], guess)
    inn = ahead(w[INTERIOR_START + j], w[INTERIOR + j], w[INTERIOR_RISE + j], w[INTERIOR_RISE_BEFORE + j], guess)
    return absorbed, cubed, steam, ext, inn


@inner
def load(lanes: Index, w: FloatArray, at: float, guess: Guess) -> None:
    """What acts on the exterior faces at a fraction `at` of the step, where both faces are looked for."""
    wide()
    for j in range(lanes):
        absorbed, cubed, steam, ext, inn = acting(w, j, at, guess)
        w[LOAD + j], w[FILM_CUBED + j], w[VAPOUR_EXCHANGE + j], w[MOVED + j] = absorbed, cubed, steam, UNBOUNDED
        w[EXTERIOR + j], w[INTERIOR + j] = ext, inn


@scalar
def leap_lane(
    w: FloatArray, j: int, exchange: Exchange, grey: float, air: float, vapour: float, room: Room, wet: bool, at: float,
    guess: Guess,
) -> int:  # fmt: skip
    """As `load`, and two Newton steps of both faces of one lane; returns whether it has to go on."""
    absorbed, cubed, steam, ext, inn = acting(w, j, at, guess)
    loads = (absorbed, cubed, w[FREE + j], w[FREE_COLDER + j], w[LEFT + j], w[RIGHT + j])
    latent = evaporation(ext, steam, vapour) if wet else (0.0, 0.0)
    face, room_face = (ext, w[PER_FILM + j]), (inn, w[INTERIOR_PER_FILM + j])
    ext, inn, root, room_root, moved = newton(face, room_face, loads, latent, exchange, grey, air, room)
    latent = evaporation(ext, steam, vapour) if wet else (0.0, 0.0)
    face, room_face = (ext, root), (inn, room_root)
    ext, inn, root, room_root, moved = newton(face, room_face, loads, latent, exchange, grey, air, room)
    w[EXTERIOR + j], w[INTERIOR + j], w[PER_FILM + j], w[INTERIOR_PER_FILM + j] = ext, inn, root, room_root
    w[LOAD + j], w[FILM_CUBED + j], w[VAPOUR_EXCHANGE + j], w[MOVED + j] = absorbed, cubed, steam, moved
    return 0 if moved <= TOLERANCE else 1


@inner
def leap(
    lanes: Index, w: FloatArray, exchange: Exchange, grey: float, air: float, room: Room, at: float, guess: Guess
) -> int:
    """Two Newton steps of all lanes where nothing evaporates; returns how many have to go on."""
    wide()
    moving = 0
    for j in range(lanes):
        moving += leap_lane(w, j, exchange, grey, air, 0.0, room, False, at, guess)
    return moving


@inner
def leap_wet(
    lanes: Index, w: FloatArray, exchange: Exchange, grey: float, air: float, vapour: float, room: Room, at: float,
    guess: Guess,
) -> int:  # fmt: skip
    """Two Newton steps of all lanes where water evaporates; returns how many have to go on."""
    wide()
    moving = 0
    for j in range(lanes):
        moving += leap_lane(w, j, exchange, grey, air, vapour, room, True, at, guess)
    return moving


@scalar
def balance(
    lanes: Index, w: FloatArray, exchange: Exchange, grey: float, air: float, vapour: float, room: Room, wet: bool,
    at: float, guess: Guess,
) -> int:  # fmt: skip
    """Bring both faces of all lanes into balance at a fraction `at` of a step; returns how many did not get there."""
    if wet:
        moving = leap_wet(lanes, w, exchange, grey, air, vapour, room, at, guess)
    else:
        moving = leap(lanes, w, exchange, grey, air, room, at, guess)
    rounds = 2
    while moving > 0 and rounds < ITERATION_LIMIT:
        moving = approach(lanes, w, exchange, grey, air, vapour, room, wet)
        rounds += 1
    return moving


@inner
def approach(
    lanes: Index, w: FloatArray, exchange: Exchange, grey: float, air: float, vapour: float, room: Room, wet: bool
) -> int:
    """One Newton step of both faces of the lanes that still move, whether or not others do; returns how many go on."""
    wide()
    moving = 0
    for j in range(lanes):
        still = w[MOVED + j] <= TOLERANCE
        face, room_face = (w[EXTERIOR + j], w[PER_FILM + j]), (w[INTERIOR + j], w[INTERIOR_PER_FILM + j])
        loads = (w[LOAD + j], w[FILM_CUBED + j], w[FREE + j], w[FREE_COLDER + j], w[LEFT + j], w[RIGHT + j])
        latent = evaporation(face[0], w[VAPOUR_EXCHANGE + j], vapour) if wet else (0.0, 0.0)
        ext, inn, root, room_root, moved = newton(face, room_face, loads, latent, exchange, grey, air, room)
        w[EXTERIOR + j], w[INTERIOR + j] = face[0] if still else ext, room_face[0] if still else inn
        w[PER_FILM + j], w[INTERIOR_PER_FILM + j] = face[1] if still else root, room_face[1] if still else room_root
        w[MOVED + j] = 0.0 if still else moved
        moving += 0 if still or moved <= TOLERANCE else 1
    return moving


@inner
def evaporate(lanes: Index, w: FloatArray, vapour: float) -> None:
    """Latent heat that leaves wet faces and its slope."""
    wide()
    for j in range(lanes):
        w[LATENT + j], w[LATENT_SLOPE + j] = evaporation(w[EXTERIOR + j], w[VAPOUR_EXCHANGE + j], vapour)
