"""Posterior over all optima, 90 % intervals of the constants, and what the data determined."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from scipy.special import logsumexp

from statorhom.identify.inference.laplace import LaplaceApproximation, laplace
from statorhom.identify.inference.polish import Optimum
from statorhom.identify.parameters.bounds import Array, read_only
from statorhom.identify.parameters.parameter_space import ParameterSpace
from statorhom.identify.parameters.prior_block import PriorBlock

Status = Literal["identified", "prior_dominated", "fixed"]

DRAWS = 4096
# the data count as the source when they cut the prior's standard deviation to less than this part
LEARNT = 1.0 / 3.0
PRECISION = 0.03
# an optimum this improbable does not decide about a status
NEGLIGIBLE = 0.05


@dataclass(frozen=True)
class Estimate:
    """A constant after the fit.

    Parameters
    ----------
    name : str
    value : float
        At the most probable optimum, so that all values together belong to one model.
    low90, high90 : float
        5 % and 95 % quantiles of the posterior, widened to include `value` where a limit holds it.
    status : "identified", "prior_dominated" or "fixed"
    spread_ratio : float
        Posterior over prior standard deviation in internal coordinates; 0 if fixed.
    """

    name: str
    value: float
    low90: float
    high90: float
    status: Status
    spread_ratio: float


@dataclass(frozen=True, eq=False)
class Posterior:
    """Mixture of Laplace approximations, weighted by their evidence.

    Parameters
    ----------
    space : ParameterSpace
    components : tuple of LaplaceApproximation
        The most probable first; each carries its `log_evidence`.
    weights : array, shape (number of components,)
        Sum to one.
    draws : array, shape (4096, d)
        Equally probable points in internal coordinates, in random order.
    """

    space: ParameterSpace
    components: tuple[LaplaceApproximation, ...]
    weights: Array
    draws: Array

    @property
    def best(self) -> Optimum:
        """The optimum of the most probable component."""
        return self.components[0].optimum

    @property
    def log_evidence(self) -> float:
        """Logarithm of the evidence of all components together."""
        return float(logsumexp([component.log_evidence for component in self.components]))

    @cached_property
    def mean(self) -> Array:
        """Mean in internal coordinates, shape (d,)."""
        return read_only(self.draws.mean(axis=0))

    @cached_property
    def covariance(self) -> Array:
        """Covariance in internal coordinates, shape (d, d)."""
        centred = self.draws - self.mean
        return read_only(centred.T @ centred / len(centred))

    @cached_property
    def physical_draws(self) -> Array:
        """All constants at the draws, in the order of `space.names`, shape (4096, constants)."""
        return read_only(self.space.physical(self.draws))

    def block(self, names: Sequence[str] | None = None) -> PriorBlock:
        """Return mean and covariance of some coordinates (default: all) as a prior for the next step."""
        chosen = self.space.coordinates if names is None else tuple(names)
        places = [self.space.coordinates.index(name) for name in chosen]
        return PriorBlock(chosen, self.mean[places], self.covariance[np.ix_(places, places)])

    def estimates(self, *, precision: float = PRECISION) -> dict[str, Estimate]:
        """Return every constant with interval and status.

        `identified`: the posterior standard deviation is below a third of the prior's, no hard
        limit holds the coordinate in a probable optimum, and the 90 % half-width is at most
        `precision` times the value. `fixed`: not varied. Otherwise `prior_dominated`.

        Parameters
        ----------
        precision : float
            Largest relative 90 % half-width of an identified constant.
        """
        values = self.space.physical(self.best.x)
        lows, highs = np.quantile(self.physical_draws, [0.05, 0.95], axis=0)
        lows, highs = np.minimum(lows, values), np.maximum(highs, values)
        return {
            name: self._estimate(k, values[k], lows[k], highs[k], precision)
            for k, name in enumerate(self.space.names)
        }

    def _estimate(self, k: int, value: float, low: float, high: float, precision: float) -> Estimate:
        name, owner = self.space.names[k], int(self.space.owners[k])
        if owner < 0:
            return Estimate(name, float(value), float(value), float(value), "fixed", 0.0)
        ratio = float(np.sqrt(self.covariance[owner, owner]) / self.space.prior_sd[owner])
        learnt = ratio < LEARNT and not self._held_back[owner]
        precise = 0.5 * (high - low) <= precision * abs(value)
        status: Status = "identified" if learnt and precise else "prior_dominated"
        return Estimate(name, float(value), float(low), float(high), status, ratio)

    @cached_property
    def _held_back(self) -> np.ndarray:
        probable = [c for c, w in zip(self.components, self.weights, strict=True) if w >= NEGLIGIBLE]
        held: np.ndarray = np.any([component.optimum.at_limit for component in probable], axis=0)
        return held


def posterior(optima: Sequence[Optimum], space: ParameterSpace, *, seed: int = 0) -> Posterior:
    """Join the Laplace approximations of distinct optima into one posterior.

    Parameters
    ----------
    optima : sequence of Optimum
        At least one; distinct (see `distinct_optima`).
    space : ParameterSpace
    seed : int
        Of the draws.
    """
    components = sorted(
        (laplace(optimum, space, seed=seed) for optimum in optima), key=lambda c: -c.log_evidence
    )
    logs = np.array([component.log_evidence for component in components])
    weights = np.exp(logs - logsumexp(logs))
    return Posterior(space, tuple(components), read_only(weights), _draw(components, weights, seed))


def _draw(components: Sequence[LaplaceApproximation], weights: Array, seed: int) -> Array:
    """Resample the components' weighted draws systematically into equally probable ones."""
    rng = np.random.default_rng(seed)
    points = np.vstack([component.draws.points for component in components])
    shares = np.concatenate([w * c.draws.weights for c, w in zip(components, weights, strict=True)])
    # one point in the middle of every stratum: equal weights are reproduced exactly
    targets = (np.arange(DRAWS) + 0.5) / DRAWS
    chosen = np.minimum(np.searchsorted(np.cumsum(shares), targets), len(points) - 1)
    return read_only(points[rng.permutation(chosen)])
