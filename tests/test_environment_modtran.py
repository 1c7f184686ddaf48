"""MODTRAN tables as pyBSM stores them: read, fitted and refused. The tables here are made of known exponentials."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from small_world import environment

from sensorsim.environment import EnvironmentSample, saturation_vapour_pressure
from sensorsim.environment.modtran import modtran_path
from sensorsim.errors import InputError
from sensorsim.radiometry import FLIR_BAND, LLLTV_BAND, band_radiance, flat_band, spectral_radiance

WAVELENGTH = 1e-6 * np.linspace(0.3, 14.0, 1371)
GROUND = (0.0, 0.1, 0.5, *range(1, 21), *range(22, 62, 2))  # [km]
HEIGHTS = (0.002, 0.0325, 0.075, 0.5, 1.0, 12.0)  # [km]
COEFFICIENT = 1e-4 * (1.0 + 30.0 * (WAVELENGTH > 12e-6) + 5.0 * (WAVELENGTH < 9e-6))  # [m-1]
AIR = 294.2


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Air of one temperature, the same at all heights, grey in three parts of the spectrum."""
    place = tmp_path_factory.mktemp("atms")
    lines = ["Index, Altitude (km), Ground Range (km), IHAZE"]
    for height in HEIGHTS:
        for ground in GROUND:
            for haze in (1, 2):
                lines.append(f"{len(lines)},{height},{ground},{haze},")
                through = np.exp(-COEFFICIENT * haze * 1000.0 * np.hypot(height, ground))
                table = np.zeros((1371, 5))
                table[:, 0] = through
                table[:, 1] = (1.0 - through) * spectral_radiance(WAVELENGTH, AIR) * 1e-10
                table[:, 4] = through * 1e-3
                table.astype(np.float32).ravel(order="F").tofile(place / f"{len(lines) - 1}.bin")
    (place / "fileDecoder.csv").write_text("\n".join(lines))
    return place


@pytest.fixture
def summer() -> EnvironmentSample:
    humidity = 14e-3 * 461.52 * AIR / float(saturation_vapour_pressure(np.array(AIR)))
    return replace(
        environment().at(36000.0), air_temperature=AIR, relative_humidity=humidity, visibility=23_000.0,
        cloud_cover=0.0, precipitation=0.0, aerosol="rural",
    )  # fmt: skip


@pytest.mark.parametrize("height", [32.5, 60.0, 500.0, 1000.0])
@pytest.mark.parametrize("visibility", [23_000.0, 5_000.0])
def test_tables_are_met_at_all_ranges(
    folder: Path, summer: EnvironmentSample, height: float, visibility: float
) -> None:
    """Transmittance within 0.006 and, of air at one temperature, a target of that temperature within 0.05 %."""
    sample = replace(summer, visibility=visibility)
    path = modtran_path(FLIR_BAND, sample, height, emissive=True, folder=folder)
    distance = np.hypot(1000.0 * np.array(GROUND), height)
    inside = np.isclose(WAVELENGTH, WAVELENGTH[(WAVELENGTH >= 8e-6 - 1e-9)][0]) | (WAVELENGTH >= 8e-6 - 1e-9)
    slope = spectral_radiance(WAVELENGTH[inside], 290.5) - spectral_radiance(WAVELENGTH[inside], 289.5)
    haze = 1.0 if visibility == 23_000.0 else 2.0
    exact = np.exp(-haze * distance[:, None] * COEFFICIENT[inside]) @ slope / slope.sum()
    assert np.abs(path.transmittance(distance, height) - exact).max() < 0.006
    black = float(band_radiance(FLIR_BAND, AIR))
    np.testing.assert_allclose(path.apparent_radiance(black, distance, height), black, rtol=5e-3)


def test_reflected_light_takes_the_tables_transmittance_alone(folder: Path, summer: EnvironmentSample) -> None:
    path = modtran_path(LLLTV_BAND, summer, 75.0, emissive=False, folder=folder)
    distance = np.geomspace(110.0, 20e3, 9)
    np.testing.assert_allclose(path.transmittance(distance, 75.0), np.exp(-6e-4 * distance), atol=1e-3)
    np.testing.assert_array_equal(path.source, 0.0)


@pytest.mark.parametrize(
    ("changes", "entry"),
    [
        ({"air_temperature": 277.0}, "air temperature"),
        ({"relative_humidity": 0.3}, "water vapour"),
        ({"visibility": 10_000.0}, "visibility"),
        ({"aerosol": "maritime"}, "aerosol"),
        ({"precipitation": 1.0}, "rain"),
        ({"cloud_cover": 0.5}, "cloud cover"),
    ],
)
def test_other_weather_than_the_tables_is_refused(
    folder: Path, summer: EnvironmentSample, changes: dict[str, float], entry: str
) -> None:
    with pytest.raises(InputError, match=entry):
        modtran_path(FLIR_BAND, replace(summer, **changes), 100.0, emissive=True, folder=folder)


@pytest.mark.parametrize("height", [10_001.0, np.nan, np.inf])
def test_heights_above_the_tables_are_refused(folder: Path, summer: EnvironmentSample, height: float) -> None:
    with pytest.raises(InputError, match="camera height"):
        modtran_path(FLIR_BAND, summer, height, emissive=True, folder=folder)


def test_bands_beyond_the_tables_are_refused(folder: Path, summer: EnvironmentSample) -> None:
    with pytest.raises(InputError, match="band"):
        modtran_path(flat_band("long", 8e-6, 15e-6), summer, 100.0, emissive=True, folder=folder)


def test_broken_table_is_refused_by_its_file(folder: Path, summer: EnvironmentSample, tmp_path: Path) -> None:
    for file in folder.iterdir():
        (tmp_path / file.name).write_bytes(file.read_bytes()[: 100 if file.suffix == ".bin" else None])
    with pytest.raises(InputError, match="bin"):
        modtran_path(FLIR_BAND, summer, 100.0, emissive=True, folder=tmp_path)


def test_missing_tables_are_refused_with_the_extra_to_install(
    summer: EnvironmentSample, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sensorsim.environment.modtran.find_spec", lambda _: None)
    with pytest.raises(InputError, match=r"sensorsim\[modtran\]"):
        modtran_path(FLIR_BAND, summer, 100.0, emissive=True)
