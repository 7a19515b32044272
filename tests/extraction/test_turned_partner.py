"""Which modes are the other half of a doublet that a roving sensor turns."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np

from statorhom.extraction.turned_partner import turned_partners


def mode(frequency_hz: float, loss: float, moved: float | None = None) -> Any:
    shift = None if moved is None else np.array([[-moved], [0.0], [moved]]) + 0j
    return SimpleNamespace(frequency_hz=frequency_hz, bandwidth_hz=loss * frequency_hz, shift=shift)


def test_what_stays_just_above_a_mode_that_moves_has_its_name() -> None:
    modes = [mode(1000.0, 0.005, 0.003), mode(1004.0, 0.005)]
    assert turned_partners(modes, {0: (2, 1)}) == {1: (2, 1)}


def test_what_lies_farther_off_has_not() -> None:
    assert turned_partners([mode(1000.0, 0.005, 0.003), mode(1011.0, 0.005)], {0: (2, 1)}) == {}


def test_a_mode_with_an_order_of_its_own_is_no_other_half() -> None:
    modes = [mode(1000.0, 0.005, 0.003), mode(1004.0, 0.005)]
    names = {0: (2, 1), 1: (3, 0)}
    assert turned_partners(modes, names, clear=[1]) == {}
    assert turned_partners(modes, names) == {1: (2, 1)}
    assert turned_partners(modes, {0: (2, 1), 1: (2, 0)}, clear=[1]) == {1: (2, 1)}


def test_a_broad_resonance_reaches_no_farther_than_a_sensor_moves_anything() -> None:
    modes = [mode(540.0, 0.06, 0.003), mode(568.0, 0.06)]
    assert turned_partners(modes, {0: (2, 1)}) == {}
