"""Which of two heights that mirror each other about the core's middle: only shapes tell.

A stator that is its own mirror image has the same frequencies and splits with a feature at z and at L - z. What the
feature couples to modes of the other axial parity has the opposite sign, so the measured shapes decide, as they do
between angles (`statorhom.diagnose.located.opposite`).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from statorhom.diagnose.fits.explanations import Explanation, explained, refitted
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.located.opposite import (
    LEAST_SHAPES,
    LEAST_WORSE,
    SURE,
    equivalent_angles,
    left_of_all,
)
from statorhom.physics.parameter import EffectParameter


def at_likelier_height(explanation: Explanation) -> Explanation:
    """With every effect at the height, of the two that mirror each other, that the measured shapes fit better."""
    for number in range(len(explanation.candidates)):
        other = mirrored(explanation, number)
        if other is not None and (worse := _worse(explanation, other, number)) is not None and worse[0] < 0:
            explanation = other
    return explanation


def at_fitting_height(best: Refit, worth: float = np.inf) -> Refit:
    """An optimum, or the one with effects on the other side of the middle where the leans of shapes prefer that.

    A refit does not get from one to the other: leans that have the wrong sign hardly say anything of where to go.

    Parameters
    ----------
    best : the optimum.
    worth : objective above which another one matters to nobody.
    """
    if not any(f.kind == "lean" for f in best.hypothesis.features(best.z)):
        return best
    for number in range(len(best.hypothesis.candidates)):
        other = mirrored(explained(best, {}), number)
        if other is None:
            continue
        there = refitted(replace(best.hypothesis, held=None), other.refit.z, min(best.objective, worth))
        if there is not None and there.objective < best.objective:
            best = there
    return best


def height_is_told(explanation: Explanation, number: int) -> bool:
    """Whether an effect's height is not as likely mirrored."""
    other = mirrored(explanation, number)
    if other is None:
        return True
    worse = _worse(explanation, other, number)
    return worse is not None and worse[0] > max(SURE * worse[1], LEAST_WORSE)


def mirrored(explanation: Explanation, number: int) -> Explanation | None:
    """With one effect on the other side of the middle; None where it has no height, or the ends differ."""
    r = explanation.refit
    h = r.hypothesis
    place = height_place(explanation, number)
    action = h.actions(r.z)[number]
    touched = [s for s in h.study.stages if any(action.touches(s.name, t.name) for t in s.tests)]
    if place is None or not all(s.mirrors for s in touched):
        return None
    k, parameter = place
    z, J = r.z.copy(), r.jacobian.copy()
    z[k] = parameter.internal(parameter.lower + parameter.upper - parameter.value(float(z[k])))
    J[:, k] *= -1
    return replace(explanation, refit=replace(r, z=z, jacobian=J))


def height_place(explanation: Explanation, number: int) -> tuple[int, EffectParameter] | None:
    """Where an effect's height stands in the vector, and its parameter; None where it has none."""
    h = explanation.refit.hypothesis
    for k, (i, j) in enumerate(h.parameters):
        parameter = h.candidates[i].parameters[j]
        if i == number and parameter.scale == "place":
            return h.constants + k, parameter
    return None


def _worse(here: Explanation, there: Explanation, number: int) -> tuple[float, float] | None:
    """How much worse the other height is, each at its best angle: mean of ln of what is left and its standard error."""
    best = []
    for one in (here, there):
        angles = equivalent_angles(one, number) or (None,)
        logs = np.log(np.array([left_of_all(one, number, angle) for angle in angles]))
        if logs.shape[1] < LEAST_SHAPES:
            return None
        best.append(logs[int(np.argmin(logs.mean(axis=1)))])
    worse = best[1] - best[0]
    return float(worse.mean()), float(worse.std(ddof=1) / np.sqrt(len(worse)))
