"""A view of the host as a camera: its middle axis, its width, and the mirror in front of it.

Pictures have square pixels and stand evenly around their axis, so a view's height follows from the size of the picture,
and one whose half-angles differ is drawn around the direction in the middle of them.
"""

import numpy as np
from numpy.typing import NDArray

from sensorsim.render import Camera
from sensorsim.trainer.frame_request import ViewRequest
from sensorsim.trainer.rotations import angles_of, attitude

FLIPS = ((), (1,), (0,), (0, 1))  # axes of a picture that mirror modes none, horizontal, vertical and both turn round


def view_camera(view: ViewRequest) -> Camera:
    """The camera of a view; InputError for a field that no plane picture has."""
    aside, above = 0.5 * (view.left + view.right), 0.5 * (view.bottom + view.top)
    yaw, pitch, roll = angles_of(np.asarray(attitude(view.angles) @ attitude((aside, above, 0.0))))
    return Camera(
        position=np.array(view.position),
        yaw=yaw,
        pitch=pitch,
        roll=roll,
        horizontal_field_of_view=view.right - view.left,
    )


def mirrored(picture: NDArray[np.uint8], mirror: int) -> NDArray[np.uint8]:
    """A picture (h, w) as the view's mirror mode has it: 0 none, 1 left for right, 2 top for bottom, 3 both."""
    return np.ascontiguousarray(np.flip(picture, FLIPS[mirror])) if mirror else picture
