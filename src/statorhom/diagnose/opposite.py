"""Which of the angles that doublets do not tell apart is the right one: the other orders in the shapes know.

A feature at θ and one at θ + π split all doublets alike, but what they couple to orders of the other parity has the
opposite sign (physics.md §5). So every measured shape is compared with the plane of the predicted modes around its
frequency, at each of the angles.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.diagnose.explanations import Explanation
from statorhom.diagnose.measured import MeasuredTest
from statorhom.diagnose.stage_model import StageModel
from statorhom.model.broken.change import Change
from statorhom.model.broken.solve import solve_broken
from statorhom.model.surface import surface_points
from statorhom.physics.library import library

NEAR = 0.02  # of the frequency: modes whose plane a shape is compared with


def likeliest_first(explanation: Explanation, number: int, angles_rad: Sequence[float]) -> tuple[float, ...]:
    """Angles in the order of how well the measured shapes fit them; as given where no shapes were measured."""
    if len(angles_rad) < 2:
        return tuple(angles_rad)
    scores = [_misfit(explanation, number, angle) for angle in angles_rad]
    if any(score is None for score in scores):
        return tuple(angles_rad)
    order = np.argsort([score for score in scores if score is not None], kind="stable")
    return tuple(angles_rad[i] for i in order)


def _misfit(explanation: Explanation, number: int, angle: float) -> float | None:
    """Sum over all shapes of the part that the predicted modes leave; None without shapes."""
    r = explanation.refit
    candidate = explanation.candidates[number]
    values = {**r.hypothesis.effect_values(r.z)[number], "angle_rad": angle}
    action = library()[candidate.effect].action(candidate, values, r.hypothesis.study.files)
    total, seen = 0.0, False
    for stage in r.hypothesis.study.stages:
        for test in stage.tests:
            if (
                action.changes
                and test.shapes is not None
                and test.support == "free"
                and action.touches(stage.name, test.name)
            ):
                total += _left(stage, test, action.changes(stage.model.mesh, stage.reference))
                seen = True
    return total if seen else None


def _left(stage: StageModel, test: MeasuredTest, changes: Sequence[Change]) -> float:
    shapes = test.shapes
    assert shapes is not None
    z, theta = (a.ravel() for a in np.meshgrid(shapes.z_m, shapes.angles_rad, indexing="ij"))
    modes = solve_broken(stage.broken, changes, tolerance=None)
    motion = modes.shapes.motion(surface_points(stage.model.mesh, theta, z))[:, 0]
    frequency = {m.label: m.frequency_hz for m in test.modes}
    total = 0.0
    for label, radial in zip(shapes.labels, shapes.radial, strict=True):
        measured = radial.ravel()
        known = np.isfinite(measured)
        near = np.abs(np.log(modes.frequencies_hz / frequency[label])) < NEAR
        if label not in frequency or not near.any() or known.sum() <= near.sum():
            continue
        solution = np.linalg.lstsq(motion[known][:, near], measured[known], rcond=None)[0]
        rest = measured[known] - motion[known][:, near] @ solution
        total += float(rest @ rest / (measured[known] @ measured[known]))
    return total
