"""Least squares with priors: Levenberg–Marquardt on a hypothesis, and the evidence at its optimum."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic

import numpy as np
import numpy.typing as npt
from typing_extensions import TypeVar

from statorhom.diagnose.features.mixed_modes import charges_of
from statorhom.diagnose.fits.any_hypothesis import AnyHypothesis
from statorhom.diagnose.fits.derivatives import charge_slopes, jacobian
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.errors import StatorhomError

FloatArray = npt.NDArray[np.float64]
ROUNDS = 2  # of pairing anew
ITERATIONS = 12
PATIENCE = 2  # steps in a row that promise too little
SETTLED = 0.05  # decrease of the objective that no longer matters
LEAST_OF_PROMISE = 0.01  # of what a step promises to second order, that it has to keep
LARGEST_STEP = 2.0  # in prior standard deviations
LEAST_CURVATURE = 1.0  # of a coordinate as the damping sees it; the prior's own, but of places
UNIFORM = 2 * np.pi / 12  # precision of a normal density that is as high as the uniform one


# unless said otherwise, a stator's
H = TypeVar("H", bound=AnyHypothesis, default=Hypothesis, covariant=True)
_H = TypeVar("_H", bound=AnyHypothesis)


@dataclass(frozen=True, eq=False)
class Refit(Generic[H]):
    """A hypothesis at its optimum.

    Parameters
    ----------
    hypothesis : pairing held.
    z : optimum.
    jacobian : of the residuals there.
    misfit : sum of squared residuals.
    objective : with the prior.
    doubt : what the likelihood loses because the model is not sure of frequencies (`Feature.doubt`); it is the same
        all over a model, so that no refit has to think of it.
    """

    hypothesis: H
    z: FloatArray
    jacobian: FloatArray
    misfit: float
    objective: float
    doubt: float = 0.0

    @property
    def covariance(self) -> FloatArray:
        """Of all coordinates."""
        return covariance_of(self.jacobian, self.hypothesis.prior_weights)

    @property
    def left_of_noise(self) -> FloatArray:
        """(n, n) covariance of the residuals at the optimum, to first order."""
        J = self.jacobian
        return np.asarray(np.eye(len(J)) - J @ self.covariance @ J.T)

    @property
    def cost(self) -> float:
        """The objective and twice the doubt: what tells optima of different models apart."""
        return self.objective + 2.0 * self.doubt

    @property
    def log_evidence(self) -> float:
        """Laplace's, up to what all hypotheses share."""
        weights = self.hypothesis.prior_weights
        return -0.5 * self.cost + log_volume(self.jacobian.T @ self.jacobian, weights)


def covariance_of(jacobian: FloatArray, weights: FloatArray) -> FloatArray:
    """Of the coordinates, to first order about an optimum; `weights` are the prior's as of `log_volume`."""
    return np.asarray(np.linalg.inv(_precision(jacobian.T @ jacobian, weights)))


def log_volume(information: FloatArray, weights: FloatArray) -> float:
    """ln of the posterior's volume over the prior's, Laplace's.

    A uniform coordinate has the density 1/√12 over its range in internal units; what the data do not tell of it keeps
    the prior's volume and gains nothing: the precision is never below 2π/12.

    Parameters
    ----------
    information : JᵀJ.
    weights : precision of the prior, 0 where it is uniform.
    """
    _, logdet = np.linalg.slogdet(_precision(information, weights))
    uniform = np.count_nonzero(weights == 0.0)
    return float(-0.5 * logdet + 0.5 * uniform * np.log(UNIFORM))


def _precision(information: FloatArray, weights: FloatArray) -> FloatArray:
    """Hessian of half the objective, and of a uniform coordinate no less than its prior's."""
    return information + np.diag(np.where(weights == 0.0, UNIFORM, weights))


@dataclass(frozen=True, eq=False)
class Point:
    """What a refit makes as small as it can, at a point of a held pairing.

    Parameters
    ----------
    z : the point.
    residuals, charges : their squares are in it.
    objective : with prior and missed modes.
    doubt : of the features.
    """

    z: FloatArray
    residuals: FloatArray
    charges: FloatArray
    objective: float
    doubt: float

    @classmethod
    def of(cls, hypothesis: AnyHypothesis, z: FloatArray) -> Point:
        # a body's modes are predicted anew whenever its features are asked for
        features = hypothesis.features(z)
        residuals, charges = np.array([f.residual for f in features]), charges_of(features)
        own = residuals @ residuals + charges @ charges + np.sum(hypothesis.prior_weights * z**2)
        return cls(z, residuals, charges, float(own) + hypothesis.missed, sum(f.doubt for f in features))


