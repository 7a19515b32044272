"""Held-out error of single lines: one line of each doublet, predicted from the other one and from all other modes.

Where one doublet alone shows an effect, no other mode tells how large that is, but one of its lines does: the other
line is unseen. To first order about the optimum.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.evidence.decision import too_few
from statorhom.diagnose.evidence.held_out import Group, HeldOut
from statorhom.diagnose.evidence.held_out_modes import Error, held_out, noise_of
from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.fits.refit import Refit, covariance_of
from statorhom.diagnose.measured.feature import Feature

WHAT = "one line of each doublet, predicted from the other line and from all other modes"
QUARTER = 0.25  # of the split of λ, by which a line's ln f lies beside the mean

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class _Line:
    """One line of a doublet: ln f measured less predicted, its standard deviation, and its derivative by all."""

    left: float
    sd: float
    slopes: FloatArray


def unseen_modes(base: Refit, explanation: Explanation) -> HeldOut:
    """Whole modes held out; where too few of them show what is missing, single lines, if these confirm it."""
    modes = held_out(base, explanation)
    if modes.falls or not too_few(modes):
        return modes
    lines = held_out_lines(base, explanation)
    return lines if lines.falls and not lines.worsens else modes


def held_out_lines(base: Refit, explanation: Explanation) -> HeldOut:
    """Errors of the lines of all doublets of which both explanations have a mode."""
    before, after = (dict(_errors(r)) for r in (base, explanation.refit))
    aside = explanation.set_aside
    both = [line for line in before if line in after and line[0] not in aside]
    return HeldOut(
        tuple(group for group, _ in both),
        tuple(before[line].error for line in both),
        tuple(after[line].error for line in both),
        tuple(noise_of(before[line], after[line]) for line in both),
        WHAT,
        of_lines=True,
    )


def _errors(r: Refit) -> Iterator[tuple[tuple[Group, int], Error]]:
    """Of both lines of every doublet."""
    features = r.hypothesis.features(r.z)
    residuals = r.hypothesis.residuals(r.z)
    for group in dict.fromkeys(f.group for f in features if f.kind == "split" and not f.lost):
        own = np.array([f.group == group for f in features])
        lines = _lines([f for f in features if f.group == group], r.jacobian[own])
        for number, unseen in enumerate(lines):
            seen = lines[1 - number]
            yield (group, number), _predicted(r, residuals[~own], r.jacobian[~own], seen, unseen)


def _lines(features: list[Feature], jacobian: FloatArray) -> list[_Line]:
    """Lower and upper line of a doublet; none where not both were measured."""
    rates = [-f.sd * row / f.steepness for f, row in zip(features, jacobian, strict=True)]
    mean = [i for i, f in enumerate(features) if f.kind == "frequency" and not f.lost]
    split = [i for i, f in enumerate(features) if f.kind == "split"]
    size = float(np.linalg.norm([features[i].measured for i in split]))
    if len(mean) != 1 or size == 0.0:
        return []
    middle = features[mean[0]]
    # along the split that was measured: of a table its size alone
    along = {i: QUARTER * features[i].measured / size for i in split}
    away = sum(part * (features[i].measured - features[i].predicted) for i, part in along.items())
    slope = sum((part * rates[i] for i, part in along.items()), np.zeros(jacobian.shape[1]))
    sd = float(np.hypot(middle.sd, QUARTER * features[split[0]].sd))
    return [
        _Line(middle.measured - middle.predicted + side * away, sd, rates[mean[0]] + side * slope)
        for side in (-1.0, 1.0)
    ]


def _predicted(r: Refit, residuals: FloatArray, jacobian: FloatArray, seen: _Line, unseen: _Line) -> Error:
    """The unseen line after a Gauss–Newton step of the rest."""
    J = np.vstack([jacobian, -seen.slopes / seen.sd])
    left = np.r_[residuals, seen.left / seen.sd]
    weights = r.hypothesis.prior_weights
    covariance = covariance_of(J, weights)
    step = -covariance @ (J.T @ left + weights * r.z)
    error = abs(unseen.left - float(unseen.slopes @ step))
    spread = float(np.sqrt(unseen.slopes @ covariance @ unseen.slopes))
    return Error(100 * error, 100 * unseen.sd, 100 * spread)
