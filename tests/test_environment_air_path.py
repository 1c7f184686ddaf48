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
from sensorsim.environment.haze import Haze
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
        haze=found.haze,
        source=(1.0 - found.scattered) * glow + found.scattered * around,
        source_decay=0.0 if table is None else LAPSE * (1.0 - cooler / glow),
        beam_source=np.zeros(found.weight.size),
        asymmetry=0.0,
    )


def _as_long_as_told(rows: list[dict[str, float]]) -> list[dict[str, float]]:
    """Rows whose path is no shorter than its range says.

    The tables' angles are those of a flat earth. Low and far, their paths end short: in the clear window at 1.05 um,
    where every kilometre dims alike, they lose less per kilometre than near ones of the same height.
    """
    loss = {(row["height_km"], row["range_km"]): -np.log(row["window_105"]) / row["range_km"] for row in rows}
    near = {height: loss[height, min(r for h, r in loss if h == height)] for height, _ in loss}
    return [row for row in rows if loss[row["height_km"], row["range_km"]] > 0.97 * near[row["height_km"]]]


@pytest.mark.parametrize("visibility", [23.0, 5.0])
def test_slant_paths_let_through_what_modtran_says(visibility: float, table: BandTable) -> None:
    """From 75 m to 2 km high, to 20 km: 0.019 in 8-14 um, 0.0175 of sunlit scenes in 0.8-1.1 um.

    Sunlight off the ground has lost the middles of its lines, finer than the tables' steps of 10 nm; by MODTRAN's own
    reflected radiance up to 0.04 more of it comes through.
    """
    thermal, light = _standard("FLIR", visibility, table), _standard("LLLTV", visibility, None)
    rows = list(_modtran(visibility))
    held = _as_long_as_told(rows)
    assert {(row["height_km"], row["range_km"] > 10.1) for row in rows if row not in held} <= {(0.075, True)}
    for row in held:
        distance, height = 1000.0 * row["range_km"], 1000.0 * row["height_km"]
        through = float(light.transmittance(distance, height))
        assert abs(float(thermal.transmittance(distance, height)) - row["contrast_8_14"]) < 0.019
        assert abs(through - row["sunlit_08_11"]) < 0.0175
        assert -0.045 < through - row["reflected_08_11"] < 0.0


def test_tables_below_a_kilometre_shine_at_the_temperature_of_a_kilometre_up() -> None:
    """Why their own path radiance is no measure there. Where air is opaque, a sensor sees the air at its lens.

    At 4.26 um that is 289.7 K for sensors at 75, 225, 500 and 1000 m alike, where the mid-latitude summer has 293.9,
    293.2, 292.0 and 289.7 K; at 2 km it is the air's own 285.2 K. And straight down, the mean of all air in between is
    that of the whole kilometre, 291.8 K, also for the lowest 75 m.
    """
    for row in _modtran(23.0):
        assert row["opaque_K"] == pytest.approx(285.2 if row["height_km"] == 2.0 else 289.7, abs=0.1)
        if row["height_km"] <= 1.0 and row["range_km"] == row["height_km"]:
            assert row["window_K"] == pytest.approx(291.8, abs=0.05)


@pytest.mark.parametrize("visibility", [23.0, 5.0])
def test_target_of_300_kelvin_is_as_warm_as_through_modtrans_spectra_and_temperatures(
    visibility: float, table: BandTable
) -> None:
    """Air that emits by its own temperature at every height, from 75 m to 2 km, to 20 km: 0.25 K.

    Expected: the tables' transmittance at 10 nm, with the source going straight from that at the sensor to that at the
    ground, as the summer's profile has them; without scattering, which that sum does not know.
    """
    ground = float(table.radiance_at(AIR))
    path = replace(_standard("FLIR", visibility, table), source=np.full(3, ground))
    target = float(table.radiance_at(300.0))
    for row in _modtran(visibility):
        seen = path.apparent_radiance(target, 1000.0 * row["range_km"], 1000.0 * row["height_km"])
        expected = float(table.apparent_temperature(row["layered_300K_8_14"]))
        assert abs(float(table.apparent_temperature(seen)) - expected) < 0.25


@pytest.mark.parametrize(("below", "above"), [(0.0, 2.5e-3), (4.7e-4, 4.7e-4), (1e-3, 0.0), (0.0, 0.0)])
@pytest.mark.parametrize(
    ("start", "end"),
    [(0.0, 0.0), (0.0, 900.0), (300.0, 2500.0), (2500.0, 300.0), (1500.0, 3000.0), (1000.0, 1000.0), (1000.0, 0.0)],
)
def test_haze_on_a_path_is_the_integral_of_its_density(below: float, above: float, start: float, end: float) -> None:
    haze = Haze(extinction=1e-4, below=below, above=above)
    middle = (np.arange(200_000) + 0.5) / 200_000
    expected = float(np.mean(haze.density(start + (end - start) * middle)))
    assert float(haze.mean_density(start, end)) == pytest.approx(expected, rel=1e-6)
    path = replace(_path(), haze=haze)
    np.testing.assert_allclose(path.transmittance(4e3, start, end), path.transmittance(4e3, end, start), rtol=1e-12)
    clear = _path()._depth(4e3, start, end)
    np.testing.assert_allclose(path._depth(4e3, start, end) - clear, 4e3 * 1e-4 * expected, rtol=1e-5)


def test_thick_haze_ends_with_the_mixed_layer_and_thin_haze_does_not() -> None:
    """[LOWTRAN7]: at 5 km visibility as thick at one kilometre as at the ground, a twelfth at two."""
    thick, thin = (_standard("LLLTV", visibility, None).haze for visibility in (5.0, 23.0))
    np.testing.assert_allclose(thick.density([500.0, 1000.0, 2000.0]), [1.0, 1.0, 0.0807], rtol=1e-2)
    np.testing.assert_allclose(thin.density([1000.0, 2000.0]), [0.627, 0.393], rtol=1e-2)


@pytest.mark.parametrize("visibility", [50.0, 23.0, 5.0])
@pytest.mark.parametrize("height", [-3.0, 0.0, 0.5, 2.0, 75.0, 999.0, 1001.0, 3000.0, 30e3])
def test_air_as_a_camera_takes_it_has_the_depth_of_haze_and_gases_to_the_ground(
    visibility: float, height: float
) -> None:
    """Expected: exact down to the ground; to a roof of 40 m 0.1 % of the depth within the haze, 5 % from above it."""
    path, distance = _standard("LLLTV", visibility, None), float(np.hypot(3e3, height))
    seen = path.seen_from(height)
    assert seen.haze.extinction == 0.0
    np.testing.assert_allclose(seen._depth(distance, height, 0.0), path._depth(distance, height, 0.0), rtol=1e-7)
    allowed = 1e-3 if height < 1e3 or visibility > 5.0 else 0.05
    np.testing.assert_allclose(seen._depth(distance, height, 40.0), path._depth(distance, height, 40.0), rtol=allowed)


@pytest.mark.parametrize("entry", ["extinction", "below", "above"])
@pytest.mark.parametrize("value", [-1e-9, np.nan, np.inf])
def test_impossible_haze_is_refused_by_name(entry: str, value: float) -> None:
    with pytest.raises(InputError, match=entry):
        Haze(**{"extinction": 1e-4, "below": 0.0, "above": 0.0, entry: value})


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
