"""What an image generator is told before a host speaks to it."""

from dataclasses import dataclass
from datetime import datetime
from typing import Literal

from sensorsim.errors import InputError
from sensorsim.trainer.dialect import CIGI_33, Dialect
from sensorsim.trainer.fields import ByteOrder
from sensorsim.trainer.host_state import View


@dataclass(frozen=True, slots=True, kw_only=True)
class ImageSettings:
    """How the image generator behaves; limits keep a host from using up memory or time.

    start: the clock until the host sets it. celestial_utc_offset: of the host's dates and times [h].
    synchronous: the image generator is the clock and the host answers each Start of Frame.
    half_angles: 'signed' as CIGI has them, or 'magnitude' for hosts that send all four of a view as positive.
    """

    start: datetime
    views: tuple[View, ...] = (View(number=0),)
    dialect: Dialect = CIGI_33
    order: ByteOrder = "<"
    synchronous: bool = True
    celestial_utc_offset: float = 0.0
    half_angles: Literal["signed", "magnitude"] = "signed"
    most_entities: int = 4096
    most_views: int = 16
    most_components: int = 4096
    most_queries: int = 256
    queries_per_frame: int = 64

    def __post_init__(self) -> None:
        """Refuse a clock without offset, views that share a number, and limits that allow nothing."""
        where = "image generator"
        if self.start.tzinfo is None:
            raise InputError(where, "start", str(self.start), "a time without offset", "give a UTC offset")
        numbers = [view.number for view in self.views]
        if len(set(numbers)) != len(numbers):
            raise InputError(where, "views", numbers, "a number twice", "number them differently")
        if not -14.0 <= self.celestial_utc_offset <= 14.0:
            offset = self.celestial_utc_offset
            raise InputError(where, "celestial_utc_offset", offset, "outside -14 to 14 h", "give hours")
        for name in ("most_entities", "most_views", "most_components", "most_queries", "queries_per_frame"):
            if getattr(self, name) < 1:
                raise InputError(where, name, getattr(self, name), "allows nothing", "give 1 at least")


@dataclass(frozen=True, slots=True, kw_only=True)
class Moment:
    """When a message is applied: the frame under way, and the IG time at which what it says is true [s]."""

    frame: int
    time: float
    settings: ImageSettings
