"""Four quarters of the sky share the diffuse light."""

import numpy as np

from sensorsim.environment import circumsolar_share, quadrant_irradiance

# Azimuth of the sun [deg], extraterrestrial and beam [W m-2], irradiance from the N, E, S, W quarters of a clear sky
# after [Perez1993] [W m-2], Fairborn 1976: 7 February, 3 September and 7 October at several hours (pvlib 0.16.1 and the
# all-weather coefficients as in Radiance's gendaylit).
PEREZ = np.array(
    [
        (135.317, 1405.261, 749.321, 8.606, 19.734, 20.025, 8.602),
        (182.860, 1405.261, 871.405, 11.274, 12.229, 39.016, 12.795),
        (228.823, 1405.261, 707.614, 8.101, 8.163, 16.465, 19.520),
        (240.222, 1405.261, 459.644, 5.293, 5.560, 7.470, 12.442),
        (88.213, 1342.724, 225.082, 6.865, 17.139, 6.718, 6.026),
        (122.520, 1342.724, 744.526, 16.538, 54.806, 34.281, 15.755),
        (191.320, 1342.724, 805.615, 17.644, 22.912, 67.590, 29.390),
        (248.727, 1342.724, 684.179, 15.556, 14.271, 24.265, 54.151),
        (100.141, 1368.550, 49.622, 1.271, 2.907, 1.408, 1.211),
        (135.384, 1368.550, 754.495, 13.011, 34.301, 34.897, 13.018),
        (192.501, 1368.550, 817.658, 13.921, 16.482, 56.606, 21.616),
        (251.804, 1368.550, 389.757, 7.132, 7.278, 9.407, 21.540),
    ]
)


def _shares(share: np.ndarray, azimuth: np.ndarray) -> np.ndarray:
    return quadrant_irradiance(np.ones(azimuth.shape), azimuth, share)


def test_quarters_sum_to_the_diffuse_and_none_is_negative() -> None:
    rng = np.random.default_rng(1)
    diffuse, azimuth, share = rng.uniform(0, 500, 999), rng.uniform(-360, 720, 999), rng.uniform(0, 1, 999)
    parts = quadrant_irradiance(diffuse, azimuth, share)
    assert parts.min() >= 0.0
    np.testing.assert_allclose(parts.sum(axis=-1), diffuse, rtol=1e-14)


def test_symmetric_sun_gives_symmetric_quarters() -> None:
    share = np.full(4, 0.4)
    south = quadrant_irradiance(np.full(4, 100.0), np.array([180.0, 170.0, 190.0, 135.0]), share)
    np.testing.assert_allclose(south[0, 1], south[0, 3])  # due south: east as west
    np.testing.assert_allclose(south[1, [0, 1, 2, 3]], south[2, [0, 3, 2, 1]])  # mirrored at the meridian
    np.testing.assert_allclose(south[3, 1], south[3, 2])  # south-east: east as south
    turned = quadrant_irradiance(np.full(4, 100.0), np.array([270.0, 260.0, 280.0, 225.0]), share)
    np.testing.assert_allclose(turned, np.roll(south, 1, axis=-1))


def test_no_beam_means_a_uniform_sky() -> None:
    share = circumsolar_share(np.zeros(3), np.full(3, 1360.0))
    np.testing.assert_array_equal(share, 0.0)
    np.testing.assert_allclose(quadrant_irradiance(np.full(3, 80.0), np.array([0.0, 77.0, 200.0]), share), 20.0)


def test_share_lies_closer_to_the_all_weather_sky_than_the_anisotropy_index_itself() -> None:
    azimuth, extraterrestrial, beam, parts = PEREZ[:, 0], PEREZ[:, 1], PEREZ[:, 2], PEREZ[:, 3:]
    expected = parts / parts.sum(axis=-1, keepdims=True)
    ours = _shares(circumsolar_share(beam, extraterrestrial), azimuth) - expected
    hay_davies = _shares(beam / extraterrestrial, azimuth) - expected
    uniform = 0.25 - expected
    assert np.sqrt(np.mean(ours**2)) < 0.025
    assert np.abs(ours).max() < 0.07
    assert np.sqrt(np.mean(ours**2)) < np.sqrt(np.mean(hay_davies**2)) / 2.0 < np.sqrt(np.mean(uniform**2)) / 2.0
