"""Loss factors of the regions from the modes' loss factors: η_mode = Σ_region share of the strain energy · η_region.

That is the modal strain energy method (Johnson & Kienholz, AIAA Journal 20, 1982): the loss per cycle over 2π times
the energy, region by region, in the undamped shapes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import nnls

from statorhom.errors import IdentificationError
from statorhom.identify.parameters.bounds import Array, Bounds, read_only
from statorhom.identify.parameters.truncated_normal import boxed_draws
from statorhom.materials.typical_ranges import Z95
from statorhom.results.schema import Interval

# Measured loss factors of one machine, taken by different hands, scatter by this much: suspension, cables, windowing.
RELATIVE_SD = 0.15
# A region that never holds more of a mode's energy than this is out of reach: its loss would have to be the inverse
# of it, times the measurement's spread, before a mode told it from nothing.
REACHED = 0.02
OUTLIER = 1.5  # standard deviations from which on a mode pulls no stronger (Huber)
CLIPPED = 0.7785  # mean square of a standard normal variable that is cut at ±1.5 (Huber's proposal 2)
FAR = 6.0  # standard deviations of a mode beyond which no factor is looked for
LEAST_PREDICTED = 0.2  # of the measured value: keeps the spread of a mode from vanishing with its prediction
ROUNDS = 60
SETTLED = 1e-7
BISECTIONS = 20
LOG2_DRAWS = 11


@dataclass(frozen=True)
class LossPrior:
    """What an earlier step tells of a region's loss factor, as a normal distribution."""

    mean: float
    sd: float

    @classmethod
    def of(cls, interval: Interval) -> LossPrior:
        """The normal distribution of a value with its 90 % interval."""
        low, high = interval.ci90
        return cls(interval.value, max((high - low) / (2 * Z95), 1e-3 * abs(interval.value), 1e-9))


@dataclass(frozen=True, eq=False)
class LossFactors:
    """Loss factors of a stage's regions.

    Parameters
    ----------
    regions : region → value with 90 % interval; None where neither a mode nor an earlier step tells.
    predicted : (modes,) loss factors that follow for all modes, the unmeasured ones too.
    unexplained : relative standard deviation of the measured loss factors beyond their measurement's.
    """

    regions: Mapping[str, Interval | None]
    predicted: Array
    unexplained: float


@dataclass(frozen=True, eq=False)
class _System:
    """The rows of the least-squares problem: measured modes, then priors."""

    shares: Array
    measured: Array
    relative_sd: Array
    prior_rows: Array
    prior_values: Array

    def solve(self, unexplained: float) -> tuple[Array, Array, Array]:
        """Non-negative solution, the weighted matrix and the weighted right-hand side it belongs to.

        The spread of a mode is a part of its predicted value, not of its measured one: weights that favour the
        modes that happened to be measured low would pull every loss factor down.
        """
        predicted, eta = self.measured, np.full(self.shares.shape[1], np.inf)
        for _ in range(ROUNDS):
            sd = self._sd(predicted, unexplained)
            weight = np.sqrt(_huber((self.measured - predicted) / sd)) / sd
            matrix = np.vstack([self.shares * weight[:, None], self.prior_rows])
            target = np.concatenate([self.measured * weight, self.prior_values])
            before, (eta, _) = eta, nnls(matrix, target)
            predicted = self.shares @ eta
            if np.abs(eta - before).max() <= SETTLED * eta.max():
                break
        return eta, matrix, target

    def _sd(self, predicted: Array, unexplained: float) -> Array:
        level = np.maximum(predicted, LEAST_PREDICTED * self.measured)
        return np.asarray(level * np.hypot(self.relative_sd, unexplained))

    def excess(self, unexplained: float) -> float:
        """Sum of the squared residuals, outliers cut, over what is expected of it."""
        eta, matrix, _ = self.solve(unexplained)
        predicted = self.shares @ eta
        residual = (self.measured - predicted) / self._sd(predicted, unexplained)
        rows = matrix[: len(residual)]
        data = rows.T @ rows
        fitted = float(np.trace(np.linalg.pinv(matrix.T @ matrix) @ data))
        cut = np.minimum(np.abs(residual), OUTLIER)
        return float(np.sum(cut**2)) / (CLIPPED * max(1.0, len(residual) - fitted))

    def upper(self, eta: Array, unexplained: float) -> Array:
        """Factors that the mode which a region reaches most, or what is known of it, rules out."""
        limits = np.zeros(self.shares.shape[1])
        if len(self.measured):
            predicted = self.shares @ eta
            highest = np.maximum(predicted, self.measured) + FAR * self._sd(predicted, unexplained)
            best = self.shares.argmax(axis=0)
            limits = highest[best] / np.maximum(self.shares.max(axis=0), REACHED)
        for row, value in zip(self.prior_rows, self.prior_values, strict=True):
            column = int(row.argmax())
            limits[column] = max(limits[column], (value + FAR) / row[column])
        return np.asarray(np.maximum(limits, 2 * eta))


