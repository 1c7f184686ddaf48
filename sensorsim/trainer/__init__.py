"""The image generator that a trainer's host drives, without the renderer: CIGI 3.3 and 4.0 read and written, the host's
state, terrain queries, tracking and the UDP endpoint. Frames come out as `FrameRequest`; what draws them is a
`PictureSource`."""

from sensorsim.trainer.bake_request import BakeRequest
from sensorsim.trainer.dialect import CIGI_33, CIGI_40
from sensorsim.trainer.frame_request import EntityRequest, FrameRequest, PictureSource, ViewRequest
from sensorsim.trainer.host_state import SensorState, View
from sensorsim.trainer.image_generator import ImageGenerator
from sensorsim.trainer.local_place import LocalPlace, scene_place
from sensorsim.trainer.poses import Surroundings
from sensorsim.trainer.session import SessionReport, run_session
from sensorsim.trainer.settings import ImageSettings
from sensorsim.trainer.terrain import Terrain, build_terrain
from sensorsim.trainer.udp import Endpoint, UdpEndpoint

__all__ = [
    "CIGI_33",
    "CIGI_40",
    "BakeRequest",
    "Endpoint",
    "EntityRequest",
    "FrameRequest",
    "ImageGenerator",
    "ImageSettings",
    "LocalPlace",
    "PictureSource",
    "SensorState",
    "SessionReport",
    "Surroundings",
    "Terrain",
    "UdpEndpoint",
    "View",
    "ViewRequest",
    "build_terrain",
    "run_session",
    "scene_place",
]
