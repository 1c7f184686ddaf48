"""Conversions from the units of files to SI. Nothing inside the package uses any but SI. Source: [NIST811]."""

METRES_PER_FOOT = 0.3048
METRES_PER_MILE = 1609.344


def metres_from_feet(length: float) -> float:
    """Length [m] of a length in feet."""
    return length * METRES_PER_FOOT


def kelvin_from_celsius(temperature: float) -> float:
    """Temperature [K] of a temperature in degrees Celsius."""
    return temperature + 273.15


def kelvin_from_fahrenheit(temperature: float) -> float:
    """Temperature [K] of a temperature in degrees Fahrenheit."""
    return (temperature - 32.0) / 1.8 + 273.15
