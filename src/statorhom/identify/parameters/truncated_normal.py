"""Draws from a normal distribution that is cut off at a box, and the mass inside the box.

The separation of variables of Geweke, Hajivassiliou and Keane and of Genz (J. Comput. Graph.
Stat. 1, 1992): coordinate by coordinate through the Cholesky factor, each drawn inside its limits
given those before it; the product of the conditional masses is the weight of a draw, and the mean
weight is the mass of the box. Sobol points make it quiet, logarithms keep it right in far tails.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import log_ndtr, logsumexp, ndtri_exp
from scipy.stats import qmc

from statorhom.identify.parameters.bounds import Array, Bounds


@dataclass(frozen=True, eq=False)
class BoxedDraws:
    """Weighted draws.

    Parameters
    ----------
    points : array, shape (count, d)
    weights : array, shape (count,)
        Sum to one.
    log_mass : float
        Logarithm of the probability of the box under the uncut distribution.
    """

    points: Array
    weights: Array
    log_mass: float


def boxed_draws(mean: Array, covariance: Array, bounds: Bounds, *, log2_count: int, seed: int) -> BoxedDraws:
    """Draw 2**log2_count points of N(mean, covariance) inside `bounds`.

    Parameters
    ----------
    mean : array, shape (d,)
        May lie outside the box.
    covariance : array, shape (d, d)
        Positive definite.
    bounds : Bounds
    log2_count : int
    seed : int
    """
    dimension = mean.size
    count = 2**log2_count
    if dimension == 0:
        return BoxedDraws(np.empty((count, 0)), np.full(count, 1.0 / count), 0.0)
    order = _most_cut_first(mean, covariance, bounds)
    factor = np.linalg.cholesky(covariance[np.ix_(order, order)])
    lower, upper = (bounds.lower - mean)[order], (bounds.upper - mean)[order]
    uniform = np.clip(qmc.Sobol(dimension, seed=seed).random_base2(log2_count), 1e-12, 1.0 - 1e-12)
    normal, log_weights = np.zeros((count, dimension)), np.zeros(count)
    for k in range(dimension):
        shift = normal[:, :k] @ factor[k, :k]
        ends = (lower[k] - shift) / factor[k, k], (upper[k] - shift) / factor[k, k]
        normal[:, k], log_mass = _cut_normal(uniform[:, k], *ends)
        log_weights += log_mass
    points = np.empty_like(normal)
    points[:, order] = normal @ factor.T
    total = logsumexp(log_weights)
    return BoxedDraws(bounds.clip(points + mean), np.exp(log_weights - total), float(total - np.log(count)))


def _most_cut_first(mean: Array, covariance: Array, bounds: Bounds) -> np.ndarray:
    # the weights vary least when the strongest cuts come before anything depends on them
    sd = np.sqrt(np.diag(covariance))
    low, high = (bounds.lower - mean) / sd, (bounds.upper - mean) / sd
    return np.argsort(_interval(low, high)[2], kind="stable")


def _cut_normal(uniform: Array, low: Array, high: Array) -> tuple[Array, Array]:
    """Return standard normal draws between `low` and `high` and the log mass of that interval."""
    flipped = low > 0.0
    log_low, log_high, log_mass = _interval(low, high)
    share = np.where(flipped, 1.0 - uniform, uniform)
    log_p = log_high + np.log(share + (1.0 - share) * np.exp(log_low - log_high))
    draws = ndtri_exp(np.minimum(log_p, -1e-300))
    return np.clip(np.where(flipped, -draws, draws), low, high), log_mass


def _interval(low: Array, high: Array) -> tuple[Array, Array, Array]:
    """Return ln Φ of both ends and ln of their difference, in the tail where Φ is small."""
    flipped = low > 0.0
    log_low = log_ndtr(np.where(flipped, -high, low))
    log_high = log_ndtr(np.where(flipped, -low, high))
    # an interval below the resolution of Φ: density times width
    gap = np.maximum(-np.expm1(log_low - log_high), 0.0)
    narrow = gap < 1e-12
    left, right = np.where(narrow, low, 0.0), np.where(narrow, high, 1.0)
    middle = -0.125 * (left + right) ** 2 - 0.5 * np.log(2.0 * np.pi) + np.log(right - left)
    return log_low, log_high, np.where(narrow, middle, log_high + np.log(np.where(narrow, 1.0, gap)))
