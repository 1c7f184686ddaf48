"""An entity carried on from its last packet by the algorithm that it names [IEEE1278].

The three letters say: orientation fixed or rotating; velocity, or velocity and acceleration; in world or body axes.
1 static, 2 FPW, 3 RPW, 4 RVW, 5 FVW, 6 FPB, 7 RPB, 8 RVB, 9 FVB; 0, any other, stands still as 1 does.
"""

import numpy as np

from sensorsim.trainer.dis_pdu import EntityState
from sensorsim.trainer.rotations import FloatArray, attitude, travelled, travelled_faster, turned

ROTATING = {3, 4, 7, 8}
WITH_ACCELERATION = {4, 5, 8, 9}
IN_BODY_AXES = {6, 7, 8, 9}
STATIC = {0, 1}


def reckoned(state: EntityState, elapsed: float) -> tuple[FloatArray, FloatArray]:
    """Earth-centred position (3,) [m] and attitude (3, 3) from body to Earth-centred axes, `elapsed` [s] later."""
    psi, theta, phi = np.degrees(state.orientation).tolist()
    start, position = attitude((psi, theta, phi)), np.array(state.location)
    if state.algorithm in STATIC or elapsed <= 0.0:
        return position, start
    spin = np.array(state.angular_velocity if state.algorithm in ROTATING else (0.0, 0.0, 0.0))
    velocity = np.array(state.velocity)
    acceleration = np.array(state.acceleration if state.algorithm in WITH_ACCELERATION else (0.0, 0.0, 0.0))
    after = start @ turned(spin, elapsed)
    if state.algorithm in IN_BODY_AXES:
        way = travelled(spin, elapsed) @ velocity + travelled_faster(spin, elapsed) @ acceleration
        return np.asarray(position + start @ way), after
    return np.asarray(position + velocity * elapsed + 0.5 * acceleration * elapsed**2), after
