"""Evidence of "something that is not in the library": each mode off by chance, the constants free.

An effect that is not in the library looks like one that is: a mass on a spring like a rigid one, a patchwork like an
oval yoke. Each explains most of the misfit with a few parameters, and the rest is hardly more than noise. What such a
name has to beat is a discrepancy that is drawn for every mode anew and explains nothing (physics.md §8; Brynjarsdóttir
& O'Hagan 2014): frequencies, splits and shifts are off by normal deviates, and how large those usually are is not
known. An effect that is really there says what each mode does, and a discrepancy pays for every one of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
import numpy.typing as npt
from scipy.special import logsumexp

from statorhom.diagnose.any_hypothesis import AnyHypothesis
from statorhom.diagnose.feature import Feature, held_down
from statorhom.diagnose.refit import Refit, log_volume

FloatArray = npt.NDArray[np.float64]

# relative to the frequency, or to λ: from what no test resolves to a tenth, every half of a decade equally likely
AMPLITUDES = np.logspace(-5, -1, 9)
# kinds, each with an amplitude of its own: one cause that parts doublets may leave their means as they are
ALIKE = ("frequency", "split", "shift")
LEAST_STEEPNESS = 1e-3


def discrepancy_evidence(base: Refit[AnyHypothesis]) -> float:
    """ln Z of the declared model with a free discrepancy, as `Refit.log_evidence` counts it.

    The constants are refitted to first order about the declared model's optimum, with every amplitude of the
    discrepancies; the evidence is the mean over those.
    """
    problem = _Linear.of(base)
    return float(logsumexp([problem.log_evidence(w) for w in problem.weightings()])) - problem.log_count


@dataclass(frozen=True, eq=False)
class _Linear:
    """A declared model about its optimum.

    Parameters
    ----------
    features : n residuals.
    deviations : (n,) in standard deviations; where no discrepancy is thought of, the residuals as they count.
    jacobian : (n, constants) of these.
    z, prior_weights : optimum and its prior's precision.
    missed : as of the hypothesis.
    """

    features: Sequence[Feature]
    deviations: FloatArray
    jacobian: FloatArray
    z: FloatArray
    prior_weights: FloatArray
    missed: float

    @classmethod
    def of(cls, base: Refit[AnyHypothesis]) -> _Linear:
        features = base.hypothesis.features(base.z)
        # what is far off is held down for the declared model alone: a discrepancy sees all of it
        deviations = [f.deviation if _may_be_off(f) else f.residual for f in features]
        steepness = np.array([f.steepness if _may_be_off(f) else 1.0 for f in features])
        jacobian = base.jacobian / np.maximum(steepness, LEAST_STEEPNESS)[:, None]
        weights, missed = base.hypothesis.prior_weights, base.hypothesis.missed
        return cls(features, np.array(deviations), jacobian, base.z, weights, missed)

    @property
    def _alike(self) -> list[FloatArray]:
        """1 / sd of every feature that a discrepancy is of, kind by kind."""
        own = [
            [1 / f.sd if f.kind == kind and _may_be_off(f) else 0.0 for f in self.features] for kind in ALIKE
        ]
        return [np.array(each) for each in own if any(each)]

    @property
    def log_count(self) -> float:
        return len(self._alike) * float(np.log(len(AMPLITUDES)))

    def weightings(self) -> Iterator[FloatArray]:
        """(n,) noise over noise and discrepancy, for every choice of amplitudes."""
        alike = self._alike
        for amplitudes in product(AMPLITUDES, repeat=len(alike)):
            ratios = sum((a * each for a, each in zip(amplitudes, alike, strict=True)), np.zeros(1))
            yield 1 / np.sqrt(1 + ratios**2) * np.ones(len(self.features))

    def log_evidence(self, weights: FloatArray) -> float:
        """ln Z at given discrepancies."""
        J, deviations = self.jacobian * weights[:, None], self.deviations * weights
        information = J.T @ J
        gradient = J.T @ deviations + self.prior_weights * self.z
        step = -np.linalg.solve(information + np.diag(self.prior_weights), gradient)
        # one gross error is none of the discrepancies, and costs here what it costs an effect
        left = deviations + J @ step
        rest = np.array(
            [held_down(r) if _may_be_off(f) else r for f, r in zip(self.features, left, strict=True)]
        )
        z = self.z + step
        objective = rest @ rest + self.prior_weights @ z**2 + self.missed
        return float(-0.5 * objective + np.sum(np.log(weights)) + log_volume(information, self.prior_weights))


def _may_be_off(feature: Feature) -> bool:
    """Whether a discrepancy is thought of: loss factors, shapes, densities and lost modes count as ever."""
    return feature.kind in ALIKE and not feature.lost
