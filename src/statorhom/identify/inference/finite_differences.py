"""Derivatives of residual vectors by differences inside a box."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from statorhom.errors import SolverError
from statorhom.identify.parameters.bounds import Array, Bounds

# In coordinates of order one: eigenvalue solvers leave noise of about 1e-9 in weighted residuals,
# which the usual 1.5e-8 would blow up to several per cent of the derivative.
STEP = 1e-4


def jacobian(function: Callable[[Array], Array], x: Array, bounds: Bounds, *, step: float = STEP) -> Array:
    """Differentiate `function` at `x` by central differences, one-sided at limits.

    Parameters
    ----------
    function : callable
        Maps a vector of shape (d,) to a vector of shape (n,).
    x : array, shape (d,)
    bounds : Bounds
        Never left.
    step : float
        Absolute step.

    Returns
    -------
    array, shape (n, d)

    Raises
    ------
    SolverError
        Where the function is not finite on both sides of `x`.
    """
    columns = [_column(function, x, bounds, k, step) for k in range(x.size)]
    return np.column_stack(columns) if columns else np.empty((function(x).size, 0))


def _column(function: Callable[[Array], Array], x: Array, bounds: Bounds, k: int, step: float) -> Array:
    low, high = x.copy(), x.copy()
    low[k] = max(x[k] - step, bounds.lower[k])
    high[k] = min(x[k] + step, bounds.upper[k])
    below, above = function(low), function(high)
    if not np.all(np.isfinite(below)):
        low, below = x, function(x)
    elif not np.all(np.isfinite(above)):
        high, above = x, function(x)
    if high[k] == low[k] or not (np.all(np.isfinite(below)) and np.all(np.isfinite(above))):
        raise SolverError(f"the model does not exist around coordinate {k}: narrow that constant's limits")
    return np.asarray((above - below) / (high[k] - low[k]), dtype=np.float64)