def _huber(residual: Array) -> Array:
    return np.asarray(np.minimum(1.0, OUTLIER / np.maximum(np.abs(residual), 1e-300)))


def fit_loss_factors(
    regions: Sequence[str],
    shares: Array,
    measured: Sequence[float | None],
    *,
    relative_sd: float | Sequence[float] = RELATIVE_SD,
    priors: Mapping[str, LossPrior] | None = None,
) -> LossFactors:
    """Fit non-negative loss factors of regions to those of modes.

    Parameters
    ----------
    regions : names; regions of one material count as one.
    shares : (modes, regions) of the strain energy, rows summing to 1.
    measured : (modes,) loss factors, None where a mode has none.
    relative_sd : of the measured values, one for all or one per mode.
    priors : region → what earlier steps tell; a region that this step identifies anew has none.

    Raises
    ------
    IdentificationError
        If a loss factor is not positive.
    """
    shares = np.asarray(shares, float).reshape(len(measured), len(regions))
    priors = {} if priors is None else priors
    used = np.array([value is not None for value in measured], dtype=bool)
    values = np.array([value for value in measured if value is not None], dtype=float)
    if not np.all((values > 0) & np.isfinite(values)):
        raise IdentificationError(
            "measured loss factors must be positive numbers; correct or delete the others"
        )
    reached = shares[used].max(axis=0, initial=0.0) >= REACHED
    known = [i for i, region in enumerate(regions) if reached[i] or region in priors]
    system = _system(
        shares[used][:, known],
        values,
        np.broadcast_to(relative_sd, len(measured))[used],
        regions,
        known,
        priors,
    )
    unexplained = _unexplained(system)
    eta, intervals = _posterior(system, unexplained)
    found = dict.fromkeys(regions) | {
        regions[i]: interval for i, interval in zip(known, intervals, strict=True)
    }
    return LossFactors(found, read_only(shares[:, known] @ eta), unexplained)


def _system(
    shares: Array,
    measured: Array,
    relative_sd: Array,
    regions: Sequence[str],
    known: Sequence[int],
    priors: Mapping[str, LossPrior],
) -> _System:
    given = [(column, priors[regions[i]]) for column, i in enumerate(known) if regions[i] in priors]
    rows = np.zeros((len(given), len(known)))
    for row, (column, prior) in enumerate(given):
        rows[row, column] = 1 / prior.sd
    values = np.array([prior.mean / prior.sd for _, prior in given])
    return _System(shares, measured, np.asarray(relative_sd, float), rows, values)


def _unexplained(system: _System) -> float:
    """The smallest common relative spread, added to the measurement's, that the residuals do not exceed."""
    if len(system.measured) == 0 or system.excess(0.0) <= 1.0:
        return 0.0
    low, high = 0.0, 1.0
    while system.excess(high) > 1.0 and high < 100.0:
        high *= 2
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if system.excess(middle) > 1.0 else (low, middle)
    return high


def _posterior(system: _System, unexplained: float) -> tuple[Array, list[Interval]]:
    """Values, and 90 % intervals of the normal distribution cut at zero."""
    count = system.shares.shape[1]
    if count == 0:
        return np.empty(0), []
    eta, matrix, target = system.solve(unexplained)
    scale = max(float(np.max(system.measured, initial=0.0)), float(eta.max()), 1e-9)
    # regions that no combination of modes tells apart keep a spread of many times anything measured
    hessian = matrix.T @ matrix + np.eye(count) * (1e-3 / scale) ** 2
    covariance = np.linalg.inv(hessian)
    mean = covariance @ (matrix.T @ target)
    bounds = Bounds(np.zeros(count), system.upper(eta, unexplained))
    draws = boxed_draws(mean, (covariance + covariance.T) / 2, bounds, log2_count=LOG2_DRAWS, seed=0)
    return eta, [
        _interval(value, points, draws.weights) for value, points in zip(eta, draws.points.T, strict=True)
    ]


def _interval(value: float, points: Array, weights: Array) -> Interval:
    order = np.argsort(points)
    cumulated = np.cumsum(weights[order])
    low, high = np.interp([0.05, 0.95], cumulated, points[order])
    return Interval(value=float(value), ci90=(float(min(low, value)), float(max(high, value))))
