"""Which of several mixed modes are called by a name: chances that add up, the usual way first."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from statorhom.model.broken.mixed_names import LEAST, MOST, able_of, chances_of, ways_of


def test_half_of_a_name_is_called_by_it_half_of_the_time() -> None:
    assert chances_of(np.array([0.0, 0.5, 1.0])) == pytest.approx([0.0, 0.5, 1.0])
    assert chances_of(np.array([0.6]))[0] == pytest.approx(0.36 / 0.52)


@given(st.lists(st.floats(0.0, 1.0), min_size=2, max_size=8), st.sampled_from([1, 2]))
def test_chances_add_up_and_the_usual_way_comes_first(shares: list[float], k: int) -> None:
    near, usual = np.arange(len(shares)), np.sort(np.argsort(-np.array(shares), kind="stable")[:k])
    ways = ways_of(able_of(np.array(shares), near), usual)
    assert ways[0].modes.tolist() == usual.tolist()
    # what is hardly possible is left out: of each of its ways less than a fiftieth
    most = MOST + MOST * (MOST - 1) // 2
    assert 1.0 - most * LEAST <= sum(way.chance for way in ways) <= 1.0 + 1e-9
    assert len({tuple(way.modes.tolist()) for way in ways}) == len(ways)
    assert all(1 <= len(way.modes) <= k for way in ways)


def test_a_pure_doublet_has_one_way() -> None:
    (way,) = ways_of(able_of(np.array([1.0, 1.0, 0.01]), np.arange(3)), np.array([0, 1]))
    assert way.chance == pytest.approx(1.0, abs=1e-3)


def test_of_three_lines_that_are_called_alike_any_two_may_be_found() -> None:
    ways = ways_of(able_of(np.array([1.0, 1.0, 0.9]), np.arange(3)), np.array([0, 1]))
    found = {tuple(way.modes.tolist()): way.chance for way in ways}
    assert found.keys() >= {(0, 1), (0, 2), (1, 2)}
    assert found[0, 1] > found[0, 2] == pytest.approx(found[1, 2])
    # where nothing else is called so, two lines are two lines
    assert len(ways_of(able_of(np.array([1.0, 1.0, 0.0]), np.arange(3)), np.array([0, 1]))) == 1


def test_all_lines_that_may_be_called_by_a_name_are_told_one_by_one() -> None:
    """Of a lump's (2, 2) and (4, 1) three of four lines are called (4, 1)."""
    found = able_of(np.array([0.78, 0.8, 0.95, 0.24, 0.05, 1.0]), np.arange(5))
    assert list(found) == [0, 1, 2, 3]
    assert found[2] > found[1] > found[0] > 0.9 > 0.1 > found[3] > LEAST
    assert len(able_of(np.full(9, 0.9), np.arange(9))) == MOST
