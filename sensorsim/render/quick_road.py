"""From a quick frame to display codes: the detector's rows on the processor, window and grey."""

from collections.abc import Callable, Mapping

import moderngl
import numpy as np
from numpy.typing import NDArray

from sensorsim.render.camera import Camera
from sensorsim.render.quick_frame import QuickFrame
from sensorsim.render.world import World
from sensorsim.sensor import AutoGain, DisplaySettings, RowChain, Sensor


class QuickRoad:
    """Display codes of one sensor's pictures of a world, in the renderer's context."""

    def __init__(
        self, ctx: moderngl.Context, world: World, sensor: Sensor, size: tuple[int, int],
        generated: Mapping[str, str], *, samples: int, energy: float, gain: AutoGain,
    ) -> None:  # fmt: skip
        drawn = (samples * size[0], samples * size[1])
        self.frame = QuickFrame(ctx, world, drawn, generated, emissive=sensor.mode == "emissive")
        self.gain = gain
        self.rows = RowChain(sensor, size, samples=samples, energy=energy)

    def show(
        self, camera: Camera, display: DisplaySettings, number: int, moment: int, watch: Callable[[str], None],
        draw_solids: Callable[[], None],
    ) -> tuple[NDArray[np.uint8], DisplaySettings]:  # fmt: skip
        """Codes (height, width) of the frame of that number at that moment; `watch` is told of each stage."""
        self.frame.settle(moment)
        self.frame.draw(camera, draw_solids)
        watch("draw")
        stored = self.frame.read()
        watch("read-back")
        signal = self.rows.run(stored, float(np.radians(camera.horizontal_field_of_view)), number)
        watch("sensor")
        seen = None if display.is_straight and not display.is_automatic else self.rows.seen(signal)
        settings = display if seen is None else self.gain.window(display, seen)
        curve = None if seen is None else self.gain.curve(settings, seen)
        watch("window")
        codes = self.rows.show(settings, curve)
        watch("display")
        return codes, settings

    def release(self) -> None:
        """Give back the threads; the context takes the rest with it."""
        self.rows.release()
