"""Does the same explanation win when data and beliefs are varied? By linearized refits of the best explanations."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.evidence.decision import OVER_NOTHING, OVER_OTHERS
from statorhom.diagnose.evidence.held_out_modes import WEIGHED
from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.fits.refit import Refit, bounded_step, log_volume
from statorhom.model.convergence import ModeKey

FloatArray = npt.NDArray[np.float64]
# Factors of standard deviations and of prior widths: each belief is varied by itself, and as often as none is. That
# all of them are wrong at once is no reason to doubt a name.
VARIED = ((1.0, 1.0), (0.5, 1.0), (2.0, 1.0), (1.0, 0.5), (1.0, 2.0))
DRAWS = 20  # of modes, for each of them
KEPT = 0.8  # of the modes in each draw

Observed = tuple[str, str | ModeKey | None]
# What densities can be is known beforehand and no datum that a repeated measurement might lack.
KNOWN: frozenset[Observed] = frozenset([WEIGHED])


def stability(explanations: Sequence[Explanation], seed: int) -> float:
    """Share of resamplings that the first of the explanations wins, of those in which something is detected.

    Without the few modes that show an effect nothing is detected: that is no other winner. Neither is a rival that
    does not lead by more than what tells two explanations apart.

    Parameters
    ----------
    explanations : the winner, "nothing" and the best others.
    """
    if len(explanations) < 3:
        return 1.0
    refits = [e.compared or e.refit for e in explanations]
    features = [r.hypothesis.features(r.z) for r in refits]
    observed = [[f.observed for f in own] for own in features]
    doubts = [np.array([f.doubt for f in own]) for own in features]
    residuals = [r.hypothesis.residuals(r.z) for r in refits]
    units = _units([rows for part in observed for rows in part if rows != KNOWN])
    rng = np.random.default_rng(seed)
    outcomes = []
    for noise, width in VARIED * DRAWS:
        kept = rng.permutation(len(units))[: max(2, round(KEPT * len(units)))]
        chosen = KNOWN.union(*(units[i] for i in kept))
        scores = []
        for e, own, r, left, doubt in zip(explanations, observed, refits, residuals, doubts, strict=True):
            rows = np.array([one <= chosen for one in own])
            # an explanation's features may differ in number; what it says beside them is common to all
            beside = e.log_evidence - r.log_evidence - float(doubt[rows].sum())
            scores.append(resampled_evidence(r, left, rows, noise, width) + beside)
        outcomes.append(wins(scores))
    counted = [won for won in outcomes if won is not None]
    return float(np.mean(counted)) if counted else 1.0


def _units(observed: Sequence[frozenset[Observed]]) -> list[frozenset[Observed]]:
    """What is drawn together: lines that any explanation takes for one doublet, in a fixed order."""
    units: list[frozenset[Observed]] = []
    for rows in observed:
        apart = [unit for unit in units if not unit & rows]
        units = [*apart, rows.union(*(unit for unit in units if unit & rows))]
    return sorted(units, key=lambda unit: sorted(map(str, unit)))


def wins(scores: Sequence[float]) -> bool | None:
    """Whether the first wins; None where nothing is detected. The second is "nothing", the rest are rivals."""
    first, none, rival = scores[0], scores[1], max(scores[2:])
    if max(first, rival) - none <= OVER_NOTHING:
        return None
    return rival - first <= OVER_OTHERS


def resampled_evidence(
    r: Refit, residuals: FloatArray, rows: npt.NDArray[np.bool_], noise: float, width: float
) -> float:
    """Laplace evidence with some rows, other noise and other prior widths, after one Gauss–Newton step.

    It stays within the limits of the coordinates: a declared model that would explain by an impossible winding has no
    better one to go to when lines are left out.
    """
    J, e = r.jacobian[rows] / noise, residuals[rows] / noise
    prior = r.hypothesis.prior_weights
    weights = prior / width**2
    information = J.T @ J
    low, high = r.hypothesis.limits()
    H, gradient = information + np.diag(weights + 1e-9), J.T @ e + weights * r.z
    step = bounded_step(H, gradient, low - r.z, high - r.z)
    left, z = e + J @ step, r.z + step
    charge = r.hypothesis.missed + float(np.sum(r.hypothesis.charges(r.z)[rows] ** 2))
    objective = float(left @ left + np.sum(weights * z**2)) + charge
    scale = -float(np.sum(prior > 0.0)) * float(np.log(width))
    return -0.5 * objective + log_volume(information, weights) + scale
