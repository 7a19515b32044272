"""Modes that are single though those of their order are doublets."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.features.mode_features import ALONE, free_features, own_sd
from statorhom.diagnose.measured.feature import LOST, SINGLE
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.identify.residuals.model_error import ModelError
from statorhom.model.stator_mode import StatorMode
from statorhom.study.modal_table import MeasuredMode

KEY = (2, 0, SINGLE)
ROW = MeasuredMode(0, "0", 3000.0, order=2, axial=0, loss_factor=0.02)
TEST = MeasuredTest(0, "t", "free", (ROW,), True)


def test_their_line_has_a_frequency_and_no_split() -> None:
    mode = StatorMode(2990.0, 2, 0, "radial", 1.0, 1, 0, 0)
    predicted = {KEY: PredictedMode(KEY, mode, float(np.log(2990.0)), 0j, 1e-3)}
    (found,) = free_features(TEST, (ROW,), (KEY,), predicted, {2: 0.01 + 0j}, ModelError())
    assert found.kind == "frequency"
    assert found.sd > ALONE


def test_one_that_is_predicted_no_more_leaves_as_many_features() -> None:
    (found,) = free_features(TEST, (ROW,), (KEY,), {}, {}, ModelError())
    assert found.lost
    assert found.predicted == LOST


def test_their_frequency_is_less_certain() -> None:
    assert own_sd(ModelError(), KEY) > own_sd(ModelError(), (2, 0, 0)) + 0.8 * ALONE


def test_a_single_line_of_a_parted_doublet_is_the_nearer_one() -> None:
    """In the middle between the two there is none."""
    key, split, f = (2, 0, 0), 0.08, 3000.0
    predicted = {
        key: PredictedMode(
            key, StatorMode(f, 2, 0, "radial", 1.0, 2, 0, 0), float(np.log(f)), split + 0j, 1e-3
        )
    }
    for part, away in ((0.0, 1.0), (0.5, 0.5), (1.0, 0.0), (-1.0, 0.0), (1.2, 0.2)):
        row = MeasuredMode(0, "0", f * float(np.exp(part * split / 4)), order=2, axial=0, loss_factor=0.005)
        line, _ = free_features(
            MeasuredTest(0, "t", "free", (row,), False), (row,), (key,), predicted, {}, ModelError()
        )
        assert abs(line.measured - line.predicted) == pytest.approx(away * split / 4, abs=1e-9)
