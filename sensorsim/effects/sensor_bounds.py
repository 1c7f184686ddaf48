"""What the parts of a sensor's chain are worth in its signal: no two signals are farther apart than its range."""

from collections.abc import Collection, Mapping

from sensorsim.effects.costs import pixel_cost
from sensorsim.effects.ledger import NOISE_SHARE, Bound
from sensorsim.sensor import FILLED, Sensitivity

_REASON = {
    "blur": "optics and detector are of a size",
    "noise": "a pixel deviates by {deviation:.3g} W m-2 sr-1 and more",
    "memory": "the detector keeps a share of the last picture",
    "streaks": "its channels are coupled by capacitors",
    "halo": "its tube scatters light beyond saturation",
    "blooming": "its full wells spill",
    "dead_elements": "some of its elements do not see",
    "replacement": "it knows its dead elements",
    "interlace": "its frames come in fields",
    "raster_lines": "its raster has lines of its own",
}


def sensor_bounds(parts: Collection[str], look: Sensitivity, *, brightest: float, pixels: int) -> Mapping[str, Bound]:
    """Bounds [W m-2 sr-1] of the signal; an iris widens the range where the `brightest` of a picture asks for it."""
    deviation = float(look.deviation(0.0))
    return {
        part: Bound(
            value=max(look.full, brightest / FILLED), reason=_REASON[part].format(deviation=deviation),
            saves=pixel_cost(part, pixels),
        )
        for part in parts
    }  # fmt: skip


def signal_tolerance(look: Sensitivity) -> float:
    """A share of the deviation of a pixel without light, or of a count where that is more [W m-2 sr-1]."""
    return NOISE_SHARE * max(float(look.deviation(0.0)), look.step)
