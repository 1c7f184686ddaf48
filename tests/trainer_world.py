"""A small scene, an image generator over it, and a host that speaks to it in bytes."""

from datetime import UTC, datetime

import numpy as np
from cigi_samples import first_packet
from numpy.typing import NDArray

from sensorsim.scene import LocalFrame
from sensorsim.trainer.decode import decode_message
from sensorsim.trainer.dialect import CIGI_33, Dialect
from sensorsim.trainer.encode import encode_message, make_packet
from sensorsim.trainer.fields import Packet
from sensorsim.trainer.image_generator import ImageGenerator
from sensorsim.trainer.local_place import LocalPlace
from sensorsim.trainer.poses import Surroundings
from sensorsim.trainer.settings import ImageSettings
from sensorsim.trainer.terrain import Terrain, terrain_from_triangles

LATITUDE, LONGITUDE, ALTITUDE = 39.82, -84.02, 255.0  # of the scene's origin
PERIOD = 1.0 / 60.0
NOON = datetime(1976, 2, 7, 17, 0, tzinfo=UTC)
UTC_OFFSET = -5.0
PLACE = LocalPlace(frame=LocalFrame(longitude=LONGITUDE, latitude=LATITUDE), altitude=ALTITUDE)
GRASS, BRICK, SLATE = 94, 20, 12


def box_and_ground() -> Terrain:
    """Ground of 4 km at height 0; a box 20 m high, 40 m wide from 100 m to 140 m east and -20 m to 20 m north; and a
    roof that rises to the east by 45 degrees from 300 m east, 50 m deep."""
    quads: list[tuple[list[list[float]], int]] = [
        ([[-2000, -2000, 0], [2000, -2000, 0], [2000, 2000, 0], [-2000, 2000, 0]], GRASS),
        ([[100, -20, 20], [140, -20, 20], [140, 20, 20], [100, 20, 20]], SLATE),
        ([[100, 20, 0], [100, -20, 0], [100, -20, 20], [100, 20, 20]], BRICK),
        ([[140, -20, 0], [140, 20, 0], [140, 20, 20], [140, -20, 20]], BRICK),
        ([[100, -20, 0], [140, -20, 0], [140, -20, 20], [100, -20, 20]], BRICK),
        ([[140, 20, 0], [100, 20, 0], [100, 20, 20], [140, 20, 20]], BRICK),
        ([[300, -20, 0], [350, -20, 50], [350, 20, 50], [300, 20, 0]], SLATE),
    ]
    corners = np.array([quad for quad, _ in quads], dtype=np.float64)
    triangles: NDArray[np.float64] = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
    return terrain_from_triangles(triangles, np.array([material for _, material in quads] * 2))


AROUND = Surroundings(place=PLACE, terrain=box_and_ground())


class Host:
    """A host of one image generator, frame by frame."""

    def __init__(self, dialect: Dialect = CIGI_33, around: Surroundings = AROUND, **settings: object) -> None:
        start: dict[str, object] = {"start": NOON, "dialect": dialect}
        self.dialect = dialect
        self.ig = ImageGenerator(ImageSettings(**(start | settings)), around, utc_offset=UTC_OFFSET)  # type: ignore[arg-type]
        self.time = 0.0
        self.said: tuple[str, ...] = ()

    def frame(self, *packets: Packet, send: bool = True, **control: int) -> list[Packet]:
        """Start of Frame and answers of a new frame; then the host's message for it, in operate if not said."""
        answers = decode_message(self.ig.start_frame(self.time))
        assert answers.sound, answers.faults
        self.time += PERIOD
        if send:
            self.send(*packets, **control)
        return list(answers.packets)

    def send(self, *packets: Packet, **control: int) -> None:
        ticks = round(self.time * 1e5) % 2**32
        frames = {"host_frame_number": self.ig.frame + 1000, "last_ig_frame_number": self.ig.frame, "timestamp": ticks}
        first = first_packet(self.dialect, **(frames | control))
        self.said = self.ig.receive(encode_message(self.dialect, [first, *packets]), self.time)

    def packet(self, name: str, **values: float) -> Packet:
        return make_packet(self.dialect, name, **values)


def entity(east: float, north: float, up: float, **values: float) -> Packet:
    """Entity Control of entity 0, active, at a local place [m]."""
    latitude, longitude, altitude = PLACE.geodetic(np.array([east, north, up]))
    place = {"entity_state": 1, "lat_xoff": latitude, "lon_yoff": longitude, "alt_zoff": altitude}
    return make_packet(CIGI_33, "entity_control", **(place | values))
