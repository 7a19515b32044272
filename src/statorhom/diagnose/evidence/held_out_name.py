"""Held-out error of a corrected name: the mode itself, predicted from all others, by its old and by its new name.

Modes that are rightly named cannot tell whether another one is not, so folds say nothing here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from statorhom.diagnose.evidence.held_out import HeldOut
from statorhom.diagnose.evidence.held_out_modes import refit_held
from statorhom.diagnose.features.mode_features import measured_sd, own_sd
from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.predicted.prediction import predicted
from statorhom.diagnose.stages.stage_model import BAND
from statorhom.physics.library import library

WHAT = "the renamed mode predicted from all others, by its old and by its new name"
Name = tuple[int | None, int | None]


def renames_alone(explanation: Explanation) -> bool:
    """Whether an explanation does nothing but correct names."""
    return bool(explanation.candidates) and not any(c.parameters for c in explanation.candidates)


def held_out_names(base: Refit, explanation: Explanation) -> HeldOut:
    """Error of every renamed mode by its old name in the declared model, and by its new one."""
    files = base.hypothesis.study.files
    names: dict[tuple[str, str], tuple[int, int]] = {}
    for c in explanation.candidates:
        names |= dict(library()[c.effect].action(c, {}, files).names)
    declared: dict[tuple[str, str], Name] = {
        (test.name, mode.label): (mode.order, mode.axial)
        for stage in base.hypothesis.study.stages
        for test in stage.tests
        for mode in test.modes
    }
    rows = {}
    for place, name in names.items():
        before, after = _error(base, place, declared), _error(explanation.refit, place, {place: name})
        rows[place[0], (*name, 0)] = (before[0], after[0], after[1])
    columns = list(zip(*rows.values(), strict=True))
    return HeldOut(tuple(rows), columns[0], columns[1], columns[2], WHAT)


def _error(full: Refit, place: tuple[str, str], names: Mapping[tuple[str, str], Name]) -> tuple[float, float]:
    """Of one mode in percent, by a name, and its noise."""
    h = full.hypothesis
    assert h.held is not None
    stage, test = next((s, t) for s in h.study.stages for t in s.tests if t.name == place[0])
    number = next(i for i, mode in enumerate(test.modes) if mode.label == place[1])
    partner = h.held[test.name][number]
    unseen = (test.name, partner if isinstance(partner, tuple) else None)
    trained = refit_held(replace(h, left_out=h.left_out | {unseen}), full.z)
    values = h.study.constants.values(trained.z[: h.constants])
    modes = predicted(h.study, stage, values, h.actions(trained.z), test.name)
    measured = test.modes[number]
    order, axial = names[place]
    near = [
        (abs(float(np.log(measured.frequency_hz)) - mode.log_f), key)
        for key, mode in modes.items()
        if key[0] == order and (axial is None or key[1] == axial)
    ]
    # a name that nothing below the band's end carries is off by that much at least
    end = BAND * max(mode.frequency_hz for t in stage.tests for mode in t.modes)
    beyond = float(np.log(end / measured.frequency_hz)), (order or 0, axial or 0, 0)
    away, key = min(near, default=beyond)
    return 100 * away, 100 * float(np.hypot(measured_sd(measured), own_sd(stage.error, key)))
