"""Frames in memory: what a plane and a frame may be."""

import numpy as np
import pytest

from sensorsim.errors import InputError
from sensorsim.frames import Frame, Plane, build_frame

IMAGE = np.ones((3, 4))


def plane(name="radiance", data=IMAGE, no_surface=None):
    return Plane(name=name, data=data, unit="1", description="a test", no_surface=no_surface)


def test_standard_planes_have_their_units_and_types():
    names = [
        "display",
        "radiance",
        "apparent_temperature",
        "surface_temperature",
        "surface_id",
        "feature",
        "material",
        "range",
    ]
    frame = build_frame({name: np.ones((3, 4), dtype=np.int64) for name in names}, {})
    units = {name: frame.plane(name).unit for name in names}
    assert units["radiance"] == "W m-2 sr-1"
    assert units["apparent_temperature"] == units["surface_temperature"] == "K"
    assert units["range"] == "m"
    assert frame.plane("display").data.dtype == np.uint8
    assert frame.plane("surface_id").data.dtype == np.int32
    assert frame.plane("range").data.dtype == np.float64
    assert frame.shape == (3, 4)


def test_single_precision_stays_single_precision():
    assert build_frame({"radiance": np.ones((3, 4), dtype=np.float32)}, {}).plane("radiance").data.dtype == np.float32


def test_pixels_without_a_surface_do_not_count_in_the_limits():
    frame = build_frame({"range": np.array([[0.0, 120.0, 340.0]]), "surface_id": np.array([[-1, 0, 7]])}, {})
    assert frame.plane("range").limits == (120.0, 340.0)
    assert frame.plane("surface_id").limits == (0.0, 7.0)
    assert plane(data=np.array([[0.0, 3.0]])).limits == (0.0, 3.0)
    assert plane(data=np.zeros((2, 2)), no_surface=0.0).limits is None


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("display", np.array([[256]])),
        ("display", np.array([[-1]])),
        ("display", np.array([[0.5]])),
        ("surface_id", np.array([[2**31]])),
        ("surface_id", np.array([[1.0]])),
    ],
)
def test_data_that_the_plane_cannot_hold_are_refused(name, data):
    with pytest.raises(InputError, match="does not fit"):
        build_frame({name: data}, {})


def test_unknown_plane_is_refused_with_the_list():
    with pytest.raises(InputError, match="use display, radiance, signal, counts, apparent_temperature"):
        build_frame({"temperature": IMAGE}, {})
    with pytest.raises(InputError, match="plane = 'range': not in this frame; use radiance"):
        build_frame({"radiance": IMAGE}, {}).plane("range")


@pytest.mark.parametrize("data", [np.ones(3), np.ones((3, 4, 3)), np.ones((0, 4)), np.array([["a"]]), IMAGE > 0])
def test_plane_that_is_no_image_of_numbers_is_refused(data):
    with pytest.raises(InputError, match=r"no (image|numbers)"):
        plane(data=data)


def test_frame_whose_planes_do_not_match_is_refused():
    with pytest.raises(InputError, match="give all planes one size"):
        Frame(planes={"a": plane("a"), "b": plane("b", np.ones((4, 3)))}, settings={})
    with pytest.raises(InputError, match="filed under another name"):
        Frame(planes={"a": plane("b")}, settings={})
    with pytest.raises(InputError, match="empty"):
        Frame(planes={}, settings={})
