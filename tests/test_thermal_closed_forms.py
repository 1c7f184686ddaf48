"""The march against exact solutions of conduction, each with the tolerance it is held to."""

import re

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import erfc, erfcx
from wall_cases import (
    DARK,
    SIGMA,
    WALLS,
    FloatArray,
    constant,
    exact_case,
    exact_values,
    indoors,
    outdoors,
    reference_walls,
    slab,
    uniform_grid,
)

from sensorsim.thermal import WallGrid, build_grid, march

CONDUCTIVITY, CAPACITY = 1.95, 2.016e6  # of the semi-infinite rows of conduction_exact.csv
DIFFUSIVITY = CONDUCTIVITY / CAPACITY
START = 300.0  # [K]
OPEN_FILM = 1e8  # [W m-2 K-1] as good as a prescribed face temperature
OUTER_FILM, INNER_FILM = 25.0, 1.0 / 0.13


def _deep_slab(depth: float, finest: float, ratio: float = 1.02) -> WallGrid:
    """Cells that grow from `finest` [m] by `ratio` down to `depth` [m], of the semi-infinite rows' material."""
    count = int(np.ceil(np.log1p(depth * (ratio - 1.0) / finest) / np.log(ratio)))
    size = finest * ratio ** np.arange(count)
    half = 0.5 * size / CONDUCTIVITY
    resistance = np.concatenate([half[:1], half[:-1] + half[1:], half[-1:]])
    return WallGrid(capacity=CAPACITY * size, conductance=1.0 / resistance, depth=np.cumsum(size) - 0.5 * size)


def _semi_infinite(grid: WallGrid, *, step: float, count: int, film: float, sun: float, air: float) -> FloatArray:
    """Exterior face and cells (t, 1 + n) [K] after a start at START with an adiabatic back."""
    history = march(
        [],
        outdoors(constant(air, count), film, sun=sun),
        indoors(constant(START, count), 0.0),
        np.ones(1),
        step=step,
        record=np.arange(count),
        grid=grid,
        start=constant(START, grid.capacity.size),
        keep_nodes=True,
    )
    assert history.nodes is not None
    return np.concatenate([history.exterior[:, :, 0], history.nodes[:, :, 0, 0]], axis=1)


@pytest.mark.parametrize(("time", "tolerance"), [(600.0, 1e-4), (3600.0, 1e-4)])
def test_semi_infinite_solid_follows_a_step_of_its_face(time: float, tolerance: float) -> None:
    """Rationale: erfc. Expected: 1e-4 of the step at every depth, 1e-3 of the face flux, after 100 steps."""
    jump, steps = 10.0, 100
    grid = _deep_slab(1.5, 0.02 * np.sqrt(DIFFUSIVITY * time), 1.01)
    held = _semi_infinite(grid, step=time / steps, count=steps + 1, film=OPEN_FILM, sun=0.0, air=START + jump)[-1, 1:]
    exact = START + jump * erfc(grid.depth / np.sqrt(4.0 * DIFFUSIVITY * time))
    assert np.abs(held - exact).max() < tolerance * jump
    flux = (START + jump - held[0]) * grid.conductance[0]
    assert flux == pytest.approx(CONDUCTIVITY * jump / np.sqrt(np.pi * DIFFUSIVITY * time), rel=1e-3)


@pytest.mark.parametrize("time", [60, 600, 21600])
def test_semi_infinite_solid_warms_by_the_root_of_time_under_a_flux(time: int) -> None:
    grid = _deep_slab(4.0, 0.02 * np.sqrt(DIFFUSIVITY * time))
    held = _semi_infinite(grid, step=time / 100.0, count=101, film=0.0, sun=100.0, air=START)[-1, 0]
    exact = exact_values()["semi_inf_flux", "k1.95 rc2.016e6", f"Ts_per_100Wm2_t{time}"]
    assert held - START == pytest.approx(exact, rel=1e-3)


