"""Frequencies of moduli that follow the frequency: each is that of a mode at the moduli at it, whatever crosses it."""

from __future__ import annotations

import numpy as np
import pytest
from small_stage import stage_of

from statorhom.diagnose.stages.rated_modes import continued, rated_modes
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.physics.rated import at_rate

TOP = 9000.0
SLOPE = 0.9  # of a decade: the moduli at the band's top are many times those at its bottom
LAWS = {"winding": lambda hz: 10 ** (SLOPE * np.log10(hz / 1000.0))}


@pytest.fixture(scope="module")
def wound() -> StageModel:
    return stage_of(("stack", "wound"), TOP)


def test_every_frequency_is_that_of_a_mode_at_the_moduli_there(wound: StageModel) -> None:
    found = rated_modes(wound, wound.reference, LAWS)
    assert len(found) > 12
    for mode in found:
        there = wound.solve(at_rate(wound.reference, LAWS, mode.frequency_hz)).modes
        same = [m.frequency_hz for m in there if m.problem == mode.problem and m.family == mode.family]
        assert min(abs(np.log(np.array(same) / mode.frequency_hz))) < 1.5e-3


def test_their_places_are_those_at_declared_moduli(wound: StageModel) -> None:
    declared = {mode.place: mode for mode in wound.solve(wound.reference).modes}
    for mode in rated_modes(wound, wound.reference, {"winding": lambda _: 1.0}):
        own = declared[mode.place]
        assert mode.frequency_hz == pytest.approx(own.frequency_hz)
        assert mode._replace(frequency_hz=own.frequency_hz) == own
    places = [mode.place for mode in rated_modes(wound, wound.reference, LAWS)]
    assert len(set(places)) == len(places)
    assert set(places) <= set(declared)


def test_problems_may_be_told_that_were_not_all_solved(wound: StageModel) -> None:
    laws = {"winding": lambda hz: (hz / 1000.0) ** 0.7}
    wound.solve(at_rate(wound.reference, laws, 1000.0))
    some = frozenset({0, 2})
    found = rated_modes(wound, wound.reference, laws, some)
    assert {mode.problem for mode in found} == some
    assert found == tuple(m for m in rated_modes(wound, wound.reference, laws) if m.problem in some)


def test_modes_that_change_places_keep_their_names(wound: StageModel) -> None:
    here = wound.solve(wound.reference)
    table = {mode.place: mode for mode in here.modes}
    number = next(m.problem for m in here.modes if (m.problem, 1) in table and (m.problem, 0) in table)
    swapped = list(here.vectors)
    swapped[number] = swapped[number][:, [1, 0, *range(2, swapped[number].shape[1])]]
    there = type(here)(here.modes, here.values, tuple(swapped), here.problems)
    first, second = (number, 0), (number, 1)
    found = continued(table, here, there, wound.reference)
    assert found == {**table, first: table[second], second: table[first]}


def test_what_has_no_like_is_lost(wound: StageModel) -> None:
    here = wound.solve(wound.reference)
    mode = here.modes[0]
    empty = type(here)(
        tuple(m for m in here.modes if m.place != mode.place), here.values, here.vectors, here.problems
    )
    assert continued({mode.place: mode}, here, empty, wound.reference) == {}
