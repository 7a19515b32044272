"""Lines of one doublet that lie far apart, and lines whose name may be another mode's."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.features.assignment import sought
from statorhom.diagnose.features.mode_features import free_features
from statorhom.diagnose.measured.feature import LOST, LOST_UNNAMED
from statorhom.diagnose.measured.measured_test import MeasuredSplit, MeasuredTest
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.identify.residuals.model_error import ModelError
from statorhom.model.stator_mode import StatorMode
from statorhom.study.modal_table import MeasuredMode

KEY = (2, 2, 0)
LINES = tuple(MeasuredMode(i, str(i), f, order=2, axial=2) for i, f in enumerate((5400.0, 5850.0)))


def partners(split: complex, *further: MeasuredMode, lines: tuple[MeasuredMode, ...] = LINES) -> list[object]:
    mode = StatorMode(5620.0, 2, 2, "radial", 1.0, 2, 0, 0)
    predicted = {KEY: PredictedMode(KEY, mode, float(np.log(5620.0)), split, 1e-3)}
    modes = (*lines, *further)
    return sorted(sought(MeasuredTest(0, "t", "free", modes, False), modes, predicted).within(1.0), key=str)


def test_lines_that_a_lump_parts_by_much_are_one_doublet_where_that_is_predicted() -> None:
    third = MeasuredMode(2, "2", 7000.0, order=2, axial=2)
    assert partners(0.15 + 0j, third) == [KEY, KEY, None]
    assert partners(0.001 + 0j, third) == [KEY, None, None]


def test_two_lines_that_alone_bear_a_name_are_one_doublet_whatever_is_predicted() -> None:
    assert partners(0.001 + 0j) == [KEY, KEY]
    # farther apart than any doublet, the names are of two modes
    assert partners(0.001 + 0j, lines=(LINES[0], MeasuredMode(1, "1", 6000.0, order=2, axial=2))) == [
        KEY,
        None,
    ]


@pytest.mark.parametrize(
    ("size", "least", "most"), [(0.0, LOST, LOST), (0.1, LOST_UNNAMED, LOST_UNNAMED + 0.2)]
)
def test_a_line_without_a_partner_says_less_where_doublets_are_torn_apart(
    size: float, least: float, most: float
) -> None:
    stray = MeasuredMode(2, "2", 6270.0, order=2, axial=2)
    test = MeasuredTest(0, "t", "free", (*LINES, stray), True, (MeasuredSplit("0", "1", size + 0j, 1e-4),))
    (lost,) = free_features(test, (stray,), (None,), {}, {}, ModelError())
    assert least <= lost.measured <= most


def test_lines_of_a_torn_doublet_stand_on_either_side_of_another_ones() -> None:
    """Lines at 8783 and 9351 Hz of a doublet about 9080 Hz; another one has one line at 9090 Hz."""
    outer, inner = (4, 1, 0), (4, 1, 1)
    predicted = {
        key: PredictedMode(
            key, StatorMode(f, 4, 1, "radial", 1.0, 2, 0, 0), float(np.log(f)), split + 0j, 1e-3
        )
        for key, f, split in ((outer, 9090.0, 0.13), (inner, 9050.0, 0.003))
    }
    modes = tuple(
        MeasuredMode(i, str(i), f, order=4, axial=1) for i, f in enumerate((8783.0, 9090.0, 9351.0))
    )
    assert sought(MeasuredTest(0, "t", "free", modes, False), modes, predicted).within(1.0) == (
        outer,
        inner,
        outer,
    )


def test_a_mode_that_may_be_counted_in_any_way_leaves_another_ones_name_alone() -> None:
    """It lies nearer to the other one's line, and its own would have no partner."""
    mixed, other = (2, 1, 2), (2, 2, 0)
    predicted = {
        key: PredictedMode(
            key, StatorMode(f, 2, key[1], "radial", 1.0, 2, 0, 0), float(np.log(f)), 0j, 1e-3, shown=shown
        )
        for key, f, shown in ((mixed, 6020.0, (1, 0, 1, 2, 3)), (other, 6093.0, (2,)))
    }
    modes = tuple(
        MeasuredMode(i, str(i), f, order=2, axial=n) for i, (f, n) in enumerate(((5964.0, 1), (6004.0, 2)))
    )
    assert sought(MeasuredTest(0, "t", "free", modes, False), modes, predicted).within(1.0) == (mixed, other)
