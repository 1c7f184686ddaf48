"""Where walls of a bake begin: each as early as it remembers, periodically where the history is shorter."""

from dataclasses import replace
from datetime import date
from functools import cache

import numpy as np
import pytest
from small_world import DAY

from sensorsim.environment import Environment, build_environment, longest_lead_in, read_weather
from sensorsim.errors import InputError
from sensorsim.materials import WallType, load_catalogue
from sensorsim.tables import BakeSettings, bake_tables, orientation_set
from sensorsim.tables.history import make_ready, solve_histories, wall_history
from sensorsim.thermal import expose, ground_temperature, surface_boundary
from sensorsim.thermal.lead_in import LEAST_STEPS, LeadIn, lead_in_of, time_constant

ABSORPTANCES = np.array([0.2, 0.9])


@cache
def weather(days: int) -> Environment:
    return build_environment(read_weather("winter"), image_day=DAY, lead_in_days=days, step=600.0)


def wall_of(code: int, interior: str) -> WallType:
    return load_catalogue().wall_type(code, interior)


def history(wall: WallType, environment: Environment, lead_in: LeadIn) -> np.ndarray:
    """Surface temperatures of an image day, on ten orientations over a ground that has settled."""
    soil = ground_temperature(environment, wall_of(93, "none"), repeated=True)
    exposure = expose(environment, orientation_set("report10").normal, soil)
    record = environment.image_window.start + np.arange(0, 145, 6)
    outside = surface_boundary(environment, exposure, wall)
    ready = replace(make_ready(environment, wall, own_lead_in=True), lead_in=lead_in)
    return wall_history(environment, outside, ready, ABSORPTANCES, record)


def whole(environment: Environment, *, repeated: bool) -> LeadIn:
    span = environment.image_window.start * environment.step
    return LeadIn(time_constant=0.0, first=0, span=span, repeated=repeated)


@pytest.mark.parametrize(
    ("code", "interior"),
    [(7, "unheated"), (12, "unheated"), (20, "heated"), (26, "heated"), (50, "heated"), (67, "heated")],
)
def test_a_wall_that_begins_late_ends_as_if_it_had_begun_long_before(code: int, interior: str) -> None:
    """To 0.01 K, against all five days after a settled start; and it does begin late where it can."""
    environment, wall = weather(5), wall_of(code, interior)
    own = lead_in_of(wall, environment, own=True)
    late = history(wall, environment, own)
    np.testing.assert_allclose(late, history(wall, environment, whole(environment, repeated=True)), rtol=0.0, atol=0.01)
    assert own.span >= min(7.6 * own.time_constant, 5 * 86400.0)
    assert own.repeated == (7.601 * own.time_constant > 5 * 86400.0)


def test_a_metal_sheet_needs_minutes_and_soil_more_than_there_is() -> None:
    environment = weather(5)
    sheet, soil = (lead_in_of(wall_of(*of), environment, own=True) for of in ((12, "unheated"), (93, "none")))
    assert not sheet.repeated
    assert LEAST_STEPS * 600.0 <= sheet.span < 3 * 3600.0
    assert soil.repeated
    assert soil.span == 5 * 86400.0
    assert soil.time_constant > 40 * 3600.0


def test_a_periodic_start_is_where_repeated_days_lead() -> None:
    """Soil after its first day, repeated 60 times one after the other: what the mode-wise limit jumps to."""
    environment, soil = weather(1), wall_of(93, "none")
    day = round(86400.0 / environment.step)
    order = np.concatenate([np.tile(np.arange(day), 60), np.arange(environment.time.size)])
    series = {
        name: getattr(environment, name)[order]
        for name in environment.__dataclass_fields__
        if isinstance(getattr(environment, name), np.ndarray)
    }
    series["time"] = np.arange(order.size) * environment.step
    settled = ground_temperature(environment, soil, repeated=True)
    long = ground_temperature(replace(environment, **series), soil)[60 * day :]
    assert np.abs(settled - long)[1:].max() < 0.03  # the deep temperature, the mean of the weather, shifts a little
    assert np.abs(settled - long)[day:].max() < 0.005
    assert np.abs(ground_temperature(environment, soil) - long)[1:].max() > 0.1  # a linear start


def test_a_lead_in_by_number_is_the_same_for_all_and_begins_linear() -> None:
    environment = weather(2)
    for wall in (wall_of(12, "unheated"), wall_of(93, "none")):
        assert lead_in_of(wall, environment, own=False) == LeadIn(
            time_constant=time_constant(wall, environment), first=0, span=2 * 86400.0, repeated=False
        )


def test_snow_and_water_begin_as_ever() -> None:
    for code in (98, 99):
        own = lead_in_of(wall_of(code, "none"), weather(2), own=True)
        assert (own.first, own.repeated) == (0, False)


def test_tables_tell_the_lead_in_of_every_wall() -> None:
    environment, walls = weather(2), (wall_of(12, "unheated"), wall_of(20, "heated"), wall_of(93, "none"))
    settings = BakeSettings(orientations="report10", step=600.0, slice_interval=3600.0)
    tables = bake_tables(environment, walls, ground=walls[2], settings=settings)
    assert tables.lead_in == tuple(lead_in_of(wall, environment, own=True) for wall in walls)
    assert [one.repeated for one in tables.lead_in] == [False, True, True]


def test_history_that_a_file_holds_is_counted_in_whole_days() -> None:
    winter = read_weather("winter")
    assert longest_lead_in(winter, DAY) == 5
    assert longest_lead_in(winter, date(1976, 2, 3)) == 1
    assert longest_lead_in(winter, date(1976, 1, 1)) == 0
    assert longest_lead_in(winter, date(1977, 1, 1)) == 10
    assert longest_lead_in(replace(winter, typical_year=True), DAY) == 10


@pytest.mark.parametrize("days", [-1.0, float("nan"), float("inf"), 400.0])
def test_lead_ins_that_cannot_be_are_refused(days: float) -> None:
    with pytest.raises(InputError, match="lead_in_days"):
        BakeSettings(lead_in_days=days)


def test_long_steps_of_the_lead_in_cost_hundredths_of_a_kelvin_and_none_is_the_march_itself() -> None:
    """Masonry remembers the days before; a sheet of metal only the short steps."""
    catalogue, weather = load_catalogue(), read_weather("winter")
    day = date(1976, 2, 7)
    environment = build_environment(weather, image_day=day, lead_in_days=3.0, step=300.0)
    normal = orientation_set("report26").normal
    exposure = expose(environment, normal, environment.air_temperature)
    record = environment.image_window.start + np.arange(0, 289, 12)
    for code, bound in ((20, 0.03), (10, 1e-4)):
        wall = catalogue.wall_type(code, "heated")
        solved = {
            stride: solve_histories(
                environment, exposure, wall, np.array([0.1, 0.6]), record,
                settings=BakeSettings(lead_in_stride=stride, lead_in_days=3.0),
            )
            for stride in (1, BakeSettings().lead_in_stride)
        }  # fmt: skip
        miss = np.abs(solved[BakeSettings().lead_in_stride] - solved[1]).max()
        assert 0.0 < miss < bound
