"""Air paths: closed forms of the path integral, limits, MODTRAN's slant paths, and what is refused."""

import csv
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

from sensorsim.environment import (
    AirPath,
    band_transmittance,
    clear_path,
    right_angle_phase,
    saturation_vapour_pressure,
    single_term,
)
from sensorsim.errors import InputError
from sensorsim.radiometry import FLIR_BAND, BandTable, build_band_table

AIR = 294.2  # [K] mid-latitude summer at the ground
AROUND = np.array([260.0, 297.0])  # [K] mean of the clear sky over the hemisphere, and MODTRAN's ground
LAPSE = 4.5e-3  # [K m-1] of the same up to 2 km
HUMIDITY = 14e-3 * 461.52 * AIR / float(saturation_vapour_pressure(np.array(AIR)))


@pytest.fixture(scope="module")
def table() -> BandTable:
    return build_band_table(FLIR_BAND)


def _path(**changes: Any) -> AirPath:
    values: dict[str, Any] = {
        "weight": np.array([0.6, 0.3, 0.1]),
        "coefficient": np.array([1e-4, 7e-4, 9e-3]),
        "inverse_scale_height": np.array([2e-4, 6e-4, 0.0]),
        "source": np.array([40.0, 44.0, 45.0]),
        "source_decay": 1e-4,
        "beam_source": np.zeros(3),
        "asymmetry": 0.0,
    }
    return AirPath(**{**values, **changes})


@pytest.mark.parametrize(("start", "end"), [(0.0, 0.0), (900.0, 0.0), (0.0, 5000.0), (2000.0, 1999.999), (3.0, 2.0)])
def test_transmittance_is_the_integral_of_the_density_along_the_path(start: float, end: float) -> None:
    path, distance = _path(), 6000.0
    depth = [
        quad(lambda x, k=k, inverse=inverse: k * np.exp(-inverse * (start + (end - start) * x)), 0.0, 1.0)[0]
        for k, inverse in zip(path.coefficient, path.inverse_scale_height, strict=True)
    ]
    expected = float(np.exp(-distance * np.array(depth)) @ path.weight)
    assert float(path.transmittance(distance, start, end)) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("depth", [1e-6, 1e-3, 0.0099, 0.0101, 1.0, 30.0])
def test_path_radiance_is_the_integral_of_a_source_straight_along_the_path(depth: float) -> None:
    """Rationale: radiative transfer, dL/ds = k (S - L), solved by quadrature for one term of uniform density."""
    near, far = 30.0, 42.0
    decay = float(np.log(far / near)) / 1000.0  # source at 1000 m is `near`, on the ground `far`
    path = replace(single_term(depth / 5000.0, far), source_decay=decay)
    expected = quad(lambda s: np.exp(-depth * s) * depth * (near + (far - near) * s), 0.0, 1.0)[0]
    assert float(path.apparent_radiance(0.0, 5000.0, 1000.0, 0.0)) == pytest.approx(expected, rel=2e-5)


def test_transmittance_is_the_same_there_and_back() -> None:
    path, distance = _path(), np.geomspace(1.0, 1e5, 30)
    np.testing.assert_allclose(path.transmittance(distance, 800.0, 20.0), path.transmittance(distance, 20.0, 800.0))


def test_air_of_one_radiance_hides_nothing_that_has_it() -> None:
    path = _path(source=np.full(3, 33.0), source_decay=0.0)
    seen = path.apparent_radiance(33.0, np.geomspace(0.1, 1e7, 60), 300.0, np.linspace(0.0, 4e3, 60))
    np.testing.assert_allclose(seen, 33.0, rtol=1e-14)


def test_phase_function_sends_all_it_scatters_somewhere() -> None:
    """Its integral over the sphere is 1, whatever the asymmetry."""
    cosine = np.linspace(-1.0, 1.0, 200_001)
    for asymmetry in (-0.5, 0.0, 0.65, 0.9):
        path = replace(single_term(1.0, 0.0), beam_source=np.array([right_angle_phase(asymmetry)]), asymmetry=asymmetry)
        scattered = path.apparent_radiance(0.0, 1e3, 0.0, 0.0, cosine)
        assert 2.0 * np.pi * np.trapezoid(scattered, cosine) == pytest.approx(1.0, rel=1e-6)


def _modtran(visibility: float) -> Iterator[dict[str, float]]:
    with (Path(__file__).parent / "data" / "modtran_path.csv").open(newline="") as file:
        for row in csv.DictReader(file):
            if float(row["visibility_km"]) == visibility:
                yield {name: float(value) for name, value in row.items()}


