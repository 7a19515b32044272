import numpy as np
import pytest
from synthetic_shapes import equidistant, shape

from statorhom.modes.circumferential_grid import find_grid
from statorhom.modes.order_fit import fit_orders, lookalikes


def _columns(angles):
    return find_grid(angles).columns(angles)


def test_two_orders_are_recovered_exactly_from_half_the_points():
    angles = equidistant(24)
    radial = (shape(2, 0, angles) + 0.3 * shape(5, 0, angles)).astype(complex)
    radial[:, [1, 2, 5, 7, 8, 12, 13, 17, 19, 22]] = np.nan
    fit = fit_orders(radial, _columns(angles), np.ones(4, dtype=bool))
    assert np.abs(fit.amplitudes[:, 2]) == pytest.approx(np.abs(np.tile([np.cos(0.4), np.sin(0.4)], (4, 1))))
    assert fit.residual == pytest.approx(np.zeros(4), abs=1e-20)


def test_lookalikes_need_missing_points():
    angles = equidistant(12)
    radial = shape(2, 0, angles).astype(complex)
    rich = np.ones(4, dtype=bool)
    full = fit_orders(radial, _columns(angles), rich)
    assert lookalikes(full, _columns(angles), np.isfinite(radial), 2) == ()
    radial[:, 1::2] = np.nan  # six points of twelve: 2 and 6 − 2 are the same
    half = fit_orders(radial, _columns(angles), rich)
    assert lookalikes(half, _columns(angles), np.isfinite(radial), 2) == (4,)
