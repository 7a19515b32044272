"""Where on a coupon an effect is, and at which mirrored places it would look the same."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np

from statorhom.diagnose.coupons.body_hypothesis import BodyHypothesis
from statorhom.diagnose.explanations import Explanation
from statorhom.diagnose.refit import Refit, refit_objective
from statorhom.errors import StatorhomError
from statorhom.results.diagnosis import PlanLocation

ALIKE = 6.0  # of the objective: places that differ by less are not told apart (1 : 20)


def body_located(explanation: Explanation[BodyHypothesis], number: int) -> PlanLocation | None:
    """Location of one of the explanation's effects; None where it has none."""
    candidate = explanation.candidates[number]
    if not any(p.located for p in candidate.parameters):
        return None
    r = explanation.refit
    values, sd = r.hypothesis.effect_values(r.z)[number], _deviations(r, number)
    return PlanLocation(
        x_mm=1e3 * values["x_m"],
        x_sd_mm=1e3 * sd["x_m"],
        y_mm=1e3 * values["y_m"],
        y_sd_mm=1e3 * sd["y_m"],
        place_ambiguity_mm=_alike(r, number),
    )


def _deviations(r: Refit[BodyHypothesis], number: int) -> dict[str, float]:
    found = {}
    for k, (i, j) in enumerate(r.hypothesis.parameters):
        parameter = r.hypothesis.candidates[i].parameters[j]
        if i == number and parameter.located:
            unit = (parameter.upper - parameter.lower) / np.sqrt(12)
            at = r.hypothesis.constants + k
            found[parameter.name] = float(unit * np.sqrt(max(r.covariance[at, at], 0.0)))
    return found


def _alike(r: Refit[BodyHypothesis], number: int) -> tuple[tuple[float, float], ...]:
    """The place and its mirror images that the data do not tell from it, all effects mirrored together."""
    found = []
    for flips in product((False, True), repeat=2):
        z = r.z.copy()
        place = {}
        for k, (i, j) in enumerate(r.hypothesis.parameters):
            parameter = r.hypothesis.candidates[i].parameters[j]
            at = r.hypothesis.constants + k
            flipped = {"x_m": flips[0], "y_m": flips[1]}.get(parameter.name, False)
            value = parameter.value(float(z[at]))
            if flipped and not _mirrors_itself(r, i, parameter.name):
                value = parameter.lower + parameter.upper - value
                z[at] = parameter.internal(value)
            if i == number:
                place[parameter.name] = value
        try:
            worse = refit_objective(replace(r.hypothesis, held=None), z) - r.objective
        except StatorhomError:
            continue
        pair = (round(1e3 * place["x_m"], 3), round(1e3 * place["y_m"], 3))
        if (worse < ALIKE or not any(flips)) and pair not in found:
            found.append(pair)
    return tuple(found)


def _mirrors_itself(r: Refit[BodyHypothesis], number: int, name: str) -> bool:
    """Whether an effect that is at x is at its mirror image too: springs on both sides."""
    parameter = next(p for p in r.hypothesis.candidates[number].parameters if p.name == name)
    whole = max(p.upper for c in r.hypothesis.candidates for p in c.parameters if p.name == name)
    return parameter.upper < 0.75 * whole
