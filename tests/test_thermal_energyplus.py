"""Six walls against EnergyPlus on the same boundary values; data/energyplus/README.md says what was compared how."""

from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from wall_cases import DATA, SIGMA, WALLS, FloatArray, indoors, reference_walls

from sensorsim.constants import ZERO_CELSIUS
from sensorsim.thermal import Outside, march

ABSORPTANCES = np.array([0.1, 0.3, 0.5, 0.7, 0.9])
EMISSIVITY = 0.9
ENERGYPLUS_SIGMA = 5.6697e-8  # [W m-2 K-4] which that program uses
START_UP = 2 * 1440  # [min]
STRIDE = 10  # minutes between EnergyPlus's stored temperatures


@dataclass(frozen=True, slots=True, kw_only=True)
class Reference:
    """Boundary values at every minute, and stored temperatures after the start-up [K]."""

    outside: Outside
    exterior: FloatArray  # (t, wall, facing, absorptance)
    interior: FloatArray  # (t, wall, facing) at absorptance 0.7
    record: np.ndarray  # samples of the stored temperatures


@cache
def _reference() -> Reference:
    boundary = np.load(DATA / "energyplus" / "boundary_1min.npz")
    stored = np.load(DATA / "energyplus" / "temps_10min.npz")
    air = boundary["feb_Tair"].astype(np.float64) + ZERO_CELSIUS
    sky = boundary["feb_Tsky"].astype(np.float64) + ZERO_CELSIUS
    sun = sum(boundary[f"feb_{part}"].astype(np.float64) for part in ("beam", "skydif", "gnddif"))
    sky_share = np.array([0.5] * 8 + [1.0])  # eight walls and a roof
    clear = np.sqrt(sky_share)
    longwave = np.outer(sky**4, sky_share * clear) + np.outer(air**4, 1.0 - sky_share * clear)
    minutes = boundary["feb_t_min"]
    record = np.flatnonzero((minutes % STRIDE == 0) & (minutes > START_UP))
    rows = minutes[record] // STRIDE - 1
    outside = Outside(
        irradiance=np.ascontiguousarray(sun),
        longwave=SIGMA * longwave,
        film=np.full(longwave.shape, float(boundary["feb_h_out"])),
        free=np.zeros(9),
        air=air,
        emissivity=EMISSIVITY * ENERGYPLUS_SIGMA / SIGMA,
    )
    return Reference(
        outside=outside,
        exterior=25.0 + 0.002 * stored["feb_Tout"][rows] + ZERO_CELSIUS,
        interior=25.0 + 0.002 * stored["feb_Tin_a0.7"][rows] + ZERO_CELSIUS,
        record=record,
    )


@pytest.mark.parametrize("name", WALLS)
def test_wall_follows_energyplus_through_six_winter_days(name: str) -> None:
    """Rationale: an independent program, one-minute steps, nine facings, five absorptances.

    Expected: outside r.m.s. 0.02 K and 99.9 % within 0.1 K (thin steel 0.03 and 0.2), inside r.m.s. 0.02 K.
    """
    reference, wall = _reference(), WALLS.index(name)
    room = np.full(reference.outside.air.size, 293.15)
    history = march(
        reference_walls()[name],
        reference.outside,
        indoors(room, 3.08, radiant=room, emissivity=EMISSIVITY * ENERGYPLUS_SIGMA / SIGMA),
        ABSORPTANCES,
        step=60.0,
        record=reference.record,
    )
    outer = np.abs(history.exterior - reference.exterior[:, wall])
    inner = np.abs(history.interior[:, :, 3] - reference.interior[:, wall])
    rms, tail = (0.03, 0.2) if name == "steel_sheet" else (0.02, 0.1)
    assert np.sqrt(np.mean(outer**2)) < rms
    assert np.quantile(outer, 0.999) < tail
    assert np.sqrt(np.mean(inner**2)) < 0.02
