"""What a broken stator's modes are called, and how certain that is."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.model.broken.named_response import NEAR, Columns, named_response

# a doublet (0, 1) and another name's (2, 3), in rad²/s² as if at about 1 rad/s
PLACE = Columns(0, 1, 1.0)


def response(turned: float, other: float = 0.04) -> Any:
    """Of a doublet whose cosine mode is turned (rad) into another name's, `other` of ln f above it."""
    cosine, sine = np.cos(turned), np.sin(turned)
    participation = np.array(
        [[cosine, 0.0, -sine, 0.0], [0.0, 1.0, 0.0, 0.0], [sine, 0.0, cosine, 0.0], [0.0, 0.0, 0.0, 1.0]]
    )
    values = np.exp(2.0 * np.array([0.0, 0.0, other, other]))
    modes: Any = SimpleNamespace(participation=participation, eigenvalues=values)
    return named_response(modes, PLACE)


@pytest.mark.parametrize("turned", [0.0, 0.3])
def test_a_mode_that_is_hardly_mixed_is_certain(turned: float) -> None:
    assert response(turned).blur == 0.0


def test_a_mode_that_is_half_another_name_s_may_be_called_by_it() -> None:
    """(1, 1) and (4, 1), 4 % apart, under a lump of 4 % of the mass: 46 and 45 % of one, 28 and 44 % of the other."""
    assert response(0.7).blur == pytest.approx(0.04 * np.sin(0.7), rel=1e-9)


def test_what_lies_far_away_is_called_by_no_other_name() -> None:
    assert response(0.7, 1.1 * NEAR).blur == 0.0
