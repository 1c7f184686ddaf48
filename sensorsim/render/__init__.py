"""One look of a sensor at a world: camera, surroundings in band, passes, planes."""

from sensorsim.render.camera import Camera, look_at, station_camera
from sensorsim.render.constant_colour import ConstantColour
from sensorsim.render.illumination import Illumination, illuminate
from sensorsim.render.renderer import Picture, Renderer
from sensorsim.render.world import World, build_world

__all__ = [
    "Camera",
    "ConstantColour",
    "Illumination",
    "Picture",
    "Renderer",
    "World",
    "build_world",
    "illuminate",
    "look_at",
    "station_camera",
]