@pytest.mark.parametrize(("parameters", "quantity", "exact"), exact_case("semi_inf_conv"))
def test_semi_infinite_solid_follows_a_step_of_the_air(parameters: str, quantity: str, exact: float) -> None:
    film, time = float(parameters.removeprefix("h=")), float(quantity.split("_t")[-1])
    grid = _deep_slab(4.0, 0.01 * np.sqrt(DIFFUSIVITY * time))
    held = _semi_infinite(grid, step=time / 200.0, count=201, film=film, sun=0.0, air=START + 10.0)[-1, 0]
    assert (held - START) / 10.0 == pytest.approx(exact, abs=1e-3)
    reach = film * np.sqrt(DIFFUSIVITY * time) / CONDUCTIVITY
    assert 1.0 - erfcx(reach) == pytest.approx(exact, abs=1e-9)


@pytest.mark.parametrize("biot", [0.1, 1.0, 10.0, 100.0])
def test_slab_between_two_films_relaxes_as_its_eigenfunctions(biot: float) -> None:
    half, conductivity, capacity = 0.1, 1.0, 1e6
    layer = [slab(2.0 * half, conductivity, 1000.0, capacity / 1000.0)]
    grid = uniform_grid(layer, [301])  # an odd number has a cell at the centre
    film, second = biot * conductivity / half, half**2 * capacity / conductivity
    step, count = 0.002 * second, 1001
    history = march(
        layer,
        outdoors(constant(START, count), film),
        indoors(constant(START, count), film),
        DARK,
        step=step,
        record=np.arange(count),
        grid=grid,
        start=constant(START + 10.0, 301),
        keep_nodes=True,
    )
    assert history.nodes is not None
    held = {"centre": history.nodes[:, 150, 0, 0], "surface": history.exterior[:, 0, 0]}
    rows = [row for row in exact_case("slab_convective") if row[0] == f"Bi={biot:g}"]
    for _, quantity, exact in rows:
        place, number = quantity.removeprefix("theta_").split("_Fo")
        if float(number) >= 0.1:
            theta = (held[place][round(float(number) / 0.002)] - START) / 10.0
            assert theta == pytest.approx(exact, abs=1e-4), quantity


def _response(name: str, seconds: list[int], *, sun: bool, step: float, fine: bool) -> tuple[FloatArray, FloatArray]:
    """Exterior and interior face [K per K, or K per 100 W m-2], seconds after a step of outdoor air or of sun."""
    layers, count = reference_walls()[name], round(max(seconds) / step) + 1
    grid = (
        uniform_grid(layers, [max(2, round(layer.thickness / 5e-4)) for layer in layers])
        if fine
        else build_grid(layers, step)
    )
    history = march(
        layers,
        outdoors(constant(START if sun else START + 50.0, count), OUTER_FILM, sun=1000.0 if sun else 0.0),
        indoors(constant(START, count), INNER_FILM),
        np.ones(1),
        step=step,
        record=np.array([round(moment / step) for moment in seconds]),
        grid=grid,
        start=constant(START, grid.capacity.size),
    )
    scale = 10.0 if sun else 50.0
    return (history.exterior[:, 0, 0] - START) / scale, (history.interior[:, 0, 0] - START) / scale


def _misses(name: str, *, step: float, time: float, fine: bool) -> dict[tuple[bool, int], float]:
    """Largest error of a wall's step responses by (sun, seconds after the step), from ten minutes to `time` [s]."""
    misses: dict[tuple[bool, int], float] = {}
    for sun, case in ((False, "step_air_outside"), (True, "step_solar_outside")):
        rows = [
            (int(re.findall(r"t(\d+)s", quantity)[0]), quantity, exact)
            for parameters, quantity, exact in exact_case(case)
            if parameters == name
        ]
        rows = [row for row in rows if 600 <= row[0] <= time]
        seconds = sorted({row[0] for row in rows})
        outer, inner = _response(name, seconds, sun=sun, step=step, fine=fine)
        for moment, quantity, exact in rows:
            held = (outer if quantity.startswith("Tso") else inner)[seconds.index(moment)]
            misses[sun, moment] = max(misses.get((sun, moment), 0.0), abs(held - exact))
    return misses


