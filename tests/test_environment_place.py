"""Weather of another place, or with a clock that cannot be right, does not pass for the scene's."""

from dataclasses import replace

import pytest

from sensorsim.environment import Site, check_place, great_circle_distance, place_mismatch, read_weather
from sensorsim.environment.place_check import require_clock
from sensorsim.errors import InputError

OHARE = Site(name="Chicago O'Hare", longitude=-87.92, latitude=41.98, altitude=201.0, utc_offset=-6.0)


@pytest.mark.parametrize(
    ("there", "kilometres"),
    [((-87.92, 41.98), 0.0), ((-87.92, 42.98), 111.2), ((92.08, -41.98), 20015.1), ((-84.02, 39.82), 405.7)],
)
def test_distance_is_that_along_a_great_circle(there: tuple[float, float], kilometres: float) -> None:
    found = great_circle_distance(OHARE.longitude, OHARE.latitude, *there)
    assert found / 1000.0 == pytest.approx(kilometres, abs=1.0)
    assert great_circle_distance(*there, OHARE.longitude, OHARE.latitude) == pytest.approx(found, abs=1e-6)


def test_date_line_does_not_part_neighbours() -> None:
    assert great_circle_distance(179.9, 0.0, -179.9, 0.0) < 23_000.0


def test_weather_of_the_scene_passes() -> None:
    site = read_weather("winter").site
    assert place_mismatch(site, -84.02, 39.82, utc_offset=-5.0) is None
    check_place(site, -84.5, 39.5, utc_offset=-5.0)


def test_weather_from_far_away_is_told_and_refused() -> None:
    text = place_mismatch(OHARE, -84.02, 39.82)
    assert text is not None
    assert "406 km away from 39.82 N, -84.02 E" in text
    assert "Chicago" in text
    with pytest.raises(InputError, match="406 km away"):
        check_place(OHARE, -84.02, 39.82)
    assert place_mismatch(OHARE, -84.02, 39.82, farthest=500_000.0) is None


def test_other_clock_is_told_even_nearby() -> None:
    text = place_mismatch(OHARE, -87.9, 42.0, utc_offset=-5.0)
    assert text is not None
    assert "UTC-6" in text
    assert "UTC-5" in text


def test_place_that_is_no_number_never_passes() -> None:
    assert place_mismatch(OHARE, float("nan"), 42.0) is not None


@pytest.mark.parametrize("change", [{"longitude": 87.92}, {"utc_offset": 6.0}, {"longitude": 0.0}])
def test_lost_sign_in_longitude_or_clock_is_refused(change: dict[str, float]) -> None:
    require_clock("file", OHARE)
    with pytest.raises(InputError, match="check both signs"):
        require_clock("file", replace(OHARE, **change))


@pytest.mark.parametrize(
    ("longitude", "latitude", "offset"),
    [(73.6, 39.5, 8.0), (-157.4, 1.9, 14.0), (-8.9, 42.2, 1.0), (0.0, -90.0, 12.0), (77.2, 28.6, 5.5)],
)
def test_clocks_that_are_odd_but_real_pass(longitude: float, latitude: float, offset: float) -> None:
    require_clock("file", Site(name="", longitude=longitude, latitude=latitude, altitude=0.0, utc_offset=offset))
