"""From a world to display codes and no further: numbers of surfaces drawn, their light, the detector's rows, grey."""

from collections.abc import Callable

import moderngl
import numpy as np
from numpy.typing import NDArray

from sensorsim.radiometry import BandTable
from sensorsim.render.camera import Camera
from sensorsim.render.illumination import Illumination
from sensorsim.render.planes import Planes, surface_planes
from sensorsim.render.quick_frame import MOST_SURFACES, QuickFrame
from sensorsim.render.quick_light import QuickLight
from sensorsim.render.solids import Solids
from sensorsim.render.surface_table import SurfaceRows
from sensorsim.render.world import World
from sensorsim.sensor import AutoGain, DisplaySettings, RowChain, Sensor


class QuickRoad:
    """Display codes of one sensor's pictures of a world, in the renderer's context."""

    def __init__(
        self, ctx: moderngl.Context, world: World, sensor: Sensor, size: tuple[int, int], rows: SurfaceRows,
        planes: Planes, band_table: BandTable | None, gain: AutoGain, *, samples: int, energy: float,
    ) -> None:  # fmt: skip
        drawn = (samples * size[0], samples * size[1])
        self.frame, self.gain = QuickFrame(ctx, world, drawn), gain
        self.rows = RowChain(sensor, size, samples=samples, energy=energy)
        self.light = QuickLight(world, drawn, rows, planes, band_table, self.rows.each)

    def show(
        self, camera: Camera, time_of_day: float, illumination: Illumination, display: DisplaySettings, number: int,
        solids: Solids | None, watch: Callable[[str], None],
    ) -> tuple[NDArray[np.uint8], DisplaySettings]:  # fmt: skip
        """Codes (height, width) of the frame of that number at that moment; `watch` is told of each stage."""
        rows = self.rows
        self.frame.draw(camera, solids)
        watch("draw")
        numbers = self.frame.read()
        watch("read-back")
        self.light.fill(numbers, camera, time_of_day, illumination, solids, rows.light, rows.surface)
        watch("light")
        signal = rows.run(float(np.radians(camera.horizontal_field_of_view)), number)
        watch("sensor")
        seen = None if display.is_straight and not display.is_automatic else rows.seen(signal)
        settings = display if seen is None else self.gain.window(display, seen)
        curve = None if seen is None else self.gain.curve(settings, seen)
        watch("window")
        codes = rows.show(settings, curve)
        watch("display")
        return codes, settings

    def release(self) -> None:
        """Give back the threads; the context takes the rest with it."""
        self.rows.release()


def quick_planes(world: World) -> Planes | None:
    """The planes of a world's surfaces; None where one is not flat or there are too many for this road."""
    count = world.scene.surfaces.area.size
    return surface_planes(world.scene.mesh, world.scene.surfaces.normal) if count < MOST_SURFACES // 2 else None
