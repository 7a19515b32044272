"""Draws of a few parameters by adaptive importance sampling.

Points are drawn about an optimum and all over the prior, and then where they weigh most. Each is weighed by the mixture
of all that were drawn from (Veach & Guibas 1995; Cornuet et al. 2012, Scand. J. Statist. 39, 798), so that valleys that
the first draws met are counted whichever of them met it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
import numpy.typing as npt
from scipy.special import logsumexp
from scipy.stats import multivariate_t, norm

FloatArray = npt.NDArray[np.float64]

NEARBY, ALL_OVER, MORE = 40, 40, 60  # draws about the optimum, of the prior, and of each later round
ROUNDS = 4
EFFECTIVE = 20.0  # draws of equal weight that would say as much: from so many on there are enough
WIDER = 1.3  # than the optimum's standard deviations
FREEDOM = 5  # degrees, of the t distributions that are drawn from: their tails are fatter than any valley's
KERNELS = 20  # of the heaviest points
AROUND = 0.15  # of the draws of a round that no kernel gets
ROUND_AND_ROUND = 1.5  # times the covariance of all points, where these are
LEAST = 0.15  # of the optimum's covariance, that no kernel goes below


class Proposal(Protocol):
    """What is drawn from."""

    def draws(self, count: int, rng: np.random.Generator) -> FloatArray: ...
    def log_density(self, points: FloatArray) -> FloatArray: ...


@dataclass(frozen=True, eq=False)
class Box:
    """A prior within limits.

    Parameters
    ----------
    low, high : (d,) limits.
    is_normal : (d,) whether it is standard normal there; otherwise it is uniform.
    """

    low: FloatArray
    high: FloatArray
    is_normal: npt.NDArray[np.bool_]

    def draws(self, count: int, rng: np.random.Generator) -> FloatArray:
        """(count, d) points."""
        parts = rng.random((count, len(self.low)))
        low, high = norm.cdf(self.low), norm.cdf(self.high)
        normal = np.clip(norm.ppf(low + (high - low) * parts), self.low, self.high)
        return np.where(self.is_normal, normal, self.low + (self.high - self.low) * parts)

    def log_density(self, points: FloatArray) -> FloatArray:
        """(n,) at points (n, d)."""
        inside = np.all((points >= self.low) & (points <= self.high), axis=1)
        normal = norm.logpdf(points) - np.log(norm.cdf(self.high) - norm.cdf(self.low))
        each = np.where(self.is_normal, normal, -np.log(self.high - self.low))
        return np.where(inside, each.sum(axis=1), -np.inf)


class _Kernel(NamedTuple):
    share: float
    middle: FloatArray
    covariance: FloatArray

    @property
    def distribution(self) -> multivariate_t:
        return multivariate_t(self.middle, self.covariance, df=FREEDOM)


@dataclass(frozen=True, eq=False)
class _Mixture:
    """Of t distributions."""

    kernels: Sequence[_Kernel]

    def draws(self, count: int, rng: np.random.Generator) -> FloatArray:
        shares = np.array([k.share for k in self.kernels])
        chosen = rng.choice(len(shares), size=count, p=shares / shares.sum())
        drawn = [self.kernels[i].distribution.rvs(1, random_state=rng) for i in chosen]
        return np.array(drawn).reshape(count, -1)

    def log_density(self, points: FloatArray) -> FloatArray:
        each = [np.log(k.share) + np.atleast_1d(k.distribution.logpdf(points)) for k in self.kernels]
        return np.asarray(logsumexp(each, axis=0))


@dataclass(frozen=True, eq=False)
class Draws:
    """Of a posterior.

    Parameters
    ----------
    points : (n, d).
    log_likelihoods : (n,).
    log_weights : (n,) ln of what each stands for; their mean weight is the integral of likelihood and prior.
    """

    points: FloatArray
    log_likelihoods: FloatArray
    log_weights: FloatArray

    @property
    def are_impossible(self) -> bool:
        """Whether none of them is possible."""
        return not bool(np.isfinite(self.log_weights).any())

    @property
    def effective(self) -> float:
        """Number of draws of equal weight that would say as much."""
        weights = np.exp(self.log_weights - self.log_weights.max())
        return float(weights.sum() ** 2 / (weights @ weights))


def draws_of(
    log_likelihood: Callable[[FloatArray], float],
    prior: Box,
    middle: FloatArray,
    covariance: FloatArray,
    rng: np.random.Generator,
) -> Draws:
    """Of likelihood and prior.

    Parameters
    ----------
    log_likelihood : of a point (d,) within limits.
    prior : the limits, and the prior within them.
    middle, covariance : (d,) and (d, d) of an optimum.
    rng : for the draws.
    """
    proposals: list[tuple[int, Proposal]] = [
        (NEARBY, _Mixture([_Kernel(1.0, middle, WIDER**2 * covariance)])),
        (ALL_OVER, prior),
    ]
    points = np.vstack([proposal.draws(count, rng) for count, proposal in proposals])
    likelihoods = _within(log_likelihood, prior, points)
    found = _weighed(proposals, prior, points, likelihoods)
    for i in range(ROUNDS):
        # two at least: the first one's kernels know of no more than chance drew
        if found.are_impossible or (i > 1 and found.effective >= EFFECTIVE):
            break
        proposals.append((MORE, _about(found, covariance)))
        new = proposals[-1][1].draws(MORE, rng)
        likelihoods = np.r_[likelihoods, _within(log_likelihood, prior, new)]
        found = _weighed(proposals, prior, np.vstack([found.points, new]), likelihoods)
    return found


def _within(log_likelihood: Callable[[FloatArray], float], prior: Box, points: FloatArray) -> FloatArray:
    inside = np.isfinite(prior.log_density(points))
    return np.array([log_likelihood(p) if here else -np.inf for p, here in zip(points, inside, strict=True)])


def _weighed(
    proposals: Sequence[tuple[int, Proposal]], prior: Box, points: FloatArray, likelihoods: FloatArray
) -> Draws:
    drawn = [np.log(count / len(points)) + proposal.log_density(points) for count, proposal in proposals]
    log_weights = prior.log_density(points) + likelihoods - logsumexp(drawn, axis=0)
    return Draws(points, likelihoods, np.asarray(log_weights))


def _about(found: Draws, covariance: FloatArray) -> _Mixture:
    """Kernels at the heaviest points, as wide as Silverman's rule has it for so many, and one around all."""
    points, weights = found.points, np.exp(found.log_weights - logsumexp(found.log_weights))
    middle = weights @ points
    spread = ((points - middle).T * weights) @ (points - middle)
    dimensions = len(middle)
    width = (4.0 / (max(found.effective, 2.0) * (dimensions + 2))) ** (2.0 / (dimensions + 4))
    own = width * spread + LEAST * covariance
    heaviest = np.argsort(-weights)[:KERNELS]
    shares = (1.0 - AROUND) * weights[heaviest] / weights[heaviest].sum()
    kernels = [_Kernel(float(s), points[i], own) for s, i in zip(shares, heaviest, strict=True) if s > 0.0]
    around = _Kernel(AROUND, middle, ROUND_AND_ROUND * spread + 2 * LEAST * covariance)
    return _Mixture([*kernels, around])
