"""Where an effect sits: angle with its true ambiguity, and height, from the explanation's optimum."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.diagnose.explanations import Explanation
from statorhom.diagnose.features import Feature
from statorhom.diagnose.opposite import told_apart
from statorhom.physics.candidate import Candidate
from statorhom.results.diagnosis import Location
from statorhom.study.study_file import FREE

UNTOLD = 0.5  # rad: standard deviation from which on an angle is not known
TOLD = 3.0  # standard deviations of a split from which on it tells an angle


def located(explanation: Explanation, number: int) -> Location | None:
    """Location of one of the explanation's effects; None where it has none."""
    candidate = explanation.candidates[number]
    r = explanation.refit
    if not any(p.located for p in candidate.parameters) or not _tells_places(explanation, number):
        return None
    values = r.hypothesis.effect_values(r.z)[number]
    sd = _deviations(explanation, number)
    angle, place = values.get("angle_rad"), values.get("z_m")
    told = angle is not None and sd["angle_rad"] < UNTOLD
    same: tuple[float, ...] = ()
    if angle is not None and told:
        same = told_apart(explanation, number, equivalent_angles(explanation, number)).angles_rad
    degrees = tuple(round(float(np.rad2deg(a)), 3) for a in same)
    return Location(
        angle_deg=degrees[0] if degrees else None,
        angle_sd_deg=float(np.rad2deg(sd["angle_rad"])) if degrees else None,
        angle_ambiguity_deg=degrees,
        z_mm=None if place is None else 1e3 * place,
        z_sd_mm=None if place is None else 1e3 * min(sd["z_m"], candidate.parameters[-1].upper),
    )


def equivalent_angles(explanation: Explanation, number: int) -> tuple[float, ...]:
    """Angles (rad) that the measured splits do not tell from an effect's own; none where it has no angle."""
    r, candidate = explanation.refit, explanation.candidates[number]
    angle = r.hypothesis.effect_values(r.z)[number].get("angle_rad")
    return () if angle is None else _equivalent(candidate, r.hypothesis.features(r.z), angle)


def _tells_places(explanation: Explanation, number: int) -> bool:
    """Whether a test that sees the effect has shapes or a support: bare frequencies of a free ring tell no place."""
    r = explanation.refit
    action = r.hypothesis.actions(r.z)[number]
    return any(
        (test.support != FREE or test.splits or test.shapes is not None)
        and action.touches(stage.name, test.name)
        for stage in r.hypothesis.study.stages
        for test in stage.tests
    )


def _deviations(explanation: Explanation, number: int) -> dict[str, float]:
    r = explanation.refit
    covariance = r.covariance
    found = {}
    for k, (i, j) in enumerate(r.hypothesis.parameters):
        parameter = r.hypothesis.candidates[i].parameters[j]
        if i == number and parameter.located:
            unit = (parameter.upper - parameter.lower) / np.sqrt(12)
            place = r.hypothesis.constants + k
            found[parameter.name] = float(unit * np.sqrt(max(covariance[place, place], 0.0)))
    return found


def _equivalent(candidate: Candidate, features: Sequence[Feature], angle: float) -> tuple[float, ...]:
    """Angles (rad) that the measured splits do not tell apart: the orders' common period."""
    orders = {
        f.key[0]
        for f in features
        if f.kind == "split" and f.key and f.sd < 0.5 and abs(f.measured) > TOLD * f.sd
    }
    period = next(p.upper - p.lower for p in candidate.parameters if p.name == "angle_rad")
    repeats = int(np.gcd.reduce([2 * r for r in orders])) if orders else 1
    if period < 2 * np.pi - 1e-9:
        return (angle,)
    return tuple(float(a) for a in (angle + 2 * np.pi * np.arange(repeats) / repeats) % (2 * np.pi))
