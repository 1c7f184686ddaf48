"""The report's figures by any sensors: what reaches a detector above what it makes of it, in one window."""

from pathlib import Path

import imageio.v3 as imageio
import numpy as np
import pytest

from sensorsim.errors import InputError
from sensorsim.sensor import load_sensor
from sensorsim.study import FIGURES, make_gallery
from sensorsim.tables import BakeSettings

COARSE = BakeSettings(
    interpolation="barycentric", lobes=0.0, orientations="report10", reflectances=(0.1, 0.9), degree=1, step=1800.0,
    slice_interval=3600.0, lead_in_days=1.0,
)  # fmt: skip


def made(folder: Path, *names: str) -> dict[int, Path]:
    """Sheets by the numbers of their figures."""
    sensors = [load_sensor(name) for name in names]
    sheets = make_gallery(folder, size=(48, 36), settings=COARSE, sensors=sensors)
    return {figure.number: sheet for figure, sheet in zip(FIGURES, sheets, strict=True)}


def test_what_a_period_sensor_makes_of_a_figure_stands_below_what_reaches_it(tmp_path: Path) -> None:
    """And the figures of the other band stay those of the report's own sensor."""
    plain, period = made(tmp_path / "plain"), made(tmp_path / "period", "flir1977")
    for figure in FIGURES:
        before, after = (imageio.imread(sheets[figure.number]) for sheets in (plain, period))
        if figure.sensor == "lltv":
            assert np.array_equal(before, after)
        else:
            assert period[figure.number].name == f"figure_{figure.number}_flir1977_{figure.level}.png"
            assert after.shape[0] - before.shape[0] >= 2 * 36
            # Rows of the sheet that hold pictures reach from black to white; there are three times as many.
            assert [int(np.sum(np.ptp(sheet.astype(int), axis=1) > 100)) >= rows * 30 for sheet, rows in (
                (before, 1), (after, 3),
            )] == [True, True]  # fmt: skip


def test_two_sensors_of_one_band_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="two in place of flir"):
        made(tmp_path, "flir1977", "uncooled")
