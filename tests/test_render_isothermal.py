"""The furnace test: where everything has one temperature, no sensor can tell anything from anything."""

from dataclasses import replace

import numpy as np
import pytest
from small_world import town

from sensorsim.environment import AirPath
from sensorsim.render import Illumination, Renderer, World, look_at
from sensorsim.render.illumination import SKY_ENTRIES
from sensorsim.sensor import load_sensor
from sensorsim.tables.straighten import UNBENT

SIZE = (80, 60)
VIEWS = (
    look_at([-150.0, -140.0, 60.0], [0.0, 0.0, 5.0], 50.0),
    look_at([0.0, -8000.0, 30.0], [0.0, 0.0, 40.0], 5.0),
    look_at([20.0, 0.0, 900.0], [20.0, 0.0, 0.0], 60.0),
)


def _world(temperature: float, emissivity: float | None) -> World:
    """The town with tables of one temperature [K] whatever the sun does, and of one emissivity, if given."""
    world = town()
    lobes = world.tables.lobes
    assert lobes is not None
    tables = replace(
        world.tables,
        coefficients=np.zeros_like(world.tables.coefficients),
        level=np.full_like(world.tables.level, temperature),
        loss=np.broadcast_to(UNBENT, world.tables.loss.shape),
        lobes=replace(lobes, weight=np.zeros_like(lobes.weight)),
        ground_temperature=np.full_like(world.tables.ground_temperature, temperature),
    )
    assignment = world.assignment
    if emissivity is not None:
        assignment = replace(assignment, emissivity=np.full_like(assignment.emissivity, emissivity))
    return replace(world, tables=tables, assignment=assignment)


def _air(radiance: float, attenuation: float) -> AirPath:
    """Three terms that thin out with height, all of one radiance [W m-2 sr-1]."""
    return AirPath(
        weight=np.array([0.7, 0.23, 0.07]),
        coefficient=attenuation * np.array([1.0, 4.0, 100.0]),
        inverse_scale_height=np.array([1e-4, 5e-4, 2e-3]),
        source=np.full(3, radiance),
        source_decay=0.0,
        beam_source=np.zeros(3),
        asymmetry=0.65,
    )


def _surroundings(radiance: float, attenuation: float) -> Illumination:
    """Sky, ground and air all of one radiance [W m-2 sr-1]."""
    return Illumination(
        sun_direction=np.array([0.0, -0.6, 0.8]),
        beam=0.0,
        quadrant=np.zeros(4),
        sky=np.full(SKY_ENTRIES, radiance),
        ground_radiance=radiance,
        air=_air(radiance, attenuation),
    )


@pytest.mark.parametrize("temperature", [233.0, 288.15, 330.0])
@pytest.mark.parametrize("emissivity", [None, 0.0, 0.05, 0.5, 1.0])
def test_isothermal_scene_is_featureless(temperature: float, emissivity: float | None) -> None:
    """Rationale: in an enclosure of one temperature, every ray has its blackbody's radiance, by Kirchhoff's law.

    Expected: 1 mK at any emissivity, over ranges from metres to eight kilometres, through clear air and fog.
    """
    with Renderer(_world(temperature, emissivity), load_sensor("flir"), size=SIZE) as renderer:
        table = renderer.band_table
        assert table is not None
        radiance = float(table.radiance_at(temperature))
        for attenuation in (0.0, 2e-4, 0.02):
            for view in VIEWS:
                picture = renderer.render(view, 36000.0, illumination=_surroundings(radiance, attenuation))
                assert np.any(picture.planes["surface_id"] >= 0)
                assert np.abs(picture.planes["apparent_temperature"] - temperature).max() < 1e-3
                assert np.ptp(picture.planes["display"].astype(int)) <= 1  # middle grey, no rounding shown as a scene


def test_one_warmer_surface_stands_out_of_an_isothermal_scene_by_its_emissivity() -> None:
    """So that the furnace is known to be able to fail."""
    world = _world(288.15, 0.9)
    coefficients = world.tables.coefficients.copy()
    coefficients[:, world.assignment.wall_type[-1], :, 0] += 1.0
    warmer = replace(world, tables=replace(world.tables, coefficients=coefficients))
    with Renderer(warmer, load_sensor("flir"), size=SIZE) as renderer:
        table = renderer.band_table
        assert table is not None
        around = _surroundings(float(table.radiance_at(288.15)), 0.0)
        apparent = renderer.render(VIEWS[0], 36000.0, illumination=around).planes["apparent_temperature"]
    assert apparent.max() == pytest.approx(289.05, abs=0.02)
    assert np.median(apparent) == pytest.approx(288.15, abs=1e-3)
