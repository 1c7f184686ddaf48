"""Properties of dry air that convection depends on, at a temperature and a pressure.

Viscosity (Sutherland's law), conductivity and the pressure of the standard atmosphere by [USSA1976]; within half a per
cent of tables from 200 to 400 K. Humidity changes none of them by more than a per cent outdoors.
"""

from dataclasses import dataclass

import numpy as np

from sensorsim.thermal.grid import FloatArray

GRAVITY = 9.80665  # [m s-2]
GAS_CONSTANT = 287.053  # [J kg-1 K-1] of dry air
SPECIFIC_HEAT = 1006.0  # [J kg-1 K-1] at constant pressure, 1004 to 1009 from 220 to 350 K
SEA_LEVEL_PRESSURE = 101325.0  # [Pa]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Air:
    """Air at one or many states; all arrays of one shape."""

    temperature: FloatArray  # [K]
    density: FloatArray  # [kg m-3]
    conductivity: FloatArray  # [W m-1 K-1]
    kinematic_viscosity: FloatArray  # [m2 s-1]
    prandtl: FloatArray  # [-]

    @property
    def buoyancy(self) -> FloatArray:
        """Rayleigh number per kelvin and cubic metre, g beta / (nu alpha), with beta = 1 / T [K-1 m-3]."""
        return GRAVITY * self.prandtl / (self.temperature * self.kinematic_viscosity**2)


def air_at(temperature: FloatArray | float, pressure: float = SEA_LEVEL_PRESSURE) -> Air:
    """Air at temperatures [K], any shape, and a pressure [Pa]; for a film, at the mean of surface and free air."""
    kelvin = np.asarray(temperature, dtype=np.float64)
    viscosity = 1.458e-6 * kelvin**1.5 / (kelvin + 110.4)  # [Pa s]
    conductivity = 2.64638e-3 * kelvin**1.5 / (kelvin + 245.4 * 10.0 ** (-12.0 / kelvin))
    density = pressure / (GAS_CONSTANT * kelvin)
    return Air(
        temperature=kelvin,
        density=np.asarray(density),
        conductivity=np.asarray(conductivity),
        kinematic_viscosity=np.asarray(viscosity / density),
        prandtl=np.asarray(viscosity * SPECIFIC_HEAT / conductivity),
    )


def pressure_at(altitude: float) -> float:
    """Pressure [Pa] of the standard atmosphere at an altitude [m] below 11 km [USSA1976]."""
    return float(SEA_LEVEL_PRESSURE * (1.0 - 0.0065 * altitude / 288.15) ** 5.25588)
