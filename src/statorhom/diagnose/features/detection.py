"""How likely it is that a test found the modes that it lists, and missed the others of its band."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.diagnose.features.assignment import Keys
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.identify.residuals.stage_problem import chance_to_find
from statorhom.model.convergence import ModeKey

HIDDEN = 1e-3  # visibility that a mode counts as having at least: a coarse ring says little of so small ones
CLEAR = chance_to_find(1.0)  # of a ring's radial motion


def detection_cost(test: MeasuredTest, keys: Keys, predicted: Mapping[ModeKey, PredictedMode]) -> float:
    """-2 ln of the chance that a test found its partners, and none of its band's other modes, beside a clear mode's.

    A winding that hardly holds on has modes everywhere, and any line has one near it; but what moves the core by
    nothing no accelerometer shows. A repetition of a test whose lines the model has no modes for shows none, and says
    nothing.
    """
    if not test.modes:
        return 0.0
    band = [mode.frequency_hz for mode in test.modes]
    lowest, highest = min(band), max(band)
    found = {key for key in keys if key is not None and key in predicted}
    partners = [_chance(predicted[key]) / CLEAR for key in found]
    others = [
        1.0 - _chance(mode)
        for key, mode in predicted.items()
        if lowest < mode.frequency_hz < highest and key not in found
    ]
    return float(-2.0 * np.sum(np.log([*partners, *others])))


def _chance(mode: PredictedMode) -> float:
    return chance_to_find(max(mode.mode.visibility, HIDDEN))
