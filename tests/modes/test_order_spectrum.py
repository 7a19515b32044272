import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from synthetic_shapes import equidistant, shape

from statorhom.errors import IdentificationError
from statorhom.modes.order_spectrum import order_spectrum


@pytest.mark.parametrize("count", [5, 8, 24, 36])
def test_full_grid_gives_the_fft(count):
    rng = np.random.default_rng(count)
    radial = rng.normal(size=(3, count)) + 1j * rng.normal(size=(3, count))
    spectrum = order_spectrum(radial, equidistant(count))
    transform = np.fft.fft(radial, axis=1) / count
    for order in range(1, (count + 1) // 2):
        plus, minus = transform[:, order], transform[:, -order]
        assert np.allclose(spectrum.cosine[:, order], plus + minus)
        assert np.allclose(spectrum.sine[:, order], 1j * (plus - minus))
    assert np.allclose(spectrum.cosine[:, 0], transform[:, 0])
    assert spectrum.unexplained_share == pytest.approx(0.0, abs=1e-12)
    assert spectrum.shares.sum() == pytest.approx(1.0)


def test_shares_of_a_known_mixture():
    angles = equidistant(24)
    mixture = shape(2, 0, angles, factor=2.0) + shape(5, 0, angles, factor=1j)
    spectrum = order_spectrum(mixture, angles)
    assert spectrum.share(2) == pytest.approx(0.8)
    assert spectrum.share(5) == pytest.approx(0.2)
    assert spectrum.dominant_order == 2


@given(
    order=st.integers(0, 12),
    steps=st.integers(-30, 30),
    exponent=st.integers(-200, 150),
    phase=st.floats(0, 6.28),
    seed=st.integers(0, 99),
)
@settings(deadline=None, max_examples=40)
def test_rotation_and_scale_leave_the_shares(order, steps, exponent, phase, seed):
    angles = equidistant(24)
    noise = 0.05 * np.random.default_rng(seed).normal(size=(4, 24))
    radial = shape(order, 0, angles) + noise
    turned = np.roll(radial, steps, axis=1) * 10.0**exponent * np.exp(1j * phase)
    assert np.allclose(order_spectrum(turned, angles).shares, order_spectrum(radial, angles).shares)


@given(order=st.integers(1, 11), rotation=st.floats(-7, 7))
@settings(deadline=None, max_examples=30)
def test_rotation_of_the_grid_changes_only_the_phase(order, rotation):
    angles = equidistant(24)
    radial = shape(order, 1, angles)
    spectrum, turned = order_spectrum(radial, angles), order_spectrum(radial, angles + rotation)
    before = spectrum.cosine[:, order] + 1j * spectrum.sine[:, order]
    after = turned.cosine[:, order] + 1j * turned.sine[:, order]
    assert np.allclose(after, before * np.exp(1j * order * rotation))
    assert np.allclose(turned.shares, spectrum.shares)


@given(order=st.integers(0, 6), seed=st.integers(0, 10_000), lost=st.floats(0.05, 0.4))
@settings(deadline=None, max_examples=40)
def test_missing_points_keep_the_order(order, seed, lost):
    rng, angles = np.random.default_rng(seed), equidistant(24)
    noisy = shape(order, 0, angles) * (1 + 0.02 * rng.normal(size=(4, 24))) + 0.01 * rng.normal(size=(4, 24))
    noisy[rng.random((4, 24)) < lost] = np.nan
    spectrum = order_spectrum(noisy, angles)
    assert spectrum.dominant_order == order
    assert spectrum.share(order) > 0.95
    assert spectrum.lookalikes == ()


def test_repeated_points_are_averaged():
    angles = equidistant(12)
    radial = shape(3, 0, angles)
    twice = np.hstack([radial + 0.1, radial - 0.1])
    spectrum = order_spectrum(twice, np.concatenate([angles, angles + 2 * np.pi]))
    single = order_spectrum(radial, angles)
    assert np.allclose(spectrum.cosine, single.cosine)
    assert np.allclose(spectrum.sine, single.sine)
    assert spectrum.unexplained_share == pytest.approx(0.01 / (0.01 + np.mean(radial**2)))


def test_uneven_angles_are_fitted():
    angles = np.array([0.0, 0.6, 1.55, 2.3, 3.3, 4.1, 5.05, 5.9])
    spectrum = order_spectrum(shape(2, 0, angles), angles)
    assert spectrum.dominant_order == 2
    assert spectrum.share(2) == pytest.approx(1.0)
    assert spectrum.aliases(2) == ()


def test_an_order_beyond_the_grid_is_refused_and_its_aliases_are_said():
    angles = equidistant(8)
    spectrum = order_spectrum(shape(5, 0, angles), angles)
    assert spectrum.highest_order == 4
    assert spectrum.dominant_order == 3  # five waves on eight points cannot look otherwise …
    assert spectrum.aliases(3) == (5, 11)  # … and the spectrum says so
    with pytest.raises(IdentificationError, match=r"order 5 cannot be told at 8 angles.*11 or more"):
        spectrum.share(5)


def test_half_the_number_of_angles_is_seen_in_one_phase_at_any_offset():
    angles = equidistant(8) + 0.2
    spectrum = order_spectrum(np.cos(4 * (angles - 0.2)), angles)
    assert spectrum.share(4) == pytest.approx(1.0)
    assert spectrum.cosine[0, 4] == pytest.approx(np.cos(0.8))
    assert spectrum.sine[0, 4] == pytest.approx(np.sin(0.8))
    assert spectrum.aliases(4) == (12, 20)


def test_few_points_on_a_wide_gap_confess_their_lookalikes():
    angles = np.deg2rad([0.0, 4.0, 8.0, 12.0, 16.0, 20.0, 24.0])
    assert order_spectrum(np.cos(2 * angles), angles).lookalikes


def test_one_point_per_plane_tells_no_order():
    radial = np.where(np.eye(6) > 0, 1.0, np.nan)
    assert order_spectrum(radial, equidistant(6)).lookalikes == (1, 2, 3)


def test_signed_amplitudes_follow_the_axis_whatever_the_phases():
    angles = equidistant(24)
    radial = shape(3, 1, angles, factor=7 * np.exp(1.1j))
    along = order_spectrum(radial, angles).signed_amplitudes(3)
    expected = 7 * np.cos(np.pi * np.array([0.05, 0.35, 0.65, 0.95]))
    assert np.allclose(along * np.sign(along[0]), expected)


def test_a_poor_plane_is_fitted_by_the_strongest_order_and_a_dead_one_left_out():
    angles = equidistant(24)
    radial = shape(2, 1, angles)
    radial[3, 5:] = np.nan
    radial[1, :] = np.nan
    along = order_spectrum(radial, angles).signed_amplitudes(2)
    assert np.isnan(along[1])
    assert along[3] == pytest.approx(-along[0])


def test_what_no_order_explains_is_reported():
    angles = equidistant(24)
    repeated = np.concatenate([angles, angles])
    radial = np.concatenate([np.cos(2 * angles) + 1.0, np.cos(2 * angles) - 1.0])
    assert order_spectrum(radial, repeated).unexplained_share == pytest.approx(2 / 3)


@pytest.mark.parametrize(
    ("radial", "angles", "message"),
    [
        (np.zeros((2, 6)), equidistant(6), "no radial motion"),
        (np.ones((2, 5)), equidistant(6), "as many angles as columns"),
        (np.ones(6), [0, 1, 2, 3, np.nan, 5], "not a number"),
        (np.full((2, 6), np.nan), equidistant(6), "0 different angles"),
        ([[1.0, np.nan, -1.0, np.nan], [np.nan, 1.0, np.nan, -1.0]], equidistant(4), "no plane"),
    ],
)
def test_bad_shapes_are_refused(radial, angles, message):
    with pytest.raises(IdentificationError, match=message):
        order_spectrum(radial, angles)


def test_results_cannot_be_changed():
    spectrum = order_spectrum(shape(2, 0, equidistant(8)), equidistant(8))
    with pytest.raises(ValueError, match="read-only"):
        spectrum.cosine[0, 0] = 1.0
    with pytest.raises(ValueError, match="read-only"):
        spectrum.shares[0] = 1.0
