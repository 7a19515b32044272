"""Node planes as a test's own measuring planes count them."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from small_stage import stage_of

from statorhom.diagnose.features.assignment import sought
from statorhom.diagnose.measured.measured_test import MeasuredShapes, MeasuredTest
from statorhom.diagnose.predicted.counted_planes import _possible, _with_fewer_planes, counted_at_planes
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.model.stator_mode import StatorMode
from statorhom.study.modal_table import MeasuredMode

STAGE = stage_of(("stack",), 6000.0)
LENGTH = STAGE.model.mesh.length


def wave(n: int, *parts: float) -> np.ndarray:
    """cos nπz/L at parts of the length."""
    return np.cos(n * np.pi * np.array(parts))[:, None]


@pytest.mark.parametrize("n", range(4))
def test_enough_planes_count_right(n: int) -> None:
    assert _possible(wave(n, 0.05, 0.35, 0.65, 0.95))[0] == n


def test_four_planes_count_four_node_planes_as_two() -> None:
    assert _possible(wave(4, 0.05, 0.35, 0.65, 0.95))[0] == 2


def test_a_faint_plane_leaves_both_counts_possible() -> None:
    assert _possible(np.array([[1.0], [-0.15], [1.0]])) == (2, 0)
    assert _possible(np.array([[1.0], [-0.05], [1.0]])) == (0, 2)


def predictions() -> dict[Any, PredictedMode]:
    return {
        key: PredictedMode(key, mode, float(np.log(mode.frequency_hz)), 0j, 1e-3)
        for key, mode in STAGE.reference_keys.items()
    }


def seen_at(*parts: float) -> dict[Any, PredictedMode]:
    places = LENGTH * np.array(parts)
    shapes = MeasuredShapes((), places, np.arange(12) * np.pi / 6, np.zeros((0, len(places), 12)))
    test = MeasuredTest(0, "free", "free", (), True, shapes=shapes)
    return counted_at_planes(STAGE, test, predictions())


def test_planes_that_show_the_mode_give_its_own_count() -> None:
    found = seen_at(0.02, 0.14, 0.26, 0.38, 0.5, 0.62, 0.74, 0.86, 0.98)
    assert found
    assert all(mode.mode.axial in mode.shown for mode in found.values())


def test_two_planes_tell_odd_from_even_alone() -> None:
    for mode in seen_at(0.1, 0.9).values():
        assert mode.mode.axial is not None
        assert mode.mode.axial % 2 in mode.shown


def test_a_mode_is_paired_by_the_count_that_its_planes_show() -> None:
    own = StatorMode(3821.0, 2, 4, "radial", 1.0, 2, 0, 0)
    key = (2, 4, 0)
    predicted = {key: PredictedMode(key, own, float(np.log(3821.0)), 0j, 1e-3)}
    rows = (MeasuredMode(1, "1", 3820.0, order=2, axial=0),)
    test: Any = SimpleNamespace(recorded=True)
    shown = {key: replace(predicted[key], shown=(2, 0))}
    assert sought(test, rows, shown).within(1.0) == (key,)
    assert next(iter(predicted.values())).axial == 4


def test_where_nobody_knows_the_planes_some_may_be_missing() -> None:
    """A mode of a loose stack that two planes more or less say is one of five node planes, or of one."""
    along = np.array([-1.0, 0.41, -0.64, -0.78, 0.0, 0.78, 0.64, -0.41, 1.0])
    assert set(_with_fewer_planes(along)) == {1, 5}
    # the ends of a loose stack move by themselves, and are measured
    assert set(_with_fewer_planes(np.array([-1.0, 0.1, 0.5, 0.5, 0.0, -0.5, -0.5, -0.1, 1.0]))) == {3}
    found = counted_at_planes(STAGE, MeasuredTest(0, "free", "free", ()), predictions())
    assert all(mode.shown[0] == mode.mode.axial for mode in found.values())
    assert all(set(mode.shown) == {n} for (_, n, _), mode in found.items() if n < 2)
