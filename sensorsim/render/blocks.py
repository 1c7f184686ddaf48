"""The shaders' parameters, each block defined once: layout, GLSL text and meaning."""

import numpy as np
from numpy.typing import NDArray

from sensorsim.gpu import Field, UniformBlock
from sensorsim.render.camera import Camera, clip_distances

VIEW_FRAME = UniformBlock(
    name="ViewFrame",
    binding=0,
    fields=(
        Field("clip_from_camera", "mat4", "projection of positions relative to the camera, world axes"),
        Field("camera_position", "vec3", "east, north, up of the scene's origin [m]"),
        Field("view_corner", "vec3", "ray through the lower left corner of the picture"),
        Field("view_right", "vec3", "along the width of the picture"),
        Field("view_up", "vec3", "along the height of the picture"),
    ),
)

ILLUMINATION = UniformBlock(
    name="Illumination",
    binding=1,
    fields=(
        Field("quadrant", "vec4", "irradiance of the horizontal from the N, E, S and W quarter of the sky [W m-2]"),
        Field("sun_direction", "vec3", "towards the sun"),
        Field("beam", "float", "irradiance normal to the sun [W m-2]"),
        Field("sky_radiance", "float", "of the sky, mean over a horizontal surface's hemisphere [W m-2 sr-1]"),
        Field("ground_radiance", "float", "of the ground plane [W m-2 sr-1]"),
        Field("mirrors", "float", "1 where glossy surfaces mirror in reflective bands, 0 where they are matt"),
    ),
)

AIR = UniformBlock(
    name="Air",
    binding=4,
    fields=(
        Field("extinction", "vec4", "of each term at the camera's height [m-1]"),
        Field("weight", "vec4", "of each term, together 1; 0 for terms that are not used"),
        Field("inverse_scale_height", "vec4", "of each term's extinction [m-1]"),
        Field("source", "vec4", "of each term at the camera's height [W m-2 sr-1]"),
        Field("source_slope", "vec4", "of each term, with height [W m-2 sr-1 m-1]"),
        Field("beam_source", "vec4", "of each term, sunlight scattered at a right angle [W m-2 sr-1]"),
        Field("sun_direction", "vec3", "towards the sun"),
        Field("asymmetry", "float", "g of the phase function"),
    ),
)

DISPLAY = UniformBlock(
    name="Display",
    binding=2,
    fields=(
        Field("level", "float", "radiance of middle grey [W m-2 sr-1]"),
        Field("span", "float", "radiance from black to white [W m-2 sr-1]"),
        Field("black_hot", "float", "1 for black-hot polarity, 0 for white-hot"),
        Field("detail", "float", "gain of what differs from a smooth base"),
    ),
)

DETECTION = UniformBlock(
    name="Detection",
    binding=3,
    fields=(
        Field("constant", "float", "variance of one look without light [W2 m-4 sr-2]"),
        Field("shot", "float", "variance per radiance [W m-2 sr-1]"),
        Field("count_step", "float", "radiance from one count to the next [W m-2 sr-1]"),
        Field("highest", "float", "count at which the detector is full"),
        Field("corrected_at", "float", "radiance where gains that differ do not show [W m-2 sr-1]"),
        Field("full", "float", "radiance that fills the detector [W m-2 sr-1]"),
        Field("renewed", "float", "share of a picture that is new one frame later"),
        Field("kept", "float", "share of a channel's level that is left a block later"),
        Field("level", "float", "radiance that stands for a channel's level [W m-2 sr-1]"),
        Field("blooming", "float", "share of the charge above full that spills along the column"),
        Field("halo_share", "float", "of the light above full that comes back as a halo"),
        Field("halo_radius", "float", "of the halo [blocks]"),
        Field("frame", "uint", "number of the frame"),
        Field("seed", "uint", "of the noise that differs from element to element"),
    ),
)


def view_frame(
    camera: Camera, size: tuple[int, int], lowest: NDArray[np.float64], highest: NDArray[np.float64]
) -> bytes:
    """What `VIEW_FRAME` holds for a picture of a scene within the box `lowest` to `highest` (3,) [m]."""
    near, far = clip_distances(camera, size, lowest, highest)
    corner, right, up = camera.view_rays(size)
    return VIEW_FRAME.pack(
        clip_from_camera=camera.clip_from_camera(size, near, far), camera_position=camera.position, view_corner=corner,
        view_right=right, view_up=up,
    )  # fmt: skip
