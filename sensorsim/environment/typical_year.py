"""A typical year laid over real dates: any day of any year finds its own month, day and hour in it."""

import math
from dataclasses import replace
from datetime import date, datetime, timedelta

import numpy as np

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.environment.weather import Weather, take_samples
from sensorsim.errors import InputError

NOMINAL_YEAR = 2001  # that typical years are kept under: one without a leap day
DAYS_OF_YEAR = 365


def unroll_typical_year(weather: Weather, *, start: datetime, image_start: datetime) -> Weather:
    """Weather of a typical year from `start` to the midnight that ends the image day, with the real dates on it.

    The image day finds its own month and day. The days before it are those before it in the typical year, December
    before January; they are counted back from the image day, so that the missing leap day moves the lead-in of a
    first of March by a day against the sun, no more.

    Raises
    ------
    InputError : the image day is a leap day.
    """
    day = image_start.date()
    if (day.month, day.day) == (2, 29):
        remedy = "take 28 February or 1 March"
        raise InputError(weather.file, "image day", day.isoformat(), "a typical year has no leap day", remedy)
    days_before = (date(NOMINAL_YEAR, day.month, day.day) - date(NOMINAL_YEAR, 1, 1)).days
    lead_in = (image_start - start).total_seconds()
    begin = days_before * SECONDS_PER_DAY - lead_in  # [s] after the typical year's first midnight
    end = (days_before + 1) * SECONDS_PER_DAY
    new_year = datetime(NOMINAL_YEAR, 1, 1, tzinfo=weather.site.time_zone)
    offset = (weather.start - new_year).total_seconds()
    first = math.floor((begin - offset) / weather.interval)
    last = math.ceil((end - offset) / weather.interval) + 1  # radiation of the last hour is stamped at its end
    sample = np.arange(first, last + 1) % weather.time.size
    lies_at = first * weather.interval + offset - days_before * SECONDS_PER_DAY  # [s] after the image day's midnight
    return replace(take_samples(weather, sample, image_start + timedelta(seconds=lies_at)), typical_year=False)