@pytest.mark.parametrize("name", WALLS)
def test_fine_wall_answers_a_step_of_air_and_of_sun_exactly(name: str) -> None:
    """Rationale: inverse Laplace transform of the transfer matrix. Expected: 1e-3 K per K at 10 min, 1e-5 at 6 h."""
    allowed = {600: 1e-3, 3600: 1e-4, 21600: 1e-5}
    for (_, seconds), miss in _misses(name, step=20.0, time=21600.0, fine=True).items():
        assert miss < allowed[seconds], seconds


@pytest.mark.parametrize("name", WALLS)
def test_default_wall_is_within_a_hundredth_of_a_kelvin_after_a_step(name: str) -> None:
    """Per 100 W m-2 of sun, and per 5 K of outdoor air, from ten minutes after the step on, at a minute's steps."""
    for (sun, seconds), miss in _misses(name, step=60.0, time=432000.0, fine=False).items():
        assert miss * (1.0 if sun else 5.0) < 0.01, (sun, seconds)


def _swings(name: str, grid: WallGrid, *, hours: int, periods: int, inner: bool) -> tuple[complex, complex]:
    """Both faces' complex amplitude per kelvin of a cosine of the outer or the inner air, over the last period."""
    per_period = 240
    count, amplitude = periods * per_period + 1, 50.0
    angle = 2.0 * np.pi * np.arange(count) / per_period
    last, wave, still = slice(count - per_period, count), START + amplitude * np.cos(angle), constant(START, count)
    history = march(
        reference_walls()[name],
        outdoors(still if inner else wave, OUTER_FILM),
        indoors(wave if inner else still, INNER_FILM),
        DARK,
        step=hours * 3600.0 / per_period,
        record=np.arange(count)[last],
        grid=grid,
    )
    turning = 2.0 * np.exp(-1j * angle[last]) / amplitude
    exterior, interior = (np.mean(face[:, 0, 0] * turning) for face in (history.exterior, history.interior))
    return complex(exterior), complex(interior)


def _compare(name: str, hours: int, held: dict[str, tuple[float, bool]]) -> None:
    """Amplitudes to 1e-3, times to a minute in a day and the same share of an hour."""
    rows = [row for row in exact_case(f"periodic_{hours}h") if row[0] == name and row[1] in held]
    assert len(rows) == len(held)
    for _, quantity, exact in rows:
        value, is_time = held[quantity]
        close = {"abs": hours / 24.0 / 60.0, "rel": 0.0} if is_time else {"rel": 1e-3, "abs": 0.0}
        assert value == pytest.approx(exact, **close), quantity


@pytest.mark.parametrize("name", WALLS)
def test_wall_transmits_and_stores_a_daily_swing_as_its_transfer_matrix(name: str) -> None:
    """Rationale: ISO 13786, complex transfer matrix. Expected: amplitudes to 1e-3, times to a minute."""
    layers = reference_walls()[name]
    grid = uniform_grid(layers, [max(2, round(layer.thickness / 1.5e-3)) for layer in layers])
    tso, tsi = _swings(name, grid, hours=24, periods=7, inner=False)
    _, tsi_inner = _swings(name, grid, hours=24, periods=7, inner=True)
    held = {
        "abs_Y12_periodic_transmittance": (abs(INNER_FILM * tsi), False),
        "abs_Y_inner_admittance": (abs(INNER_FILM * (1.0 - tsi_inner)), False),
        "abs_Tso_over_Te": (abs(tso), False),
        "time_shift_Y12": (float(-np.angle(tsi) / (2.0 * np.pi) * 24.0) % 24.0, True),
        "lead_Y_outer": (float(np.angle(1.0 - tso) / (2.0 * np.pi) * 24.0) % 24.0, True),
    }
    _compare(name, 24, held)


