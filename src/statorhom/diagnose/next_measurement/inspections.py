"""Looking, weighing, measuring again: what an explanation claims is read directly, or taken off."""

from __future__ import annotations

import numpy as np

from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.next_measurement.option import Option, Predict, Told
from statorhom.diagnose.next_measurement.view import View
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.broken.change import Attachment
from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate

WEIGHED_SD = 1e-3  # relative, of a mass or dimension that is measured again
KELVIN_SD = 1.0
SENSOR_SD_KG = 2e-4
SHIFT_SD = 3e-4  # relative, of a frequency before against after


def options(refit: Refit) -> list[Option]:
    """For every effect of an explanation."""
    found: list[Option] = []
    view = View(refit, refit.z)
    for candidate, values, action in view.effects:
        found += _again(candidate)
        if "temperature_k" in values:
            what = f"the stator’s temperature during test {candidate.test}"
            found.append(Option(what, 0.2, _claimed(candidate, "temperature_k", 0.0, KELVIN_SD)))
        if action.sensor_kg:
            what = f"the weight of the accelerometer of test {candidate.test}"
            found.append(Option(what, 0.2, _claimed(candidate, "mass_kg", 0.0, SENSOR_SD_KG)))
        found += _removals(refit, candidate, values.get("angle_rad"), action)
    return found


def _again(candidate: Candidate) -> list[Option]:
    """An input that is said to be wrong."""
    absent = candidate.parameters[0].absent if candidate.parameters else None
    if "input" not in candidate.chosen or not absent:
        return []
    what = f"{candidate.chosen['input']} of step {candidate.stage} once more"
    return [Option(what, 0.3, _claimed(candidate, "value", absent, WEIGHED_SD * absent))]


def _claimed(candidate: Candidate, name: str, absent: float, sd: float) -> Predict:
    """The value that an explanation gives a parameter; `absent` where it lacks the effect."""

    def predict(view: View) -> Told:
        own = [values[name] for c, values, _ in view.effects if c.label == candidate.label]
        return {name: (own[0] if own else absent, sd)}

    return predict


def _removals(refit: Refit, candidate: Candidate, angle: float | None, action: Action) -> list[Option]:
    """A part with a mass that is said to sit on the stator: found, taken off, measured again."""
    found = []
    for stage in refit.hypothesis.study.stages:
        changes = action.changes(stage.model.mesh, stage.reference) if action.changes else ()
        heavy = any(isinstance(c, Attachment) and np.any(c.mass) for c in changes)
        if heavy and action.touches(stage.name):
            where = "" if angle is None else f" near {np.rad2deg(angle):.0f}°"
            what = f"step {stage.name} with what sits on the back of the core{where} taken off"
            found.append(Option(what, 1.0, _without(stage, candidate)))
    return found


def _without(stage: StageModel, candidate: Candidate) -> Predict:
    def predict(view: View) -> Told:
        labels = [c.label for c, _, _ in view.effects if c.label == candidate.label]
        with_it, rest = view.modes(stage), view.modes(stage, labels)
        both = [k for k in with_it if k in rest]
        return {str(k): (rest[k].log_f - with_it[k].log_f, SHIFT_SD) for k in both}

    return predict
