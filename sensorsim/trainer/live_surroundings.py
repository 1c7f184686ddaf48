"""Surroundings of a frame as the host has them at the moment: clock, air, visibility and path model."""

from dataclasses import replace

from sensorsim.environment import clear_path
from sensorsim.render import Illumination, Renderer
from sensorsim.trainer.frame_request import FrameRequest
from sensorsim.trainer.live_air import live_sample


def live_surroundings(
    renderer: Renderer, time_of_day: float, request: FrameRequest, visibility: float | None
) -> Illumination:
    """Surroundings at a time of the image day [s]; without an air path where the host wants source radiance."""
    moment = renderer.world.environment.at(time_of_day)
    sample = live_sample(moment, request.air, visibility, sun=request.sun)
    around = renderer.illuminate(time_of_day, sample=sample)
    source_only = request.air is not None and not request.air.path_model
    return replace(around, air=clear_path()) if source_only else around
