"""Real-time, physically based imagery of passive electro-optical sensors.

    scene -> materials -> environment -> thermal -> tables -> gpu / shaders -> sensor -> frames

Load a scene and its weather, bake the tables, open a renderer as a context manager, take frames:

    scene = load_scene("hospital", level="IIIB")
    world = build_world(scene, read_weather("winter"), image_day=date(1976, 2, 7))
    with Renderer(world, load_sensor("flir")) as renderer:
        frame = take_frame(renderer, station_camera(scene, "tower"), "1976-02-07T10:00")
    frame.plane("apparent_temperature").data
"""

from sensorsim.environment import build_environment, read_weather
from sensorsim.errors import GraphicsError, InputError, NumericsError, SensorsimError
from sensorsim.frames import Frame, read_plane, take_frame, write_frame
from sensorsim.materials import load_catalogue
from sensorsim.render import Camera, Renderer, World, build_world, look_at, station_camera
from sensorsim.scene import load_scene
from sensorsim.sensor import DisplaySettings, load_sensor
from sensorsim.tables import BakeSettings, bake_tables, preset, surface_temperature
from sensorsim.version import __version__

__all__ = [
    "BakeSettings",
    "Camera",
    "DisplaySettings",
    "Frame",
    "GraphicsError",
    "InputError",
    "NumericsError",
    "Renderer",
    "SensorsimError",
    "World",
    "__version__",
    "bake_tables",
    "build_environment",
    "build_world",
    "load_catalogue",
    "load_scene",
    "load_sensor",
    "look_at",
    "preset",
    "read_plane",
    "read_weather",
    "station_camera",
    "surface_temperature",
    "take_frame",
    "write_frame",
]
