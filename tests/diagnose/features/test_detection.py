"""What a test is likely to have found."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.features.detection import detection_cost
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.model.convergence import ModeKey
from statorhom.model.stator_mode import StatorMode
from statorhom.study.modal_table import MeasuredMode

ENDS = (1000.0, 3000.0)


def cost(partners: dict[float, float], others: dict[float, float]) -> float:
    """Of a table with lines at both ends of its band, and partners and other modes by frequency and visibility."""
    predicted: dict[ModeKey, PredictedMode] = {}
    for rank, (f, visibility) in enumerate({**partners, **others}.items()):
        mode = StatorMode(f, 3, 0, "radial", visibility, 2, 0, rank)
        predicted[3, 0, rank] = PredictedMode((3, 0, rank), mode, float(np.log(f)), 0j, 1e-3)
    lines = tuple(MeasuredMode(i, str(i), f, order=3, axial=0) for i, f in enumerate((*ENDS, *partners)))
    keys = (None, None, *((3, 0, rank) for rank in range(len(partners))))
    return detection_cost(MeasuredTest(0, "t", "free", lines, False), keys, predicted)


def test_a_clear_mode_is_a_likely_partner() -> None:
    assert cost({2000.0: 1.0}, {}) == pytest.approx(0.0, abs=1e-12)
    assert cost({}, {}) == 0.0


def test_what_hardly_moves_the_core_is_an_unlikely_partner() -> None:
    """Of visibility 0.003 one test in forty finds a mode, where three in four find a clear one."""
    found = 0.8 * 0.003 / 0.103, 0.8 / 1.1
    assert cost({2000.0: 0.003}, {}) == pytest.approx(-2.0 * np.log(found[0] / found[1]))
    assert cost({2000.0: 0.003, 2100.0: 0.003}, {}) == pytest.approx(2.0 * cost({2000.0: 0.003}, {}))


def test_a_mode_without_any_visibility_can_be_a_partner_still() -> None:
    assert cost({2000.0: 0.0}, {}) == cost({2000.0: 1e-3}, {}) < 20.0


def test_a_clear_mode_of_the_band_is_likely_to_be_found() -> None:
    assert cost({}, {2000.0: 1.0}) == pytest.approx(-2.0 * np.log(1.0 - 0.8 / 1.1))
    assert cost({}, {2000.0: 0.003}) < 0.05
    assert cost({}, {900.0: 1.0, 3100.0: 1.0}) == 0.0  # nobody looked there


def test_a_test_that_shows_nothing_says_nothing() -> None:
    """As a repetition does of one whose lines the declared model has no modes for."""
    mode = StatorMode(2000.0, 3, 0, "radial", 1.0, 2, 0, 0)
    predicted = {(3, 0, 0): PredictedMode((3, 0, 0), mode, float(np.log(2000.0)), 0j, 1e-3)}
    assert detection_cost(MeasuredTest(0, "t", "free", (), False), (), predicted) == 0.0
