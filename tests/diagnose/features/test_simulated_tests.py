"""A test that is repeated shows its lines where the declared model has them, with the noise of its features."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from statorhom.diagnose.features.simulated_tests import simulated
from statorhom.diagnose.measured.feature import Feature, Silence
from statorhom.diagnose.measured.measured_test import MeasuredSplit, MeasuredTest
from statorhom.study.modal_table import MeasuredMode

LOW, HIGH, ALONE, STRANGE = (
    MeasuredMode(row, None, hz, order=2) for row, hz in enumerate((1000.0, 1010.0, 3000.0, 5000.0), start=1)
)
DOUBLET, SINGLE = (2, 0, 0), (3, 0, 0)
MEAN = float(np.log(1000.0) + np.log(1010.0)) / 2


def test_of(modes: Sequence[MeasuredMode], splits: Sequence[MeasuredSplit] = ()) -> MeasuredTest:
    return MeasuredTest(0, "free", "free", tuple(modes), bool(splits), tuple(splits))


test_of.__test__ = False  # type: ignore[attr-defined]


def line(
    predicted: float, measured: float, sd: float, rows: tuple[str, ...], key: tuple[int, int, int]
) -> Feature:
    return Feature("frequency", "free", key, measured, predicted, sd, rows=rows)


def lines(test: MeasuredTest) -> np.ndarray:
    return np.log([mode.frequency_hz for mode in test.modes])


def silent() -> float:
    return 0.0


def one() -> float:
    return 1.0


def test_a_single_line_lies_where_it_is_predicted() -> None:
    features = [line(8.1, float(np.log(3000.0)), 0.01, ("3",), SINGLE)]
    assert lines(simulated(test_of([ALONE]), [SINGLE], features, silent)) == pytest.approx([8.1])
    assert lines(simulated(test_of([ALONE]), [SINGLE], features, one)) == pytest.approx([8.11])


def test_the_lines_of_a_table_s_doublet_lie_half_of_their_distance_to_either_side() -> None:
    rows = ("1", "2")
    features = [
        line(6.95, MEAN, 0.01, rows, DOUBLET),
        Feature("split", "free", DOUBLET, 0.02, 0.008, 0.004, rows=rows),
    ]
    quiet = simulated(test_of([LOW, HIGH]), [DOUBLET, DOUBLET], features, silent)
    assert lines(quiet) == pytest.approx([6.95 - 0.002, 6.95 + 0.002])
    loud = simulated(test_of([LOW, HIGH]), [DOUBLET, DOUBLET], features, one)
    # a relative split of λ is twice as large as that of f, and a line lies half of that away
    assert lines(loud) == pytest.approx([6.96 - 0.003, 6.96 + 0.003])


def test_of_a_recording_the_angle_is_drawn_too() -> None:
    rows = ("1", "2")
    split = MeasuredSplit("1", "2", 0.02 + 0.01j, 1e-3)
    features = [
        line(6.95, MEAN, 0.01, rows, DOUBLET),
        Feature("split", "free", DOUBLET, 0.02, 0.003, 0.001, rows=rows),
        Feature("split", "free", DOUBLET, 0.01, -0.001, 0.001, rows=rows),
    ]
    found = simulated(test_of([LOW, HIGH], [split]), [DOUBLET, DOUBLET], features, one)
    assert found.splits[0].relative == pytest.approx(0.004 + 0j)
    assert np.diff(lines(found)) == pytest.approx([0.002])


def test_images_between_the_lines_of_a_doublet_move_with_their_mean() -> None:
    image = MeasuredMode(5, None, 1004.0, order=2)
    rows = ("1", "5", "2")
    features = [
        line(MEAN + 0.1, MEAN, 0.01, rows, DOUBLET),
        Feature("split", "free", DOUBLET, 0.02, 0.008, 0.004, rows=rows),
    ]
    found = simulated(test_of([LOW, image, HIGH]), [DOUBLET] * 3, features, silent)
    moved = next(mode for mode in found.modes if mode.label == "5")
    assert np.log(moved.frequency_hz) == pytest.approx(np.log(1004.0) + 0.1)


def test_what_has_no_partner_is_not_repeated_and_lines_stay_in_order() -> None:
    features = [
        line(9.0, float(np.log(1000.0)), 0.01, ("1",), DOUBLET),
        line(8.0, float(np.log(3000.0)), 0.01, ("3",), SINGLE),
        Feature("frequency", "free", None, 10.0, 0.0, 1.0, lost=True, rows=("4",)),
        Feature("frequency", "other", SINGLE, 1.0, 2.0, 1.0, rows=("1",)),
    ]
    found = simulated(test_of([LOW, ALONE, STRANGE]), [DOUBLET, SINGLE, None], features, silent)
    assert [mode.label for mode in found.modes] == ["3", "1"]
    assert lines(found) == pytest.approx([8.0, 9.0])


def test_a_doublet_of_which_one_line_was_seen_stays_one_line() -> None:
    features = [
        line(8.1, float(np.log(3000.0)), 0.01, ("3",), SINGLE),
        Feature("split", "free", SINGLE, 0.0, 0.5, 1.0, rows=("3",), silence=Silence(0.01, 0.01, 1.8, 1)),
    ]
    found = simulated(test_of([ALONE]), [SINGLE], features, silent)
    assert lines(found) == pytest.approx([8.1]) and found.splits == ()