def _standard(band: str, visibility: float, table: BandTable | None) -> AirPath:
    found = band_transmittance(
        band, air_temperature=AIR, relative_humidity=HUMIDITY, visibility=1000.0 * visibility, precipitation=0.0
    )
    glow = 0.0 if table is None else float(table.radiance_at(AIR))
    cooler = 0.0 if table is None else float(table.radiance_at(AIR - 1.0))
    around = 0.0 if table is None else float(table.radiance_at(AROUND).mean())
    return AirPath(
        weight=found.weight,
        coefficient=found.coefficient,
        inverse_scale_height=found.inverse_scale_height,
        source=(1.0 - found.scattered) * glow + found.scattered * around,
        source_decay=0.0 if table is None else LAPSE * (1.0 - cooler / glow),
        beam_source=np.zeros(found.weight.size),
        asymmetry=0.0,
    )


@pytest.mark.parametrize("visibility", [23.0, 5.0])
def test_slant_paths_let_through_what_modtran_says(visibility: float, table: BandTable) -> None:
    """Expected: 0.035 in 8-14 um. In 0.8-1.1 um haze of 5 km, which MODTRAN ends at 1 km, costs up to 0.065."""
    thermal, light = _standard("FLIR", visibility, table), _standard("LLLTV", visibility, None)
    for row in _modtran(visibility):
        distance, height = 1000.0 * row["range_km"], 1000.0 * row["height_km"]
        assert abs(float(thermal.transmittance(distance, height)) - row["contrast_8_14"]) < 0.035
        assert abs(float(light.transmittance(distance, height)) - row["sunlit_08_11"]) < 0.065


@pytest.mark.parametrize("visibility", [23.0, 5.0])
def test_target_of_300_kelvin_looks_as_warm_as_through_modtrans_air(visibility: float, table: BandTable) -> None:
    """Air of one temperature, to 20 km: 0.2 K, where eq. 15 of the report is off by over 0.5 K."""
    air = float(table.radiance_at(AIR))
    standard = replace(_standard("FLIR", visibility, table), source=np.full(3, air), source_decay=0.0)
    report = single_term(-float(np.log(standard.transmittance(1000.0))) / 1000.0, air)
    target, worst = float(table.radiance_at(300.0)), {"standard": 0.0, "report": 0.0}
    for row in _modtran(visibility):
        expected = float(table.apparent_temperature(row["seen_300K_8_14"]))
        for name, path in (("standard", standard), ("report", report)):
            seen = path.apparent_radiance(target, 1000.0 * row["range_km"], 1000.0 * row["height_km"])
            worst[name] = max(worst[name], abs(float(table.apparent_temperature(seen)) - expected))
    assert worst["standard"] < 0.2
    assert worst["report"] > 0.5


@pytest.mark.parametrize("visibility", [23.0, 5.0])
@pytest.mark.parametrize("height", [1.0, 2.0])
def test_path_radiance_from_a_kilometre_up_is_modtrans(visibility: float, height: float, table: BandTable) -> None:
    """Heights at which the tables' layers end, so that air at the sensor has its own temperature; 0.5 K to 20 km."""
    path, target = _standard("FLIR", visibility, table), float(table.radiance_at(300.0))
    for row in _modtran(visibility):
        if row["height_km"] == height:
            seen = path.apparent_radiance(target, 1000.0 * row["range_km"], 1000.0 * height)
            expected = table.apparent_temperature(row["table_300K_8_14"])
            assert abs(float(table.apparent_temperature(seen) - expected)) < 0.5


@pytest.mark.parametrize(
    ("entry", "value"),
    [
        ("weight", np.array([0.6, 0.3, 0.2])),
        ("weight", np.array([0.6, 0.4])),
        ("coefficient", np.array([1e-4, np.nan, 1e-3])),
        ("coefficient", np.array([1e-4, -1e-4, 1e-3])),
        ("source", np.array([np.inf, 0.0, 0.0])),
        ("asymmetry", 1.0),
        ("source_decay", np.nan),
    ],
)
def test_impossible_air_is_refused_by_name(entry: str, value: Any) -> None:
    with pytest.raises(InputError, match="air path"):
        _path(**{entry: value})


def test_five_terms_are_refused() -> None:
    with pytest.raises(InputError, match="1 to 4"):
        _path(**{name: np.full(5, 0.2) for name in ("weight", "coefficient", "inverse_scale_height", "source")},
              beam_source=np.zeros(5))  # fmt: skip


def test_no_air_is_seen_through_from_any_height() -> None:
    np.testing.assert_array_equal(clear_path().transmittance(np.array([0.0, 1e9]), 1e4, 0.0), 1.0)
