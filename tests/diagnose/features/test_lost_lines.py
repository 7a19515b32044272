"""Lines without a partner: which of them are modes that the model lacks."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.features.mode_features import free_features
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.identify.residuals.model_error import ModelError
from statorhom.model.stator_mode import StatorMode
from statorhom.study.modal_table import MeasuredMode


@pytest.mark.parametrize(("partners", "lost"), [(2, 0), (1, 1), (0, 2)])
def test_a_third_line_of_one_resonance_is_an_image_and_no_lost_mode(partners: int, lost: int) -> None:
    """Of a wound stator three lines (2, 1) were extracted within 0.3 Hz at a loss factor of 3 %."""
    rows = [
        MeasuredMode(i, str(i), f, order=2, axial=1, loss_factor=0.03)
        for i, f in enumerate((1616.5, 1616.5, 1616.8, 1900.0))
    ]
    key = (2, 1, 0)
    keys = tuple(key if i < partners else None for i in range(4))
    test = MeasuredTest(0, "t", "free", tuple(rows), True)
    mode = StatorMode(1616.5, 2, 1, "radial", 1.0, 2, 0, 0)
    predicted = {key: PredictedMode(key, mode, float(np.log(1616.5)), 0j, 1e-3)}
    found = [f for f in free_features(test, rows, keys, predicted, {}, ModelError()) if f.lost]
    # the line at 1900 Hz is another mode
    assert [f.rows for f in found].count(("3",)) == 1
    assert len(found) == lost + 1
