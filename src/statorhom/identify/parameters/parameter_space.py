"""Constants with priors, ties between them, and the vector that optimizers move."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from statorhom.errors import IdentificationError
from statorhom.identify.parameters.bounds import Array, Bounds, read_only
from statorhom.identify.parameters.marginal import Marginals
from statorhom.identify.parameters.prior_block import PriorBlock
from statorhom.identify.parameters.truncated_normal import boxed_draws


@dataclass(frozen=True)
class Parameter:
    """One physical constant, its prior and its hard limits, all in the constant's own unit.

    Parameters
    ----------
    name : str
    median, low90, high90 : float
        Prior median, 5 % and 95 % quantile. A fixed constant keeps the median.
    lower, upper : float
        Limits that no value may pass; the prior is cut off there.
    scale : "log" or "linear"
        Whether the prior is (skew) normal in the logarithm or in the value.
    fixed : bool
        Not varied.

    Raises
    ------
    IdentificationError
        Where the numbers contradict each other.
    """

    name: str
    median: float
    low90: float
    high90: float
    lower: float
    upper: float
    scale: Literal["log", "linear"] = "log"
    fixed: bool = False

    def __post_init__(self) -> None:
        if self.scale not in ("log", "linear"):
            raise IdentificationError(f"{self.name}: scale must be 'log' or 'linear', not '{self.scale}'")
        if not np.isfinite(self.median):
            raise IdentificationError(f"{self.name}: the value {self.median} is not finite; give a number")
        if not self.fixed:
            self._check_range()

    @classmethod
    def constant(cls, name: str, value: float) -> Parameter:
        """Return a constant that keeps its value."""
        return cls(name, value, value, value, value, value, "linear", fixed=True)

    def _check_range(self) -> None:
        if not -np.inf < self.low90 < self.median < self.high90 < np.inf:
            raise IdentificationError(
                f"{self.name}: the prior's median {self.median:g} must lie between low {self.low90:g} and "
                f"high {self.high90:g}; widen its range"
            )
        if not self.lower < self.median < self.upper:
            raise IdentificationError(
                f"{self.name}: the prior's median {self.median:g} must lie inside its limits {self.lower:g} "
                f"and {self.upper:g}; change the prior"
            )
        if self.scale == "log" and (self.low90 <= 0.0 or self.lower < 0.0):
            raise IdentificationError(f"{self.name}: a prior on the logarithm needs values above 0")


@dataclass(frozen=True)
class Tie:
    """Constants that one coordinate drives; the first one leads and lends its prior.

    Parameters
    ----------
    names : tuple of str
        The leader and its followers.
    rule : "equal" or "proportional"
        Followers take the leader's value, or keep the ratio of the prior medians.
    """

    names: tuple[str, ...]
    rule: Literal["equal", "proportional"] = "equal"


@dataclass(frozen=True, eq=False)
class ParameterSpace:
    """All constants of a problem and the free coordinates behind them.

    A coordinate measures the deviation from the prior median in prior standard deviations, so all
    of them are of order one and the prior is standard normal unless a block says otherwise.

    Parameters
    ----------
    parameters : tuple of Parameter
    ties : tuple of Tie
    blocks : tuple of PriorBlock
        Joint priors from earlier steps.

    Raises
    ------
    IdentificationError
        Unknown, repeated or fixed names in ties and blocks; tied constants with disjoint limits.
    """

    parameters: tuple[Parameter, ...]
    ties: tuple[Tie, ...] = ()
    blocks: tuple[PriorBlock, ...] = ()

    def __post_init__(self) -> None:
        _refuse_repeats("constants", self.names)
        _refuse_repeats("ties", tuple(name for tie in self.ties for name in tie.names))
        _refuse_repeats("prior blocks", tuple(name for block in self.blocks for name in block.names))
        for tie in self.ties:
            self._check_tie(tie)
        for block in self.blocks:
            for name in block.names:
                if name not in self.coordinates:
                    raise IdentificationError(
                        f"prior block: '{name}' is fixed, tied to another constant or unknown; leave it out"
                    )
        for name, low, high in zip(self.coordinates, self._limits[0], self._limits[1], strict=True):
            if not low < high:
                raise IdentificationError(
                    f"{name}: the limits of the constants tied to it leave no room; untie them"
                )

    def _check_tie(self, tie: Tie) -> None:
        for name in tie.names:
            if name not in self.names:
                raise IdentificationError(
                    f"tied constants: '{name}' is unknown; known are {', '.join(self.names)}"
                )
            if self._by_name[name].fixed:
                raise IdentificationError(
                    f"tied constants: '{name}' is fixed as well; remove it from one of the two"
                )
        if tie.rule not in ("equal", "proportional"):
            raise IdentificationError(
                f"tied constants: rule must be 'equal' or 'proportional', not '{tie.rule}'"
            )

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of all constants, fixed and tied ones included."""
        return tuple(parameter.name for parameter in self.parameters)

    @cached_property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the constants that own a coordinate (free ones, and the leaders of ties)."""
        followers = {name for tie in self.ties for name in tie.names[1:]}
        return tuple(p.name for p in self.parameters if not p.fixed and p.name not in followers)

    @property
    def dimension(self) -> int:
        """Number of coordinates d."""
        return len(self.coordinates)

    @cached_property
    def bounds(self) -> Bounds:
        """Hard limits in internal coordinates."""
        lower, upper = (self._marginals.coordinates(limit) for limit in self._limits)
        return Bounds(lower, upper)

    @cached_property
    def prior_mean(self) -> Array:
        """Prior mean in internal coordinates, shape (d,)."""
        mean = np.zeros(self.dimension)
        for block in self.blocks:
            mean[self._positions(block.names)] = block.mean
        return read_only(mean)

    @cached_property
    def prior_covariance(self) -> Array:
        """Prior covariance in internal coordinates, shape (d, d)."""
        covariance = np.eye(self.dimension)
        for block in self.blocks:
            places = self._positions(block.names)
            covariance[np.ix_(places, places)] = block.covariance
        return read_only(covariance)

    @cached_property
    def prior_sd(self) -> Array:
        """Prior standard deviations in internal coordinates, shape (d,)."""
        return read_only(np.sqrt(np.diag(self.prior_covariance)))

    @cached_property
    def prior_jacobian(self) -> Array:
        """Derivative of `prior_residuals`, a constant (d, d) matrix L⁻¹ with L Lᵀ the covariance."""
        return read_only(np.linalg.inv(np.linalg.cholesky(self.prior_covariance)))

    @cached_property
    def log_prior_volume(self) -> float:
        """Prior's normalization without its 2π: ½ ln|C| + ln of its mass inside the limits."""
        _, log_determinant = np.linalg.slogdet(self.prior_covariance)
        draws = boxed_draws(self.prior_mean, self.prior_covariance, self.bounds, log2_count=12, seed=0)
        return 0.5 * float(log_determinant) + draws.log_mass

    @property
    def owners(self) -> np.ndarray:
        """Per constant the number of the coordinate that drives it, −1 if fixed."""
        return self._drive[0]

    @property
    def start(self) -> Array:
        """The prior mean, inside the limits, shape (d,)."""
        return self.bounds.clip(self.prior_mean)

    def prior_residuals(self, x: Array) -> Array:
        """Return the vector of shape (d,) whose squared norm is −2 ln prior, up to a constant."""
        return self.prior_jacobian @ (x - self.prior_mean)

    def physical(self, x: Array) -> Array:
        """Return all constants in the order of `names`.

        Parameters
        ----------
        x : array, shape (..., d)

        Returns
        -------
        array, shape (..., number of constants)
        """
        free = self._marginals.values(np.asarray(x, float))
        owner, ratio, fixed = self._drive
        values = np.empty((*free.shape[:-1], len(self.parameters)))
        driven = owner >= 0
        values[..., driven] = free[..., owner[driven]] * ratio[driven]
        values[..., ~driven] = fixed[~driven]
        return values

    def physical_jacobian(self, x: Array) -> Array:
        """Return d constants / d coordinates at `x`, shape (number of constants, d)."""
        slopes = self._marginals.derivatives(np.asarray(x, float))
        owner, ratio, _ = self._drive
        jacobian = np.zeros((len(self.parameters), self.dimension))
        driven = np.flatnonzero(owner >= 0)
        jacobian[driven, owner[driven]] = slopes[owner[driven]] * ratio[driven]
        return jacobian

    def values(self, x: Array) -> dict[str, float]:
        """Return all constants by name."""
        return dict(zip(self.names, self.physical(x).tolist(), strict=True))

    def internal(self, values: Mapping[str, float]) -> Array:
        """Return the coordinates of given constants, clipped to the limits, shape (d,).

        Names that are missing keep their prior median; fixed and tied followers are ignored.
        """
        medians = [values.get(name, self._by_name[name].median) for name in self.coordinates]
        limited = np.clip(medians, *self._limits)
        return self.bounds.clip(self._marginals.coordinates(limited))

    def sample(self, count: int, rng: np.random.Generator) -> Array:
        """Draw `count` points from the prior, reflected into the limits, shape (count, d)."""
        normal = rng.standard_normal((count, self.dimension))
        draws = self.prior_mean + normal @ np.linalg.cholesky(self.prior_covariance).T
        return self.bounds.reflect(draws)

    @cached_property
    def _by_name(self) -> dict[str, Parameter]:
        return {parameter.name: parameter for parameter in self.parameters}

    @cached_property
    def _marginals(self) -> Marginals:
        free = [self._by_name[name] for name in self.coordinates]
        ranges = np.array([[p.median, p.low90, p.high90] for p in free], dtype=float).reshape(-1, 3)
        logarithmic = np.array([p.scale == "log" for p in free], dtype=bool)
        return Marginals.from_ranges(ranges[:, 0], ranges[:, 1], ranges[:, 2], logarithmic)

    @cached_property
    def _drive(self) -> tuple[np.ndarray, Array, Array]:
        """Per constant: the coordinate that drives it (−1: fixed), its ratio, its fixed value."""
        leader = {name: (tie.names[0], tie.rule) for tie in self.ties for name in tie.names}
        owner = np.full(len(self.parameters), -1)
        ratio = np.ones(len(self.parameters))
        for k, parameter in enumerate(self.parameters):
            if parameter.fixed:
                continue
            first, rule = leader.get(parameter.name, (parameter.name, "equal"))
            owner[k] = self.coordinates.index(first)
            if rule == "proportional":
                ratio[k] = parameter.median / self._by_name[first].median
        return owner, ratio, np.array([parameter.median for parameter in self.parameters])

    @cached_property
    def _limits(self) -> tuple[Array, Array]:
        """Physical limits of the coordinates' owners that respect every follower's limits too."""
        owner, ratio, _ = self._drive
        lower, upper = np.full(self.dimension, -np.inf), np.full(self.dimension, np.inf)
        for parameter, place, factor in zip(self.parameters, owner, ratio, strict=True):
            if place >= 0:
                limits = sorted((parameter.lower / factor, parameter.upper / factor))
                lower[place] = max(lower[place], limits[0])
                upper[place] = min(upper[place], limits[1])
        return lower, upper

    def _positions(self, names: tuple[str, ...]) -> list[int]:
        return [self.coordinates.index(name) for name in names]


def _refuse_repeats(what: str, names: tuple[str, ...]) -> None:
    repeated = {name for name in names if names.count(name) > 1}
    if repeated:
        raise IdentificationError(f"{what}: '{sorted(repeated)[0]}' occurs twice; keep it once")
