"""What a broken stator's modes are called, and how certain that is."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.model.broken.named_response import (
    NEAR,
    Columns,
    named_response,
    nearest_pair,
    response_of,
    seen_shares,
)

# a doublet (0, 1) and another name's (2, 3), in rad²/s² as if at about 1 rad/s
PLACE = Columns(0, 1, 1.0)


def response(turned: float, other: float = 0.04, seen: np.ndarray | None = None) -> Any:
    """Of a doublet whose cosine mode is turned (rad) into another name's, `other` of ln f above it."""
    cosine, sine = np.cos(turned), np.sin(turned)
    participation = np.array(
        [[cosine, 0.0, -sine, 0.0], [0.0, 1.0, 0.0, 0.0], [sine, 0.0, cosine, 0.0], [0.0, 0.0, 0.0, 1.0]]
    )
    values = np.exp(2.0 * np.array([0.0, 0.0, other, other]))
    modes: Any = SimpleNamespace(participation=participation, eigenvalues=values)
    if seen is None:
        return named_response(modes, PLACE)
    pair = nearest_pair(modes, PLACE)
    assert pair is not None
    return response_of(modes, PLACE, pair, seen_shares(modes, {"own": PLACE}, seen)["own"])


@pytest.mark.parametrize("turned", [0.0, 0.3])
def test_a_mode_that_is_hardly_mixed_is_certain(turned: float) -> None:
    found = response(turned)
    assert found.chance == pytest.approx(1.0, abs=0.02)
    assert found.ways == ()


def test_a_mode_that_is_half_another_name_s_may_be_called_by_it() -> None:
    """(1, 1) and (4, 1), 4 % apart, under a lump of 4 % of the mass: 46 and 45 % of one, 28 and 44 % of the other."""
    found = response(0.7)
    assert found.chance + sum(way.chance for way in found.ways) == pytest.approx(1.0, abs=0.05)
    assert (found.shift, found.split) == (0.0, 0j)
    # the upper line instead of the lower one: sharp, and elsewhere
    upper = max(found.ways, key=lambda way: way.split.real)
    mean = (1 + np.exp(0.08)) / 2
    assert upper.shift == pytest.approx(0.5 * np.log(mean))
    assert upper.split == pytest.approx((np.exp(0.08) - 1) / mean)
    # or one line alone, the other of which is called otherwise
    assert 0.0 in {way.split for way in found.ways}
    # all lines that may be called so, each for itself
    assert {round(line.shift, 9) for line in found.lines} == {0.0, round(0.04, 9)}
    assert all(line.split == 0j and 0.0 < line.chance <= 1.0 for line in found.lines)
    assert upper.chance < found.chance


def test_what_lies_far_away_is_called_by_no_other_name() -> None:
    far, near = response(0.7, 1.1 * NEAR), response(0.7)
    assert max(abs(way.split) for way in far.ways) == 0.0
    assert max(abs(way.split) for way in near.ways) > 0.05


def test_a_mode_is_called_by_what_of_it_is_seen() -> None:
    """Of a mode across the sheets the surface hardly moves: a fiftieth of (4, 1) in it, and it is called (4, 1)."""
    turned = float(np.arcsin(np.sqrt(0.02)))
    assert response(turned).ways == ()
    faint = response(turned, seen=np.array([1.0, 1.0, 0.01, 0.01]))
    # of three lines that are called alike any two may be found: with the faint one the doublet looks far wider
    assert max(abs(way.split) for way in faint.ways) > 0.05
    assert faint.chance < 0.9
