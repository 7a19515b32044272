import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from statorhom.modes.phase import in_phase, phase_collinearity, real_phase, real_shape


@given(st.floats(-10, 10), st.integers(0, 1000))
def test_a_turned_real_shape_is_real_again(psi, seed):
    shape = np.random.default_rng(seed).standard_normal(12)
    turned = shape * np.exp(1j * psi)
    assert phase_collinearity(turned) == pytest.approx(1.0)
    real = real_shape(turned)
    assert min(np.abs(real - shape).max(), np.abs(real + shape).max()) < 1e-9
    assert np.sin(real_phase(turned) - psi) == pytest.approx(0.0, abs=1e-9)


def test_a_travelling_wave_has_no_phase():
    angles = 2 * np.pi * np.arange(24) / 24
    assert phase_collinearity(np.exp(2j * angles)) == pytest.approx(0.0, abs=1e-12)


def test_missing_points_do_not_count():
    assert phase_collinearity([1j, np.nan, 2j]) == pytest.approx(1.0)
    assert np.isnan(phase_collinearity([0.0, 0.0]))


def test_the_largest_value_of_a_turned_shape_is_positive_and_missing_ones_stay():
    angles = 2 * np.pi * np.arange(12) / 12
    shape = np.cos(2 * angles) + 0.2
    np.testing.assert_allclose(real_shape(shape * np.exp(2.1j)), shape, atol=1e-12)
    shape[3] = np.nan
    assert np.isnan(in_phase(shape)[3])