@pytest.mark.parametrize("name", WALLS)
def test_outside_face_follows_an_hourly_swing_as_its_transfer_matrix(name: str) -> None:
    """What an hour's swing sends through a wall is a thousandth and settles for days: only the outside is compared."""
    grid = build_grid(reference_walls()[name], 15.0, cell_size=0.4)
    tso, _ = _swings(name, grid, hours=1, periods=30, inner=False)
    held = {"abs_Tso_over_Te": (abs(tso), False), "lead_Y_outer": (float(np.angle(1.0 - tso) / (2.0 * np.pi)), True)}
    _compare(name, 1, held)


def test_steady_wall_transmits_by_its_resistance() -> None:
    for name, layers in reference_walls().items():
        count = 400
        history = march(
            layers, outdoors(constant(280.0, count), OUTER_FILM), indoors(constant(300.0, count), INNER_FILM), DARK,
            step=3600.0, record=np.array([count - 2, count - 1]),
        )  # fmt: skip
        flux = INNER_FILM * (300.0 - history.interior[-1, 0, 0])
        assert flux / 20.0 == pytest.approx(exact_values()["periodic_24h", name, "U"], rel=1e-9)


@pytest.mark.parametrize(("parameters", "exact"), [(row[0], row[2]) for row in exact_case("steady_nonlinear")])
def test_steady_radiating_wall_balances_to_1e_8_kelvin(parameters: str, exact: float) -> None:
    layers, count = reference_walls()[parameters.split()[0]], 400
    history = march(
        layers,
        outdoors(constant(263.15, count), 20.0, sun=300.0, sky=230.0, emissivity=0.9),
        indoors(constant(293.15, count), 8.29),
        np.ones(1),
        step=3600.0,
        record=np.array([count - 1]),
    )
    assert history.exterior[0, 0, 0] == pytest.approx(exact, abs=1e-8)


def _plate_temperature(capacity: float, emissivity: float, sky: float, start: float, time: float) -> float:
    """Temperature of a thin plate that radiates to a black sky, by the inverse of its cooling time."""

    def cooling_time(temperature: float) -> float:
        return quad(lambda t: capacity / (emissivity * SIGMA * (t**4 - sky**4)), temperature, start, epsabs=1e-9)[0]

    return float(brentq(lambda t: cooling_time(t) - time, sky + 1e-3, start, xtol=1e-10))


def test_thin_plate_cools_to_a_black_sky_as_its_closed_form() -> None:
    """Expected: 1e-4 K at one-second steps, and an error that falls with the square of the step."""
    plate = slab(0.0015, 1e6, 7824.0, 500.0)  # conducts so well that it has one temperature
    exact = {600: 283.013440104, 3600: 255.537325693}
    for time, value in exact.items():
        row = exact_values()["plate_radiating", "steel1.5mm eps.9 Tsky250 T0 300 sigma 5.670374419e-8", f"T_t{time}s"]
        assert row == value
        assert _plate_temperature(5868.0, 0.9, 250.0, 300.0, time) == pytest.approx(value, abs=1e-6)

    def error(step: float, time: int = 600) -> float:
        count = round(time / step) + 1
        history = march(
            [plate],
            outdoors(constant(300.0, count), 0.0, sky=250.0, emissivity=0.9),
            indoors(constant(300.0, count), 0.0),
            DARK,
            step=step,
            record=np.array([count - 1]),
        )
        return abs(float(history.exterior[0, 0, 0]) - exact[time])

    assert error(1.0) < 1e-4
    assert error(1.0, 3600) < 1e-4
    slope = np.log2(error(60.0) / error(30.0))
    assert 1.8 < slope < 2.2
