"""Planck's law, radiance within a sensor's band, and the apparent temperature that belongs to a band radiance."""

from sensorsim.radiometry.bands import (
    FLIR_BAND,
    LLLTV_BAND,
    SOLAR_BAND,
    THERMAL_BAND,
    BandTable,
    SpectralBand,
    band_quadrature,
    band_radiance,
    band_radiance_derivative,
    build_band_table,
    flat_band,
)
from sensorsim.radiometry.planck import FloatArray, spectral_radiance, spectral_radiance_derivative

__all__ = [
    "FLIR_BAND",
    "LLLTV_BAND",
    "SOLAR_BAND",
    "THERMAL_BAND",
    "BandTable",
    "FloatArray",
    "SpectralBand",
    "band_quadrature",
    "band_radiance",
    "band_radiance_derivative",
    "build_band_table",
    "flat_band",
    "spectral_radiance",
    "spectral_radiance_derivative",
]
