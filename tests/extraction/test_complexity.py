"""Phase collinearity and the real shape, for shapes whose answer is known."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.extraction.complexity import in_phase, phase_collinearity, real_shape

ANGLES = 2 * np.pi * np.arange(12) / 12


def test_a_turned_real_shape_is_collinear_and_found_again() -> None:
    shape = np.cos(2 * ANGLES) + 0.2
    turned = shape * np.exp(2.1j)
    assert phase_collinearity(turned) == pytest.approx(1.0)
    np.testing.assert_allclose(real_shape(turned), shape, atol=1e-12)


def test_a_travelling_wave_is_not_collinear() -> None:
    assert phase_collinearity(np.exp(2j * ANGLES)) == pytest.approx(0.0, abs=1e-12)


def test_missing_points_do_not_matter() -> None:
    shape = np.cos(2 * ANGLES) * (1 + 0.1j)
    shape[3] = np.nan
    assert phase_collinearity(shape) == pytest.approx(1.0)
    assert np.isnan(in_phase(shape)[3])
