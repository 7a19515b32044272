"""Which modes of an arc look like the even contact's; whole stators with arcs are in `test_joints.py`."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.contacts.joint_born import Surface
from statorhom.model.stator_mode import StatorMode


@pytest.mark.parametrize(("number", "looks_like_it"), [(0, False), (1, True), (2, True)])
def test_a_mode_has_to_look_like_it_in_the_band_and_above_it_nobody_looks(
    number: int, looks_like_it: bool
) -> None:
    """What an arc makes of a mode of the band's end may lie just above it: that is no reason to end with an error."""
    of_order_three = StatorMode(900.0, 3, 0, "radial", 1.0, 2, 0, 0)
    assert Surface(np.array([2, 3]), np.zeros((4, 2))).shows(number, of_order_three) is looks_like_it
