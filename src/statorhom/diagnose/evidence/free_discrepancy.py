"""Evidence of "something that is not in the library": each mode off by chance, the constants free.

An effect that is not in the library looks like one that is: a mass on a spring like a rigid one, a patchwork like an
oval yoke. Each explains most of the misfit with a few parameters, and the rest is hardly more than noise. What such a
name has to beat is a discrepancy that is drawn for every mode anew and explains nothing (physics.md §8; Brynjarsdóttir
& O'Hagan 2014): frequencies, splits and shifts are off by normal deviates, and how large those usually are is not
known. An effect that is really there says what each mode does, and a discrepancy pays for every one of them: where it
parts the lines of one doublet it parts those of the others too, and of these a single line was measured.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from itertools import product

import numpy as np
import numpy.typing as npt
from scipy.special import logsumexp
from scipy.stats import chi

from statorhom.diagnose.fits.any_hypothesis import AnyHypothesis
from statorhom.diagnose.fits.refit import Refit, log_volume
from statorhom.diagnose.measured.feature import Feature, Silence, held_down

FloatArray = npt.NDArray[np.float64]

# relative to the frequency, or to λ: from what no test resolves to a tenth, every half of a decade equally likely
AMPLITUDES = np.logspace(-5, -1, 9)
# kinds, each with an amplitude of its own: one cause that parts doublets may leave their means as they are
ALIKE = ("frequency", "split", "shift")
LEAST_STEEPNESS = 1e-3
SIZES = (np.arange(50) + 0.5) / 50  # quantiles over which the splits of silent doublets are averaged


def discrepancy_evidence(base: Refit[AnyHypothesis]) -> float:
    """ln Z of the declared model with a free discrepancy, as `Refit.log_evidence` counts it.

    The constants are refitted to first order about the declared model's optimum, with every amplitude of the
    discrepancies; the evidence is the mean over those.
    """
    problem = _Linear.of(base)
    return float(logsumexp([problem.log_evidence(a) for a in problem.amplitudes()])) - problem.log_count


@dataclass(frozen=True, eq=False)
class _Linear:
    """A declared model about its optimum.

    Parameters
    ----------
    features : n residuals.
    deviations : (n,) in standard deviations; where no discrepancy is thought of, the residuals as they count.
    jacobian : (n, constants) of these.
    z, prior_weights : optimum and its prior's precision.
    charge, doubt : as of the hypothesis and of the refit.
    """

    features: Sequence[Feature]
    deviations: FloatArray
    jacobian: FloatArray
    z: FloatArray
    prior_weights: FloatArray
    charge: float
    doubt: float

    @classmethod
    def of(cls, base: Refit[AnyHypothesis]) -> _Linear:
        features = base.hypothesis.features(base.z)
        # what is far off is held down for the declared model alone: a discrepancy sees all of it
        deviations = [f.deviation if _may_be_off(f) else f.residual for f in features]
        steepness = np.array([f.steepness if _may_be_off(f) else 1.0 for f in features])
        jacobian = base.jacobian / np.maximum(steepness, LEAST_STEEPNESS)[:, None]
        weights, charge = base.hypothesis.prior_weights, base.hypothesis.charge(base.z)
        return cls(features, np.array(deviations), jacobian, base.z, weights, charge, base.doubt)

    @property
    def _kinds(self) -> list[str]:
        """Kinds of which something was measured that a discrepancy is of."""
        return [kind for kind in ALIKE if any(f.kind == kind for f in self.features if _may_be_off(f))]

    @property
    def log_count(self) -> float:
        return len(self._kinds) * float(np.log(len(AMPLITUDES)))

    def amplitudes(self) -> Iterator[Mapping[str, float]]:
        """Every choice of the discrepancies' standard deviations, kind by kind."""
        kinds = self._kinds
        for chosen in product(AMPLITUDES, repeat=len(kinds)):
            yield dict(zip(kinds, chosen, strict=True))

    def log_evidence(self, amplitudes: Mapping[str, float]) -> float:
        """ln Z at given discrepancies."""
        off = [amplitudes[f.kind] / f.sd if _may_be_off(f) else 0.0 for f in self.features]
        weights = 1 / np.hypot(1.0, off)  # noise over noise and discrepancy
        J, deviations = self.jacobian * weights[:, None], self.deviations * weights
        information = J.T @ J
        gradient = J.T @ deviations + self.prior_weights * self.z
        step = -np.linalg.solve(information + np.diag(self.prior_weights), gradient)
        left = deviations + J @ step
        z = self.z + step
        objective = sum(map(partial(_cost, amplitudes), self.features, left)) + self.charge
        objective += float(self.prior_weights @ z**2)
        likelihood = -0.5 * objective + float(np.sum(np.log(weights))) - self.doubt
        return likelihood + log_volume(information, self.prior_weights)


def _cost(amplitudes: Mapping[str, float], feature: Feature, left: float) -> float:
    """-2 ln of what a residual makes of the likelihood."""
    if feature.silence is not None:
        return _silent_cost(feature.silence, amplitudes.get(feature.kind, 0.0))
    # one gross error is none of the discrepancies, and costs here what it costs an effect
    return float((held_down(left) if _may_be_off(feature) else left) ** 2)


@lru_cache(maxsize=2**12)
def _silent_cost(silence: Silence, amplitude: float) -> float:
    """Of a doublet whose lines a discrepancy parts as it does others', though one alone was measured."""
    parted = silence.residual(amplitude * chi.ppf(SIZES, silence.parts))
    return float(-2 * np.log(np.mean(np.exp(-0.5 * parted**2))))


def _may_be_off(feature: Feature) -> bool:
    """Whether it is a number that a discrepancy moves: loss factors, shapes, densities and lost modes count as ever."""
    return feature.kind in ALIKE and not feature.lost and feature.silence is None
