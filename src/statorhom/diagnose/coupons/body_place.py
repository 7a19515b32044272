"""Where on a coupon an effect is, and at which mirrored places it would look the same."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.coupons.body_hypothesis import BodyHypothesis
from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.fits.refit import Refit, refit_objective
from statorhom.errors import StatorhomError
from statorhom.physics.plan import Plan, plan_of
from statorhom.results.diagnosis import PlanLocation

FloatArray = npt.NDArray[np.float64]

ALIKE = 6.0  # of the objective: places that differ by less are not told apart (1 : 20)
STEP = 1e-3  # of internal coordinates


def body_located(explanation: Explanation[BodyHypothesis], number: int) -> PlanLocation | None:
    """Location of one of the explanation's effects; None where it has none."""
    r = explanation.refit
    plan = plan_of(r.hypothesis.study.files)
    at = _coordinates(r, number)
    if plan is None or not at:
        return None
    place = _place(r, plan, number, r.z)
    slopes = np.array(
        [(_place(r, plan, number, r.z + STEP * e) - place) / STEP for e in np.eye(len(r.z))[at]]
    )
    sd = np.sqrt(np.maximum(np.diag(slopes.T @ r.covariance[np.ix_(at, at)] @ slopes), 0.0))
    return PlanLocation(
        x_mm=1e3 * float(place[0]),
        x_sd_mm=1e3 * float(sd[0]),
        y_mm=1e3 * float(place[1]),
        y_sd_mm=1e3 * float(sd[1]),
        place_ambiguity_mm=_alike(r, plan, number),
    )


def _coordinates(r: Refit[BodyHypothesis], number: int) -> list[int]:
    """Of an effect's place in the vector."""
    h = r.hypothesis
    return [
        h.constants + k
        for k, (i, j) in enumerate(h.parameters)
        if i == number and h.candidates[i].parameters[j].located
    ]


def _place(r: Refit[BodyHypothesis], plan: Plan, number: int, z: FloatArray) -> FloatArray:
    return np.array(plan.on_top(r.hypothesis.effect_values(z)[number])[:2])


def _alike(r: Refit[BodyHypothesis], plan: Plan, number: int) -> tuple[tuple[float, float], ...]:
    """The place and its mirror images that the data do not tell from it, all effects mirrored together."""
    found: list[tuple[float, float]] = []
    for flips in product((False, True), repeat=len(plan.mirrored)):
        names = {name for name, flipped in zip(plan.mirrored, flips, strict=True) if flipped}
        z = _mirrored(r, plan, names)
        try:
            worse = refit_objective(replace(r.hypothesis, held=None), z) - r.objective
        except StatorhomError:
            continue
        x, y = (1e3 * _place(r, plan, number, z)).round(3).tolist()
        if (worse < ALIKE or not names) and (x, y) not in found:
            found.append((x, y))
    return tuple(found)


def _mirrored(r: Refit[BodyHypothesis], plan: Plan, names: set[str]) -> FloatArray:
    """The vector with some coordinates of all places mirrored; what stands on both sides is its own image."""
    whole = plan.places()
    z = r.z.copy()
    for k, (i, j) in enumerate(r.hypothesis.parameters):
        p = r.hypothesis.candidates[i].parameters[j]
        at = r.hypothesis.constants + k
        if p.name in names and p in whole:
            z[at] = p.internal(p.lower + p.upper - p.value(float(z[at])))
    return z
