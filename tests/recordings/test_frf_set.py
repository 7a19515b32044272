"""Sets of frequency response functions."""

import numpy as np
import pytest

from statorhom.recordings.dof import Dof
from statorhom.recordings.frf_set import FrfSet


def test_receptance_of_a_mass_is_minus_one_over_omega_squared_m():
    frequency = np.array([0.0, 10.0, 20.0])
    frf = FrfSet(frequency, (Dof(1),), (Dof(2),), np.full((1, 3), 1 / 4.0 + 0j))
    expected = -1 / (4.0 * (2 * np.pi * frequency[1:]) ** 2)
    np.testing.assert_allclose(frf.receptance[0, 1:], expected)
    assert np.isnan(frf.receptance[0, 0])


def test_rows_must_fit_the_pairs():
    with pytest.raises(ValueError, match="one row per FRF"):
        FrfSet(np.arange(3.0), (Dof(1),), (Dof(2),), np.zeros((2, 3), complex))
