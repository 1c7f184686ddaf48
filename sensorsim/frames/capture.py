"""One look of a renderer as a frame with everything that made it."""

from datetime import datetime

import numpy as np

from sensorsim.effects import NOT_MODELLED
from sensorsim.errors import InputError
from sensorsim.frames.frame import JSON, Frame, build_frame
from sensorsim.render import Camera, Picture, Renderer
from sensorsim.sensor import DisplaySettings
from sensorsim.version import __version__


def take_frame(
    renderer: Renderer, camera: Camera, at: datetime | str, *, display: DisplaySettings | None = None
) -> Frame:
    """Frame at a local standard time (or one with an offset) of the world's image day."""
    picture = renderer.render(camera, seconds_after_midnight(renderer, at), display=display)
    return build_frame(picture.planes, frame_settings(renderer, picture))


def seconds_after_midnight(renderer: Renderer, at: datetime | str) -> float:
    """Time of the image day [s]; a time without an offset is local standard time of the site."""
    midnight = renderer.world.environment.image_start
    try:
        moment = datetime.fromisoformat(at) if isinstance(at, str) else at
    except ValueError as error:
        raise InputError("frame", "time", at, "no ISO 8601 time", "write for example 1976-02-07T10:00") from error
    if moment.tzinfo is None:
        moment = moment.replace(tzinfo=midnight.tzinfo)
    seconds = (moment - midnight).total_seconds()
    if not 0.0 <= seconds <= 86400.0:
        day = midnight.date().isoformat()
        raise InputError(
            renderer.world.weather.file.name, "time", str(at), f"not on the baked day {day}", "bake that day"
        )
    return seconds


def frame_settings(renderer: Renderer, picture: Picture) -> dict[str, JSON]:
    """All inputs of a picture, as plain values."""
    world, sensor, display = renderer.world, renderer.sensor, picture.display
    scene = world.scene
    bake = world.tables.settings.to_dict()
    return {
        "sensorsim": __version__,
        "scene": {"name": scene.name, "level": scene.level, "files": [path.name for path in scene.files]},
        "weather": {"name": world.weather.name, "file": world.weather.file.name},
        "warnings": list(world.warnings),
        "day": world.tables.day.isoformat(),
        "time_of_day_s": picture.time_of_day,
        "utc_offset_h": world.environment.site.utc_offset,
        "bake": {**bake, "reflectances": list(bake["reflectances"])},
        "sensor": {"name": sensor.name, "title": sensor.title, "band": sensor.band.name, "mode": sensor.mode},
        "size": list(renderer.size),
        "camera": _camera_settings(renderer, picture.camera),
        "display": {
            "polarity": display.polarity,
            "level": display.level,
            "span": display.span,
            "unit": "W m-2 sr-1",
        },
        "effects": picture.ledger.to_list(),
        "not_modelled": list(NOT_MODELLED),
        "atmosphere": {"form": "one coefficient", "attenuation_per_m": picture.illumination.attenuation},
    }


def _camera_settings(renderer: Renderer, camera: Camera) -> dict[str, JSON]:
    longitude, latitude = renderer.world.scene.frame.degrees_from_metres(np.atleast_2d(camera.position[:2]))[0]
    return {
        "longitude": float(longitude),
        "latitude": float(latitude),
        "height_m": float(camera.position[2]),
        "yaw_deg": camera.yaw,
        "pitch_deg": camera.pitch,
        "roll_deg": camera.roll,
        "horizontal_field_of_view_deg": camera.horizontal_field_of_view,
    }