def refit(hypothesis: _H, start: FloatArray, rounds: int = ROUNDS, worth: float = np.inf) -> Refit[_H]:
    """The nearest optimum.

    Parameters
    ----------
    hypothesis, start : what, and from where.
    rounds : of pairing anew.
    worth : objective above which an optimum matters to nobody: what promises none below it, to second order and several
        times in a row, is left where it stands.

    Raises
    ------
    StatorhomError
        If no body has the constants of the start.
    """
    z = start
    best: Refit[_H] | None = None
    for _ in range(rounds):
        paired = hypothesis.paired(z)
        found = _polished(paired, z, worth)
        changed = best is None or found.hypothesis.held != best.hypothesis.held
        if best is None or found.objective < best.objective - SETTLED or changed:
            best, z = found, found.z
        if not changed:
            break
    assert best is not None
    return best


def evaluated(hypothesis: _H, z: FloatArray) -> Refit[_H]:
    """A hypothesis at a point that need not be its optimum.

    Raises
    ------
    StatorhomError
        If no body has these constants.
    """
    paired = hypothesis.paired(z)
    here = Point.of(paired, z)
    return _refit_at(paired, here, jacobian(paired, z))


def _refit_at(hypothesis: _H, here: Point, J: FloatArray) -> Refit[_H]:
    misfit = float(here.residuals @ here.residuals)
    J[:, list(hypothesis.untold)] = 0.0
    return Refit(hypothesis, here.z, J, misfit, here.objective, here.doubt)


def refit_objective(hypothesis: AnyHypothesis, z: FloatArray) -> float:
    """What a refit would make as small as it can, at a point.

    Raises
    ------
    StatorhomError
        If no body has these constants.
    """
    return Point.of(hypothesis.paired(z), z).objective


def _polished(hypothesis: _H, z: FloatArray, worth: float = np.inf) -> Refit[_H]:
    weights, (low, high) = hypothesis.prior_weights, hypothesis.limits()
    here = Point.of(hypothesis, np.clip(z, low, high))
    damping, vain = 1e-3, 0
    J, C = jacobian(hypothesis, here.z), charge_slopes(hypothesis, here.z, here.charges)
    for _ in range(ITERATIONS):
        gradient = J.T @ here.residuals + C.T @ here.charges + weights * here.z
        H = J.T @ J + C.T @ C + np.diag(weights)
        promised = here.objective - gradient @ np.linalg.solve(H + 1e-9 * np.eye(len(H)), gradient)
        vain = vain + 1 if promised > worth else 0
        if vain == PATIENCE:
            break
        # a place of which the data hardly tell would take all of the step, whatever the damping
        scale = np.maximum(np.diag(H), LEAST_CURVATURE)
        better = None
        for _ in range(6):
            step = bounded_step(H + damping * np.diag(scale), gradient, low - here.z, high - here.z)
            step *= min(1.0, LARGEST_STEP / max(float(np.abs(step).max()), 1e-12))
            try:
                trial = Point.of(hypothesis, np.clip(here.z + step, low, high))
            except (StatorhomError, KeyError):
                damping = max(10 * damping, 1e-2)
                continue
            # a row that is far off counts little: where all do, a step ends as far off on the other side
            least = LEAST_OF_PROMISE * max(0.0, -float(2 * gradient @ step + step @ H @ step))
            if len(trial.residuals) == len(here.residuals) and trial.objective < here.objective - least:
                better = trial
                break
            damping = max(10 * damping, 1e-2)
        if better is None:
            break
        gain, here = here.objective - better.objective, better
        damping = damping / 10
        J, C = jacobian(hypothesis, here.z), charge_slopes(hypothesis, here.z, here.charges)
        if gain < SETTLED:
            break
    return _refit_at(hypothesis, here, J)


def bounded_step(H: FloatArray, gradient: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    """Where ½ sᵀHs + gᵀs is least: what would leave its limits stays on them, and the others move as it stays."""
    step, held = np.zeros(len(gradient)), np.zeros(len(gradient), dtype=bool)
    for _ in range(len(gradient)):
        free = np.flatnonzero(~held)
        step[free] = -np.linalg.solve(H[np.ix_(free, free)], gradient[free] + H[free][:, held] @ step[held])
        out = (step < low) | (step > high)
        if not out.any():
            break
        step[out] = np.clip(step, low, high)[out]
        held |= out
        if held.all():
            break
    return step
