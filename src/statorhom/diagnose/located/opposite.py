"""Which of the angles that doublets do not tell apart is the right one: the other orders in the shapes know.

A feature at θ and one at θ + π split all doublets alike, but what they couple to orders of the other parity has the
opposite sign (physics.md §5). So every measured shape is compared with the plane of the predicted modes around its
frequency, at each of the angles.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.broken.change import Change
from statorhom.model.broken.solve import solve_broken
from statorhom.model.surface import surface_points
from statorhom.physics.candidate import Candidate
from statorhom.physics.library import library
from statorhom.study.study_file import FREE

NEAR = 0.02  # of the frequency: modes whose plane a shape is compared with
FLOOR = 1e-6  # part of a shape that is never explained
SURE = 3.0  # standard errors by which the shapes must prefer one angle to exclude another
LEAST_WORSE = 0.05  # and the least mean of ln of what is left: less is no more than a model's error
LEAST_SHAPES = 4
TOLD = 3.0  # standard deviations of a split from which on it tells an angle


@dataclass(frozen=True)
class Told:
    """Angles that splits do not tell apart, by what the shapes say.

    Parameters
    ----------
    angles_rad : the likeliest first; those that the shapes exclude are left out.
    excluded_rad : these.
    likelihood_ratio : of the likeliest against the next one, mean of ln over the shapes and its standard error;
        None where no shapes were measured.
    """

    angles_rad: tuple[float, ...]
    excluded_rad: tuple[float, ...] = ()
    likelihood_ratio: tuple[float, float] | None = None


def told_apart(explanation: Explanation, number: int, angles_rad: Sequence[float]) -> Told:
    """Angles in the order of how well the measured shapes fit them.

    One is excluded when the shapes prefer another: the mean over all shapes of the logarithm of what each leaves
    unexplained is larger by `SURE` standard errors.
    """
    if len(angles_rad) < 2:
        return Told(tuple(angles_rad))
    left = np.array([left_of_all(explanation, number, angle) for angle in angles_rad])
    if left.shape[1] < LEAST_SHAPES:
        return Told(tuple(angles_rad))
    return ranked(tuple(angles_rad), left)


def ranked(angles_rad: Sequence[float], left: np.ndarray) -> Told:
    """Angles by the parts (angles, shapes) that they leave of every shape."""
    logs = np.log(left)
    order = np.argsort(logs.mean(axis=1), kind="stable")
    best = order[0]
    kept: list[float] = [angles_rad[best]]
    excluded: list[float] = []
    first: tuple[float, float] | None = None
    for i in order[1:]:
        worse = logs[i] - logs[best]
        mean, error = float(worse.mean()), float(worse.std(ddof=1) / np.sqrt(len(worse)))
        first = first or (mean, error)
        (excluded if mean > SURE * error and mean > LEAST_WORSE else kept).append(angles_rad[i])
    return Told(tuple(kept), tuple(excluded), first)


def left_of_all(explanation: Explanation, number: int, angle: float | None) -> list[float]:
    """Part of every measured shape that the predicted modes around it leave; None: the effect's own angle."""
    r = explanation.refit
    candidate = explanation.candidates[number]
    values = dict(r.hypothesis.effect_values(r.z)[number])
    if angle is not None:
        values["angle_rad"] = angle
    action = library()[candidate.effect].action(candidate, values, r.hypothesis.study.files)
    found: list[float] = []
    for stage in r.hypothesis.study.stages:
        for test in stage.tests:
            if (
                action.changes
                and test.shapes is not None
                and test.support == FREE
                and action.touches(stage.name, test.name)
            ):
                found += _left(stage, test, action.changes(stage.model.mesh, stage.reference))
    return found


def _left(stage: StageModel, test: MeasuredTest, changes: Sequence[Change]) -> list[float]:
    shapes = test.shapes
    assert shapes is not None
    z, theta = (a.ravel() for a in np.meshgrid(shapes.z_m, shapes.angles_rad, indexing="ij"))
    modes = solve_broken(stage.broken, changes, tolerance=None)
    motion = modes.shapes.motion(surface_points(stage.model.mesh, theta, z))[:, 0]
    frequency = {m.label: m.frequency_hz for m in test.modes}
    found = []
    for label, radial in zip(shapes.labels, shapes.radial, strict=True):
        measured = radial.ravel()
        known = np.isfinite(measured)
        near = np.abs(np.log(modes.frequencies_hz / frequency.get(label, np.nan))) < NEAR
        if not near.any() or known.sum() <= near.sum():
            # the place is kept, so that all angles speak of the same shapes
            found.append(1.0)
            continue
        solution = np.linalg.lstsq(motion[known][:, near], measured[known], rcond=None)[0]
        rest = measured[known] - motion[known][:, near] @ solution
        found.append(max(float(rest @ rest / (measured[known] @ measured[known])), FLOOR))
    return found


def equivalent_angles(explanation: Explanation, number: int) -> tuple[float, ...]:
    """Angles (rad) that the measured splits do not tell from an effect's own; none where it has no angle."""
    r, candidate = explanation.refit, explanation.candidates[number]
    angle = r.hypothesis.effect_values(r.z)[number].get("angle_rad")
    return () if angle is None else _equivalent(candidate, r.hypothesis.features(r.z), angle)


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
