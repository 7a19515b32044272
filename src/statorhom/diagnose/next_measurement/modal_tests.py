"""Free modal tests: all modes of the band with their doublets, and the phase between the two end planes."""

from __future__ import annotations

from statorhom.diagnose.features.mode_features import OWN, SCATTER_SD, SPLIT_OWN
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.next_measurement.option import Option, Predict, Told
from statorhom.diagnose.next_measurement.view import View
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.study.study_file import FREE

FREQUENCY_SD = 3e-4  # relative, of a careful test
PHASE_SD = 0.1  # of the ratio of the two ends' motion
LEAST_VISIBLE = 0.1


def options(refit: Refit) -> list[Option]:
    """For every tested step."""
    found = []
    for stage in refit.hypothesis.study.stages:
        what = (
            f"a free modal test of step {stage.name}, with all modes of the band, their doublets and angles"
        )
        found.append(Option(what, 3.0, _modes(stage)))
        for test in stage.tests:
            if test.support == FREE and not test.recorded:
                what = f"the phase between the two end planes, for every mode of test {test.name}"
                found.append(Option(what, 0.5, _phases(test)))
    return found


def _modes(stage: StageModel) -> Predict:
    def predict(view: View) -> Told:
        told: dict[str, tuple[float, float]] = {}
        for key, mode in view.modes(stage).items():
            if mode.visibility < LEAST_VISIBLE:
                continue
            told[f"{key} f"] = mode.log_f, float((FREQUENCY_SD**2 + OWN**2) ** 0.5)
            if mode.multiplicity == 2:
                sd = float((SPLIT_OWN**2 + SCATTER_SD**2) ** 0.5)
                told[f"{key} re"], told[f"{key} im"] = (mode.split.real, sd), (mode.split.imag, sd)
        return told

    return predict


def _phases(test: MeasuredTest) -> Predict:
    def predict(view: View) -> Told:
        held = view.refit.hypothesis.held or {}
        pairs = zip(test.modes, held.get(test.name, ()), strict=False)
        return {
            m.label: (1.0 if key[1] % 2 == 0 else -1.0, PHASE_SD)
            for m, key in pairs
            if isinstance(key, tuple)
        }

    return predict
