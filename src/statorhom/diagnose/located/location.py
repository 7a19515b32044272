"""Where an effect sits: angle with its true ambiguity, and height, from the explanation's optimum."""

from __future__ import annotations

import numpy as np

from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.located.mirrored import height_is_told, mirrored
from statorhom.diagnose.located.opposite import equivalent_angles, told_apart
from statorhom.results.diagnosis import Location
from statorhom.study.study_file import FREE

UNTOLD = 0.5  # rad: standard deviation from which on an angle is not known


def located(explanation: Explanation, number: int) -> Location | None:
    """Location of one of the explanation's effects; None where it has none."""
    candidate = explanation.candidates[number]
    r = explanation.refit
    if not candidate.located or not _tells_places(explanation, number):
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
        z_sd_mm=None if place is None else 1e3 * _height_sd(explanation, number, place, sd["z_m"]),
    )


def _height_sd(explanation: Explanation, number: int, place: float, sd: float) -> float:
    """Standard deviation of a height (m); of both heights together where the mirrored one is as likely."""
    other = mirrored(explanation, number)
    if other is not None and not height_is_told(explanation, number):
        away = other.refit.hypothesis.effect_values(other.refit.z)[number]["z_m"] - place
        sd = float(np.hypot(sd, away / 2))
    return min(sd, max(p.upper for p in explanation.candidates[number].parameters if p.name == "z_m"))


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
