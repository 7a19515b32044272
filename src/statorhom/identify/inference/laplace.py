"""Laplace approximation about one optimum: normal distribution, limits, evidence."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from statorhom.identify.inference.polish import Optimum
from statorhom.identify.parameters.bounds import Array, read_only
from statorhom.identify.parameters.parameter_space import ParameterSpace
from statorhom.identify.parameters.truncated_normal import BoxedDraws, boxed_draws

LOG2_DRAWS = 12


@dataclass(frozen=True, eq=False)
class LaplaceApproximation:
    """The posterior around an optimum as a normal distribution that hard limits cut off.

    Where a limit holds a coordinate back, the quadratic has its centre outside the box; the
    distribution is that normal one, restricted to the box.

    Parameters
    ----------
    optimum : Optimum
    mean : array, shape (d,)
    covariance : array, shape (d, d)
        Before the cut: inverse of the Gauss–Newton Hessian JᵀJ, prior included.
    draws : BoxedDraws
    log_evidence : float
        ln ∫ likelihood × prior ≈ ln L(x̂) + ln π(x̂) + (d/2) ln 2π − ½ ln|H|, with the masses of
        prior and posterior inside the limits; the constant of the likelihood is the problem's
        `log_normalization`.
    """

    optimum: Optimum
    mean: Array
    covariance: Array
    draws: BoxedDraws
    log_evidence: float


def laplace(optimum: Optimum, space: ParameterSpace, *, seed: int = 0) -> LaplaceApproximation:
    """Approximate the posterior about `optimum` (physics: MacKay, Neural Comput. 4, 1992)."""
    hessian = optimum.jacobian.T @ optimum.jacobian
    # only limits may leave a gradient: what the end of the iteration or a kink left is not a slope
    gradient = np.where(optimum.at_limit, optimum.jacobian.T @ optimum.residuals, 0.0)
    factor = cho_factor(hessian)
    covariance = cho_solve(factor, np.eye(gradient.size))
    shift = cho_solve(factor, gradient)
    mean = optimum.x - shift
    draws = boxed_draws(mean, covariance, space.bounds, log2_count=LOG2_DRAWS, seed=seed)
    log_peak = -0.5 * optimum.value + 0.5 * float(gradient @ shift)
    # the powers of 2π of prior and posterior cancel
    log_volume = -float(np.sum(np.log(np.diag(factor[0])))) + draws.log_mass
    log_evidence = optimum.log_normalization + log_peak + log_volume - space.log_prior_volume
    return LaplaceApproximation(optimum, read_only(mean), read_only(covariance), draws, log_evidence)
