"""Longitude and latitude against local metres."""

import numpy as np
import pytest
from pyproj import Geod

from sensorsim.scene import LocalFrame

FRAME = LocalFrame(longitude=-84.02, latitude=39.82)


def _strip_points() -> np.ndarray:
    return np.stack(np.meshgrid(np.linspace(-2400.0, 2400.0, 25), np.linspace(-2400.0, 2400.0, 25)), -1).reshape(-1, 2)


def test_round_trip_returns_to_the_millimetre() -> None:
    metres = _strip_points()
    again = FRAME.metres_from_degrees(FRAME.degrees_from_metres(metres))
    np.testing.assert_allclose(again, metres, atol=1e-6, rtol=0.0)


def test_local_lengths_are_geodesic_lengths() -> None:
    metres = _strip_points()
    degrees = FRAME.degrees_from_metres(metres)
    geod = Geod(ellps="WGS84")
    first, last = degrees[0], degrees[-1]
    _, _, length = geod.inv(*first, *last)
    assert float(np.hypot(*(metres[-1] - metres[0]))) == pytest.approx(length, rel=1e-6)


def test_axes_point_east_and_north() -> None:
    geod = Geod(ellps="WGS84")
    for east, north, azimuth in ((500.0, 0.0, 90.0), (0.0, 500.0, 0.0), (-500.0, 0.0, -90.0)):
        longitude, latitude = FRAME.degrees_from_metres(np.array([[east, north]]))[0]
        found, _, _ = geod.inv(FRAME.longitude, FRAME.latitude, longitude, latitude)
        assert found == pytest.approx(azimuth, abs=0.01)


def test_one_place_is_converted_as_many_are() -> None:
    for east, north in _strip_points()[::97].tolist():
        ((longitude, latitude),) = FRAME.degrees_from_metres(np.array([[east, north]]))
        assert FRAME.longitude_latitude(east, north) == (longitude, latitude)
        assert FRAME.east_north(longitude, latitude) == pytest.approx((east, north), abs=1e-6)
