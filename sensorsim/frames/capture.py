"""One look of a renderer as a frame with everything that made it."""

import hashlib
from collections.abc import Collection
from dataclasses import fields
from datetime import datetime

import numpy as np

from sensorsim.constants import SECONDS_PER_HOUR
from sensorsim.effects import NOT_MODELLED
from sensorsim.errors import InputError
from sensorsim.frames.fit_error import fit_error_plane, surface_fit_error
from sensorsim.frames.frame import JSON, STANDARD_PLANES, Frame, build_frame
from sensorsim.frames.writer import inputs_sha256
from sensorsim.render import Camera, Picture, Renderer
from sensorsim.sensor import DisplaySettings, Sensor
from sensorsim.tables import ShadeTables, SurfaceOffsets
from sensorsim.version import __version__


def take_frame(
    renderer: Renderer,
    camera: Camera,
    at: datetime | str | float,
    *,
    display: DisplaySettings | None = None,
    frame: int = 0,
    fit_error: bool = False,
    planes: Collection[str] | None = None,
) -> Frame:
    """Frame at a local standard time (or one with an offset, or seconds after midnight) of the world's image day.

    frame: its number in a sequence, which decides its noise. With `fit_error` it has a plane of that name, for which
    all surfaces are solved in full: that takes seconds. planes: those that are computed, all where it is left out;
    display alone takes a fraction of the time.
    """
    time_of_day = float(at) if isinstance(at, (int, float)) else seconds_after_midnight(renderer, at)
    wanted = None if planes is None else {*planes, *(("surface_id",) if fit_error else ())} - {"fit_error"}
    picture = renderer.render(camera, time_of_day, display=display, frame=frame, planes=wanted)
    request = request_settings(renderer, camera, time_of_day, display=display, frame=frame)
    settings: dict[str, JSON] = {**request, **_outcome(renderer, picture), "request_sha256": inputs_sha256(request)}
    detector = renderer.sensor.detector
    bits = None if detector is None else detector.bits
    if not fit_error:
        return build_frame(picture.planes, settings, bits=bits)
    error = surface_fit_error(renderer.world, time_of_day)
    plane = fit_error_plane(error, picture.planes["surface_id"])
    told: dict[str, JSON] = {
        "of": "tables less full solve, without sign",
        "largest_of_all_surfaces_K": float(error.max()),
    }
    return build_frame({**picture.planes, "fit_error": plane}, {**settings, "fit_error": told}, bits=bits)


def plane_names(sensor: Sensor) -> tuple[str, ...]:
    """Planes of a sensor's frames: signal and counts by a detector, an apparent temperature in emissive bands."""
    there = {"signal": sensor.detector is not None, "counts": sensor.has_counts}
    there |= {"apparent_temperature": sensor.mode == "emissive"}
    return tuple(name for name in STANDARD_PLANES if there.get(name, True))


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


def request_settings(
    renderer: Renderer, camera: Camera, time_of_day: float, *, display: DisplaySettings | None, frame: int
) -> dict[str, JSON]:
    """All that decides a frame, as plain values: known before it is drawn."""
    world, sensor = renderer.world, renderer.sensor
    scene, bake = world.scene, world.tables.settings.to_dict()
    return {
        "sensorsim": __version__,
        "scene": {"name": scene.name, "level": scene.level, "files": [path.name for path in scene.files]},
        "detail_pixels": None if scene.lineage is None else renderer.detail.pixels,
        "weather": {"name": world.weather.name, "file": world.weather.file.name},
        "warnings": list(world.warnings),
        "day": world.tables.day.isoformat(),
        "time_of_day_s": time_of_day,
        "utc_offset_h": world.environment.site.utc_offset,
        "bake": {**bake, "reflectances": list(bake["reflectances"])},
        "lead_in": _lead_in_settings(world.tables),
        "exchange": _exchange_settings(world.offsets),
        "effects_asked": world.choice.text,
        "not_modelled": list(NOT_MODELLED),
        "world_sha256": world.inputs_sha256,
        "sensor": _sensor_settings(sensor),
        "size": list(renderer.size),
        "samples": renderer.samples,
        "frame": frame,
        "air": renderer.atmosphere,
        "visibility_m": world.environment.visibility,
        "aerosol": world.environment.aerosol,
        "camera": _camera_settings(renderer, camera),
        "display_asked": None if display is None else {f.name: getattr(display, f.name) for f in fields(display)},
    }


def _air_settings(renderer: Renderer, picture: Picture) -> dict[str, JSON]:
    """Name and terms of the air that a picture was seen through."""
    air = picture.illumination.air
    return {
        "name": renderer.atmosphere,
        "weight": air.weight.tolist(),
        "coefficient_per_m": air.coefficient.tolist(),
        "inverse_scale_height_per_m": air.inverse_scale_height.tolist(),
        "haze_per_m": air.haze.extinction,
        "haze_decay_per_m": [air.haze.below, air.haze.above],
        "source_W_m-2_sr-1": air.source.tolist(),
    }


def _outcome(renderer: Renderer, picture: Picture) -> dict[str, JSON]:
    """What was found while drawing."""
    display, ledger = picture.display, picture.ledger
    if ledger is None:
        ledger = renderer.ledger(picture.camera, picture.time_of_day, picture.illumination)
    window = {"polarity": display.polarity, "level": display.level, "span": display.span, "unit": "W m-2 sr-1"}
    return {
        "display": {**window, **{name: getattr(display, name) for name in ("tone", "gamma", "detail", "settle")}},
        "counts": _count_settings(renderer.sensor, picture),
        "effects": ledger.to_list(),
        "atmosphere": _air_settings(renderer, picture),
    }


def _count_settings(sensor: Sensor, picture: Picture) -> JSON:
    """Depth of the detector's counts and the band radiance of one; nothing of a sensor or a picture without."""
    if sensor.detector is None or picture.count_step is None:
        return None
    return {"bits": sensor.detector.bits, "radiance_per_count_W_m-2_sr-1": picture.count_step}


def _lead_in_settings(tables: ShadeTables) -> JSON:
    """From how long before the image day walls were marched, and which began with their first day repeated."""
    if not tables.lead_in:
        return None  # nothing was marched
    hours = [one.span / SECONDS_PER_HOUR for one in tables.lead_in]
    repeated = [wall.name for wall, one in zip(tables.wall_types, tables.lead_in, strict=True) if one.repeated]
    return {"shortest_h": min(hours), "longest_h": max(hours), "first_day_repeated": list(dict.fromkeys(repeated))}


def _exchange_settings(offsets: SurfaceOffsets | None) -> JSON:
    """What near surfaces do to each other, where they were asked for."""
    if offsets is None:
        return None
    largest = float(np.max(np.abs(offsets.offset), initial=0.0))
    return {
        "surfaces": offsets.surface.size, "passes": offsets.passes, "left_K": offsets.left, "largest_K": largest
    }  # fmt: skip


def _sensor_settings(sensor: Sensor) -> dict[str, JSON]:
    """Name and mode, and a hash of all numbers that describe it."""
    parts = [repr(getattr(sensor, field.name)) for field in fields(sensor) if field.name != "band"]
    parts += [sensor.band.name, sensor.band.wavelength.tobytes().hex(), sensor.band.response.tobytes().hex()]
    digest = hashlib.sha256("\n".join(parts).encode()).hexdigest()
    plain: dict[str, JSON] = {"name": sensor.name, "title": sensor.title, "band": sensor.band.name, "mode": sensor.mode}
    return {**plain, "sha256": digest}


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
