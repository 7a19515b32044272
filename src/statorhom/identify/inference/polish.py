"""From a good point to the exact optimum: bounded least squares on the residual vector."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from statorhom.errors import IdentificationError
from statorhom.identify.inference.problem import Problem
from statorhom.identify.parameters.bounds import Array, Bounds, read_only

# how often the discrete choices of the problem may change on the way down
PIECES = 6
SMALLEST_GAIN = 1e-7
MOST_STEPS = 30
# parts of a step that are tried where a change of pieces spoils the whole one
SHORTENED = (1.0, 0.5, 0.25, 0.1)
TOLERANCE = 1e-7
# the trust-region method stays strictly inside the box: this close is on the limit
AT_LIMIT = 1e-6


@dataclass(frozen=True, eq=False)
class Optimum:
    """A local optimum with what the Laplace approximation needs.

    Parameters
    ----------
    x : array, shape (d,)
    value : float
        ‖data residuals‖² + ‖prior residuals‖².
    data_value : float
        ‖data residuals‖²: compare with their number.
    residuals : array, shape (n + d,)
        Data, then prior.
    jacobian : array, shape (n + d, d)
        Their derivative, with the discrete choices held.
    at_limit : bool array, shape (d,)
        Coordinates that a hard limit holds back.
    log_normalization : float
        The problem's, of the data.
    converged : bool
    """

    x: Array
    value: float
    data_value: float
    residuals: Array
    jacobian: Array
    at_limit: np.ndarray
    log_normalization: float
    converged: bool


def polish(problem: Problem, start: Array) -> Optimum:
    """Descend to the local optimum next to `start`.

    Each round solves the smooth problem around the present point; the round counts only if it
    lowers the true value, because discrete choices may change on the way.

    Parameters
    ----------
    problem : Problem
    start : array, shape (d,)

    Returns
    -------
    Optimum

    Raises
    ------
    IdentificationError
        Where the model does not exist at `start`.
    SolverError
        Where derivatives do not exist around it.
    """
    x = problem.space.bounds.clip(np.asarray(start, float))
    value = problem(x)
    if not np.isfinite(value):
        raise IdentificationError(
            "the model does not exist at the starting values: change priors or fixed constants"
        )
    converged = problem.space.dimension == 0
    for _ in range(PIECES if problem.space.dimension else 0):
        piece = problem.smooth_at(x)
        target, converged = _descend(piece, x)
        candidate, gain = _towards(problem, x, value, target)
        if gain > 0.0:
            x, value = candidate, value - gain
        if gain < SMALLEST_GAIN * (1.0 + value):
            # an edge between two pieces, where the smooth problem leads uphill, is no optimum of it
            converged = converged and gain > -SMALLEST_GAIN * (1.0 + value)
            break
        if converged and piece is problem:
            break
    return _describe(problem, x, converged)


def _descend(problem: Problem, start: Array) -> tuple[Array, bool]:
    bounds = problem.space.bounds
    solution = least_squares(
        problem.residuals,
        start,
        jac=problem.jacobian,
        bounds=(bounds.lower, bounds.upper),
        method="trf",
        xtol=TOLERANCE,
        ftol=TOLERANCE,
        gtol=TOLERANCE,
        max_nfev=MOST_STEPS,
    )
    return _settle(solution.x, bounds), bool(solution.success)


def _towards(problem: Problem, x: Array, value: float, target: Array) -> tuple[Array, float]:
    """Step to `target`, or less far where the true value does not fall; return point and gain."""
    gain = -np.inf
    for fraction in SHORTENED:
        # rounding may lead past a limit
        candidate = problem.space.bounds.clip(x + fraction * (target - x))
        gain = max(gain, value - problem(candidate))
        if gain >= 0.0:
            return candidate, gain
    return x, gain


def _settle(x: Array, bounds: Bounds) -> Array:
    """Put coordinates that all but touch a limit onto it."""
    x = np.where(x - bounds.lower < AT_LIMIT, bounds.lower, x)
    return np.where(bounds.upper - x < AT_LIMIT, bounds.upper, x)


def _describe(problem: Problem, x: Array, converged: bool) -> Optimum:
    smooth = problem.smooth_at(x)
    residuals = smooth.residuals(x)
    jacobian = smooth.jacobian(x)
    count = residuals.size - x.size
    data_value = float(residuals[:count] @ residuals[:count])
    return Optimum(
        x=read_only(x),
        value=float(residuals @ residuals),
        data_value=data_value,
        residuals=read_only(residuals),
        jacobian=read_only(jacobian),
        at_limit=_held_back(x, jacobian.T @ residuals, problem.space.bounds),
        log_normalization=problem.log_normalization,
        converged=converged,
    )


def _held_back(x: Array, gradient: Array, bounds: Bounds) -> np.ndarray:
    below = (x - bounds.lower <= AT_LIMIT) & (gradient > 0.0)
    above = (bounds.upper - x <= AT_LIMIT) & (gradient < 0.0)
    held: np.ndarray = below | above
    held.setflags(write=False)
    return held
