"""Ladders: the same test at several hammer forces, or at several clamping forces."""

from __future__ import annotations

from dataclasses import replace

from statorhom.diagnose.features.supported import supported_test
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.next_measurement.option import Option, Predict, Told
from statorhom.diagnose.next_measurement.view import View
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.physics.action import Action
from statorhom.study.study_file import FREE

LEVEL_SD = 2e-4  # relative, of a frequency's change between two levels
CLAMP_SD = 2e-3  # the same between two clamping forces
STIFFER = 1.4  # an elastic clamp at twice the force: rough contacts stiffen about with its root
MODES = 6


def options(refit: Refit) -> list[Option]:
    """Force levels for every test without them, clamping forces for every supported one."""
    found = []
    for stage in refit.hypothesis.study.stages:
        for test in stage.tests:
            what = f"test {test.name} again at three hammer forces, each a third of the one before"
            found.append(Option(what, 1.0, _levels(stage, test)))
            if test.support != FREE:
                what = f"test {test.name} again with twice the clamping force"
                found.append(Option(what, 1.0, _clamps(stage, test)))
    return found


def _levels(stage: StageModel, test: MeasuredTest) -> Predict:
    def predict(view: View) -> Told:
        fall = sum(slip_share(a) for a in view.actions if a.touches(stage.name, test.name))
        return {"fall of ln f": (0.5 * fall, LEVEL_SD)}

    return predict


def slip_share(action: Action) -> float:
    """Part of the stiffness that a slipping contact of an action carries: what vanishes at high levels."""
    return 0.0 if action.friction is None else action.friction.share


def _clamps(stage: StageModel, test: MeasuredTest) -> Predict:
    def predict(view: View) -> Told:
        h = view.refit.hypothesis
        stiff = tuple(_stiffer(a, test.support) for a in view.actions)
        changed = any(a is not b for a, b in zip(view.actions, stiff, strict=True))
        if not changed:
            return {f"mode {i + 1}": (0.0, CLAMP_SD) for i in range(MODES)}
        marks = h.mark(view.z)
        before = supported_test(h.study.files, stage, test, view.actions, marks)
        after = supported_test(h.study.files, stage, test, stiff, tuple((m, "stiffer") for m in marks))
        if before is None or after is None:
            return {}
        moves = zip(sorted(before.log_f)[:MODES], sorted(after.log_f)[:MODES], strict=False)
        return {f"mode {i + 1}": (float(b - a), CLAMP_SD) for i, (a, b) in enumerate(moves)}

    return predict


def _stiffer(action: Action, support: str) -> Action:
    """The same at twice the clamping force; a rigid support stays rigid."""
    keys = action.supports.get(support)
    if keys is None or keys.declared != "elastic":
        return action
    own = {k: v for k, v in keys.model_dump().items() if k.startswith("normal_stiffness") and v is not None}
    return replace(
        action,
        supports={
            **action.supports,
            support: keys.model_copy(update={k: STIFFER * v for k, v in own.items()}),
        },
    )
