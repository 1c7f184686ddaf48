"""The faces of a block of columns that melt: each column exchanges heat with its cells in a way of its own."""

from sensorsim.constants import ZERO_CELSIUS
from sensorsim.thermal.balance import ITERATION_LIMIT, TOLERANCE, Room, evaporate, newton, step_film
from sensorsim.thermal.boundary import FloatArray
from sensorsim.thermal.lanes import (
    CELL,
    EXTERIOR,
    FILM_CUBED,
    FLUX,
    FREE,
    FREE_COLDER,
    INTERIOR,
    INTERIOR_FLUX,
    INTERIOR_PER_FILM,
    LATENT,
    LATENT_SLOPE,
    LATER_FLUX,
    LATER_INTERIOR_FLUX,
    LEFT,
    LOAD,
    MOVED,
    NOW,
    PER_FILM,
    RIGHT,
    UNBOUNDED,
    Index,
    inner,
    wide,
)
from sensorsim.thermal.melting_cells import (
    BY_FACE,
    BY_ROOM,
    CUBED,
    FROM_ROOM,
    GAIN,
    HELD,
    ROOT,
    SETTLED,
    TO_ROOM,
    TURNED,
    Block,
    Thaw,
)

NEAR = 1e-4  # [-] last step of a cube root, of which a step of fourth order leaves only rounding
AT_REST = -2.0  # [K] move of a face that has settled, below any that has not


@inner
def gain_at_zero(lanes: Index, w: FloatArray, grey: float, air: float, vapour: float, wet: bool) -> None:
    """Heat [W m-2] that the exterior face takes from its surroundings at 0 C."""
    wide()
    warmer = air < 0.0
    for j in range(lanes):
        lift = (w[FREE + j] if warmer else w[FREE_COLDER + j]) * abs(air)
        w[CUBED + j], w[ROOT + j], w[TURNED + j] = w[FILM_CUBED + j] + lift, w[PER_FILM + j], UNBOUNDED
        w[GAIN + j], w[EXTERIOR + j], w[LATENT + j] = w[EXTERIOR + j], 0.0, 0.0
    if wet:
        evaporate(lanes, w, vapour)
    moving, rounds = 1, 0
    while moving > 0 and rounds < ITERATION_LIMIT:
        moving, rounds = _approach_film(lanes, w), rounds + 1
    lost = grey * ZERO_CELSIUS**4
    for j in range(lanes):
        film = w[CUBED + j] * (w[ROOT + j] * w[ROOT + j])
        w[EXTERIOR + j], w[GAIN + j] = w[GAIN + j], w[LOAD + j] + film * air - lost - w[LATENT + j]


@inner
def _approach_film(lanes: Index, w: FloatArray) -> int:
    """One step of the inverse cube roots that have not come near; returns how many go on."""
    wide()
    moving = 0
    for j in range(lanes):
        still = w[TURNED + j] <= NEAR
        root, turned = step_film(w[ROOT + j], w[CUBED + j])
        w[ROOT + j], w[TURNED + j] = w[ROOT + j] if still else root, w[TURNED + j] if still else turned
        moving += 1 if not still and turned > NEAR else 0
    return moving


@inner
def balance_melting(lanes: Index, w: FloatArray, grey: float, air: float, vapour: float, room: Room, wet: bool) -> int:
    """Bring both faces of the columns that have not settled into balance; returns how many did not get there."""
    for j in range(lanes):
        rests = w[SETTLED + j] > 0.0 and w[MOVED + j] <= TOLERANCE
        w[MOVED + j] = AT_REST if rests else UNBOUNDED
    moving, rounds, sure = 1, 0, 2 if wet else 1
    while (moving > 0 or rounds < sure) and rounds < ITERATION_LIMIT:
        if wet:
            evaporate(lanes, w, vapour)
        moving = _approach(lanes, w, grey, air, room, TOLERANCE if rounds >= sure else AT_REST)
        rounds += 1
    return moving


@inner
def _approach(lanes: Index, w: FloatArray, grey: float, air: float, room: Room, still_below: float) -> int:
    """One Newton step of both faces of the columns that still move; returns how many go on."""
    wide()
    moving = 0
    for j in range(lanes):
        before = w[MOVED + j]
        still = before <= still_below
        face, room_face = (w[EXTERIOR + j], w[PER_FILM + j]), (w[INTERIOR + j], w[INTERIOR_PER_FILM + j])
        loads = (w[LOAD + j], w[FILM_CUBED + j], w[FREE + j], w[FREE_COLDER + j], w[LEFT + j], w[RIGHT + j])
        exchange = (w[BY_FACE + j], w[FROM_ROOM + j], w[TO_ROOM + j], w[BY_ROOM + j], 0.0)
        latent = (w[LATENT + j], w[LATENT_SLOPE + j])
        ext, inn, root, room_root, moved = newton(face, room_face, loads, latent, exchange, grey, air, room)
        w[EXTERIOR + j], w[INTERIOR + j] = face[0] if still else ext, room_face[0] if still else inn
        w[PER_FILM + j], w[INTERIOR_PER_FILM + j] = face[1] if still else root, room_face[1] if still else room_root
        w[MOVED + j] = before if still else moved
        moving += 0 if still or moved <= TOLERANCE else 1
    return moving


@inner
def enter(lanes: Index, w: FloatArray, wall: Thaw, block: Block) -> None:
    """Heat [W m-2] that enters through both faces."""
    wide()
    c, outermost, innermost = block.c, wall.conductance[0], wall.conductance[wall.capacity.size]
    last = block.place[wall.capacity.size]
    for j in range(lanes):
        through = outermost * (w[EXTERIOR + j] - c[CELL + NOW + j])
        w[FLUX + j] = w[GAIN + j] if w[HELD + j] > 0.0 else through
        w[INTERIOR_FLUX + j] = innermost * (w[INTERIOR + j] - c[last + NOW + j])
        w[LATER_FLUX + j], w[LATER_INTERIOR_FLUX + j] = w[FLUX + j], w[INTERIOR_FLUX + j]
