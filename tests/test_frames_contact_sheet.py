"""Contact sheets: the images stay what they are, and everything said about them fits on the sheet."""

import numpy as np
import pytest

from sensorsim.errors import InputError, NumericsError
from sensorsim.frames import ScaleBar, contact_sheet, radiance_scale, temperature_scale
from sensorsim.radiometry import FLIR_BAND, build_band_table
from sensorsim.sensor import DisplaySettings, grey_level, window_from_temperatures

RANDOM = np.random.default_rng(4)
IMAGES = [[RANDOM.integers(0, 256, (40, 60), dtype=np.uint8) for _ in range(3)] for _ in range(2)]
LABELS = {"title": "Hospital", "row_labels": ["IA", "IIIB"], "column_labels": ["07:00", "10:00", "13:00"]}
TABLE = build_band_table(FLIR_BAND)


def window(low, high, polarity="white-hot"):
    level, span = window_from_temperatures(TABLE, low, high)
    return DisplaySettings(polarity=polarity, level=level, span=span)


def places(sheet, image):
    """Rows and columns where the image stands in the sheet."""
    windows = np.lib.stride_tricks.sliding_window_view(sheet, image.shape)
    return np.argwhere((windows[:, :, ::13, ::17] == image[::13, ::17]).all(axis=(2, 3)))


def border(sheet):
    return np.concatenate([sheet[0], sheet[-1], sheet[:, 0], sheet[:, -1]])


def test_every_image_stands_unchanged_in_its_row_and_column():
    sheet = contact_sheet(IMAGES, **LABELS)
    assert sheet.dtype == np.uint8
    found = np.array([[places(sheet, image) for image in row] for row in IMAGES])
    assert found.shape == (2, 3, 1, 2)  # each of them once
    for (top, left), image in zip(found.reshape(-1, 2), [image for row in IMAGES for image in row], strict=True):
        assert np.array_equal(sheet[top : top + 40, left : left + 60], image)
    rows, columns = found[:, :, 0, 0], found[:, :, 0, 1]
    assert (rows == rows[:, :1]).all()
    assert (np.diff(rows, axis=0) > 40).all()
    assert (columns == columns[:1]).all()
    assert (np.diff(columns, axis=1) > 60).all()


def test_equal_input_gives_an_equal_sheet():
    assert np.array_equal(contact_sheet(IMAGES, **LABELS), contact_sheet(IMAGES, **LABELS))


@pytest.mark.parametrize(
    "extra",
    [
        {"title": "A long title " * 20},
        {"caption": "A long caption " * 40},
        {"row_labels": ["Level IA\nof the scene", "Level IIIB"]},
        {"column_labels": ["morning before sunrise", "unbreakablywidelabel", "noon"]},
        {"cell_labels": [["280.0 K and more words"] * 3] * 2},
        {"scale": temperature_scale(window(250.0, 300.0), TABLE, band="FLIR 8-14 um")},
    ],
    ids=lambda extra: next(iter(extra)),
)
def test_all_text_lies_on_the_sheet(extra):
    plain = contact_sheet([[np.full((20, 30), 200, np.uint8)] * 3] * 2, **LABELS)
    sheet = contact_sheet([[np.full((20, 30), 200, np.uint8)] * 3] * 2, **{**LABELS, **extra})
    assert (border(sheet) == 255).all()
    assert np.sum(sheet < 128) > np.sum(plain < 128)


def test_empty_cells_keep_their_place():
    with_gap = [[IMAGES[0][0], None, IMAGES[0][2]], IMAGES[1]]
    full, gap = contact_sheet(IMAGES, **LABELS), contact_sheet(with_gap, **LABELS)
    assert gap.shape == full.shape
    assert places(gap, IMAGES[0][2]).tolist() == places(full, IMAGES[0][2]).tolist()
    assert places(gap, IMAGES[0][1]).size == 0


@pytest.mark.parametrize("polarity", ["white-hot", "black-hot"])
def test_bar_shows_all_greys_in_the_order_of_the_polarity(polarity):
    scale = temperature_scale(window(250.0, 300.0, polarity), TABLE, band="FLIR 8-14 um")
    sheet = contact_sheet(
        [[np.full((60, 400), 7, np.uint8)]], title="", row_labels=[""], column_labels=[""], scale=scale
    )
    steps = np.diff(sheet.astype(int), axis=1)
    ramps = (steps >= 0) & (steps <= 1) if polarity == "white-hot" else (steps <= 0) & (steps >= -1)
    greys = [set(row[1:][ramp].tolist()) for row, ramp in zip(sheet, ramps, strict=True)]
    assert max(len(found) for found in greys) >= 254


def test_ticks_in_kelvin_stand_where_their_grey_is():
    settings = window(251.3, 299.1)
    scale = temperature_scale(settings, TABLE, band="FLIR 8-14 um")
    positions, labels = zip(*scale.ticks, strict=True)
    assert list(labels) == ["260", "270", "280", "290"]
    radiance = TABLE.radiance_at([float(label) for label in labels])
    assert positions == pytest.approx(grey_level(radiance, settings).tolist(), abs=1e-12)
    assert "251.3 to 299.1 K" in scale.title


@pytest.mark.parametrize(("low", "high"), [(0.0, 1.0), (46.9, 46.95), (1e-7, 3e-6), (-1e-9, 1e-9), (5.0, 123456.0)])
def test_ticks_are_few_apart_and_true(low, high):
    scale = radiance_scale(DisplaySettings(level=(low + high) / 2.0, span=high - low), band="FLIR 8-14 um")
    positions, labels = zip(*scale.ticks, strict=True)
    assert 2 <= len(labels) <= 9
    assert len(set(labels)) == len(labels)
    expected = [(float(label) - low) / (high - low) for label in labels]
    assert positions == pytest.approx(expected, abs=1e-6)


def test_bar_needs_a_window_within_the_table():
    with pytest.raises(InputError, match="automatic"):
        radiance_scale(DisplaySettings(), band="FLIR 8-14 um")
    with pytest.raises(NumericsError, match="outside the band table"):
        temperature_scale(DisplaySettings(level=0.0, span=10.0), TABLE, band="FLIR 8-14 um")
    with pytest.raises(InputError, match=r"outside \[0, 1\]"):
        ScaleBar(title="bad", ticks=((1.5, "300"),))


@pytest.mark.parametrize(
    ("images", "labels", "said"),
    [
        (IMAGES, {"row_labels": ["IA"]}, "give one for each row"),
        (IMAGES, {"column_labels": ["07:00"]}, "fill gaps with None"),
        (IMAGES, {"cell_labels": [["", ""]]}, "not one for each cell"),
        ([[None] * 3] * 2, {}, "give one image at least"),
        ([[IMAGES[0][0], IMAGES[0][1], np.zeros((40, 61), np.uint8)], IMAGES[1]], {}, "give images of one size"),
        ([[image.astype(float) for image in row] for row in IMAGES], {}, "not uint8"),
    ],
)
def test_input_that_makes_no_sheet_is_refused(images, labels, said):
    with pytest.raises(InputError, match=said) as caught:
        contact_sheet(images, **{**LABELS, **labels})
    assert "\n" not in str(caught.value)
