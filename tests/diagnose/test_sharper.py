"""What a model of an explanation's own is made for."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.sharper import _arcs
from statorhom.physics.action import Action, Joint

WOUND = ("winding", "overhang")


def joint(width: float | None, ratio: float = 1.0) -> Action:
    return Action(joint=Joint(WOUND, 1e14, 1e14, None if width is None else (2.0, width), ratio))


def test_lost_contacts_are_solved_on_either_side_of_the_found_one() -> None:
    narrow, wide = _arcs([Action(), joint(1.0, 1e-3)])
    assert narrow[0] < 1.0 < wide[0]
    assert narrow[1] > 1e-3 > wide[1]
    assert np.sqrt(narrow[0] * wide[0]) == pytest.approx(1.0)
    assert np.sqrt(narrow[1] * wide[1]) == pytest.approx(1e-3)


def test_no_arc_is_wider_than_the_circle() -> None:
    assert max(width for width, _ in _arcs([joint(6.0, 0.1)])) == pytest.approx(2 * np.pi)


def test_contacts_that_are_the_same_all_around_need_no_arcs() -> None:
    assert _arcs([Action(), joint(None)]) == ()
