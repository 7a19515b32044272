"""Modes without names: pairing by rank, and the descent that starts from it."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from statorhom.identify.residuals.stage_problem import CorrectedMode, pair_by_rank
from statorhom.model.stator_mode import StatorMode
from statorhom.study.modal_table import MeasuredMode


def simulated(frequencies: Sequence[float], hidden: Sequence[float] = ()) -> list[CorrectedMode]:
    modes = []
    for number, hz in enumerate(sorted((*frequencies, *hidden))):
        seen = 0.01 if hz in hidden else 1.0
        mode = StatorMode(hz, None, None, "", seen, 1, number, 0, number)
        modes.append(CorrectedMode(mode, (number, 0, 0), hz, seen))
    return modes


def measured(*frequencies: float, first_row: int = 1) -> list[MeasuredMode]:
    return [MeasuredMode(first_row + i, None, hz) for i, hz in enumerate(frequencies)]


def test_the_kth_is_the_kth_however_far_away() -> None:
    found = pair_by_rank(measured(100.0, 300.0, 200.0), simulated([1000.0, 2000.0, 3000.0, 4000.0]))
    assert found == ((0, 0, 0), (2, 0, 0), (1, 0, 0))


def test_modes_that_the_faces_hardly_show_have_no_rank() -> None:
    found = pair_by_rank(measured(100.0, 200.0), simulated([110.0, 210.0], hidden=[150.0]))
    assert found == ((0, 0, 0), (2, 0, 0))


def test_every_test_counts_from_its_own_first_mode() -> None:
    both = [*measured(100.0, 200.0), *measured(101.0, 201.0)]
    found = pair_by_rank(both, simulated([110.0, 210.0, 310.0]))
    assert found == ((0, 0, 0), (1, 0, 0)) * 2


def test_more_measured_than_simulated_stay_alone() -> None:
    found = pair_by_rank(measured(100.0, 200.0, 300.0), simulated([110.0]))
    assert found == ((0, 0, 0), None, None)


@pytest.mark.parametrize("shift", [0.5, 2.0])
def test_ranks_do_not_depend_on_the_scale(shift: float) -> None:
    frequencies = [100.0, 130.0, 180.0]
    found = pair_by_rank(measured(*frequencies), simulated([f * shift for f in frequencies]))
    assert found == ((0, 0, 0), (1, 0, 0), (2, 0, 0))
