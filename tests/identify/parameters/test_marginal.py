"""The smooth map between constants and standard normal coordinates."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from statorhom.identify.parameters.marginal import Marginals
from statorhom.materials.typical_ranges import Z95


def marginals(median, below, above, logarithmic):
    scale = (lambda t: np.exp(t)) if logarithmic else (lambda t: t)
    low, mid, high = (np.array([scale(v)]) for v in (median - below, median, median + above))
    return Marginals.from_ranges(mid, low, high, np.array([logarithmic])), (low, mid, high)


half_range = st.floats(1e-2, 5.0)


@settings(deadline=None)
@given(st.floats(-2, 2), half_range, half_range, st.booleans())
def test_median_and_quantiles_are_met_and_the_map_rises_and_inverts(median, below, above, logarithmic):
    maps, (low, mid, high) = marginals(median, below, above, logarithmic)
    np.testing.assert_allclose(
        maps.values(np.array([[-Z95], [0.0], [Z95]])), [low, mid, high], rtol=1e-9, atol=1e-9
    )
    z = np.linspace(-6, 6, 121)[:, None]
    values = maps.values(z)
    assert np.all(np.diff(values[:, 0]) > 0.0)
    np.testing.assert_allclose(maps.coordinates(values), z, atol=1e-5)


@settings(deadline=None)
@given(half_range, half_range, st.booleans(), st.floats(-4, 4))
def test_derivatives_match_differences(below, above, logarithmic, z):
    maps, _ = marginals(0.5, below, above, logarithmic)
    # where the blend is sharp the second derivative is large: the step is far below it
    step = 1e-3 * float(maps.blend[0])
    difference = (maps.values(np.array([z + step])) - maps.values(np.array([z - step]))) / (2 * step)
    np.testing.assert_allclose(maps.derivatives(np.array([z])), difference, rtol=1e-4)


def test_values_that_no_coordinate_reaches_are_infinite():
    maps, _ = marginals(0.0, 1.0, 1.0, True)
    assert maps.coordinates(np.array([0.0]))[0] == -np.inf
    assert maps.coordinates(np.array([np.inf]))[0] == np.inf
