"""Modal tables: what is missing, what is joined, what is misnamed."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from statorhom.conceal.listed import ListedMode, resolved
from statorhom.conceal.tables import relabelled, shortened, table_text


def mode(frequency: float, order: int, axial: int, *, seen: bool = True, loss: float = 0.006) -> ListedMode:
    return ListedMode(frequency, loss, order, axial, "radial", seen)


def doublets(split: float) -> tuple[ListedMode, ...]:
    names = [(2, 0), (2, 1), (3, 0), (3, 1), (4, 0), (4, 1), (1, 1), (5, 0)]
    return tuple(mode(1000.0 * (i + 1) * f, *n) for i, n in enumerate(names) for f in (1.0, 1.0 + split))


def test_doublets_closer_than_half_a_bandwidth_are_one() -> None:
    assert len(resolved(doublets(0.002))) == 8
    assert len(resolved(doublets(0.004))) == 16


def test_unseen_modes_are_absent() -> None:
    assert resolved((mode(1000.0, 2, 0), mode(2000.0, 3, 0, seen=False))) == (mode(1000.0, 2, 0),)


@given(st.integers(0, 2**31))
@settings(max_examples=30)
def test_ten_to_thirty_percent_of_the_names_are_missing(seed: int) -> None:
    names = {(m.order, m.axial) for m in shortened(doublets(0.01), np.random.default_rng(seed))}
    assert 5 <= len(names) <= 7


def test_a_table_may_list_one_mode_alone() -> None:
    left = shortened(doublets(0.01), np.random.default_rng(0), only=(2, 0))
    assert [(m.order, m.axial) for m in left] == [(2, 0), (2, 0)]


@given(st.integers(0, 2**31))
@settings(max_examples=30)
def test_one_row_gets_the_name_of_a_neighbour(seed: int) -> None:
    modes = doublets(0.0)[::2]
    wrong, row, true = relabelled(modes, seed)
    changed = [i for i, (a, b) in enumerate(zip(modes, wrong, strict=True)) if a != b]
    assert changed == [row - 1]
    assert true == modes[row - 1]
    assert (wrong[row - 1].order, wrong[row - 1].axial) != (true.order, true.axial)
    assert wrong[row - 1].frequency_hz == true.frequency_hz


def test_the_tables_spread_is_what_it_says() -> None:
    modes = doublets(0.0)[::2] * 200
    rows = [line.split(",") for line in table_text(modes, np.random.default_rng(2)).splitlines()[1:]]
    ratio = [(float(row[0]) - m.frequency_hz) / float(row[4]) for row, m in zip(rows, modes, strict=True)]
    assert 0.9 < np.std(ratio) < 1.1
