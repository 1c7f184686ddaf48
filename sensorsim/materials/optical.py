"""Reflectance in a sensor's band from the solar reflectance that a material word gives."""

from sensorsim.errors import InputError
from sensorsim.materials.material import Material

HIGHEST_REFLECTANCE = 0.95  # [-], the brightest real surfaces in 0.8-1.1 um, such as fresh snow [Meerdink2019]


def nir_reflectance(material: Material, solar_reflectance: float) -> float:
    """Reflectance in 0.8-1.1 um [-] of a surface of `material` that reflects `solar_reflectance` of the sun [-].

    A word gives one number for the whole solar spectrum; its shape is the material's. So the material's own
    near-infrared reflectance is scaled by the surface's solar reflectance over the material's: brick at 0.40 instead
    of 0.24 is 1.67 times as bright there as the measured brick, and leaves stay far brighter than their solar mean.
    The product is held to [0, 0.95], since a ratio knows nothing of the energy law. A material that reflects no sun
    at all has no shape to scale and counts as grey. Raises InputError unless solar_reflectance is from 0 to 1.
    """
    if not 0.0 <= solar_reflectance <= 1.0:
        problem, remedy = "not a number from 0 to 1", "give the percent of the material word over 100"
        raise InputError("material word", f"material {material.code} reflectance", solar_reflectance, problem, remedy)
    own = material.solar_reflectance
    scaled = material.reflectance_nir.value * solar_reflectance / own if own > 1e-9 else solar_reflectance
    return min(scaled, HIGHEST_REFLECTANCE)
