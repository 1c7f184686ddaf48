"""One look of a sensor at a world: camera, surroundings in band, passes, planes."""

from sensorsim.render.camera import Camera, look_at, station_camera
from sensorsim.render.constant_colour import ConstantColour
from sensorsim.render.frame_effects import survey_ledger
from sensorsim.render.illumination import Illumination, illuminate
from sensorsim.render.picture import Picture
from sensorsim.render.renderer import Renderer
from sensorsim.render.survey import EVERY_EFFECT, Survey, survey_scene
from sensorsim.render.world import World, build_world, world_of

__all__ = [
    "EVERY_EFFECT",
    "Camera",
    "ConstantColour",
    "Illumination",
    "Picture",
    "Renderer",
    "Survey",
    "World",
    "build_world",
    "illuminate",
    "look_at",
    "station_camera",
    "survey_ledger",
    "survey_scene",
    "world_of",
]
