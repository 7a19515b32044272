"""How likely it is that a test found the modes that it lists, and missed the others of its band."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.diagnose.assignment import Keys
from statorhom.diagnose.measured import MeasuredTest
from statorhom.diagnose.prediction import PredictedMode
from statorhom.identify.stage_problem import FOUND, HALF_FOUND
from statorhom.model.convergence import ModeKey

HIDDEN = 1e-3  # visibility that a mode counts as having at least: a coarse ring says little of so small ones
CLEAR = FOUND / (1.0 + HALF_FOUND)  # chance that a test finds a mode of a ring's radial motion


def detection_cost(test: MeasuredTest, keys: Keys, predicted: Mapping[ModeKey, PredictedMode]) -> float:
    """-2 ln of the chance that a test found its partners, and none of its band's other modes, beside a clear mode's.

    A winding that hardly holds on has modes everywhere, and any line has one near it; but what moves the core by
    nothing no accelerometer shows.
    """
    band = [mode.frequency_hz for mode in test.modes]
    found = {key for key in keys if key is not None and key in predicted}
    partners = [_detection(predicted[key]) for key in found]
    others = [
        1.0 - _detection(mode)
        for key, mode in predicted.items()
        if min(band) < mode.frequency_hz < max(band) and key not in found
    ]
    clear = len(partners) * np.log(CLEAR)
    return float(-2.0 * (np.sum(np.log(others)) + np.sum(np.log(partners)) - clear))


def _detection(mode: PredictedMode) -> float:
    """Chance that a test finds a mode."""
    visibility = max(mode.mode.visibility, HIDDEN)
    return FOUND * visibility / (visibility + HALF_FOUND)
