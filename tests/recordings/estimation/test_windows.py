"""The exponential window moves poles by exactly its decay, and the force window leaves the pulse alone."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from statorhom.recordings.estimation.windows import (
    decay_of_end_level,
    exponential_window,
    force_window,
    true_pole,
)


@given(sigma=st.floats(0.1, 100.0), decay=st.floats(0.0, 50.0), damped=st.floats(100.0, 2e4))
def test_the_windowed_decay_s_pole_is_corrected_exactly(sigma: float, decay: float, damped: float) -> None:
    rate = 51200.0
    free = np.exp((-sigma + 1j * damped) * np.arange(64) / rate)
    windowed = free * exponential_window(64, rate, decay)
    measured = rate * np.log(windowed[1] / windowed[0])
    assert true_pole(measured, decay) == pytest.approx(-sigma + 1j * damped, rel=1e-9)


@given(level=st.floats(1e-6, 1.0), duration=st.floats(0.1, 20.0))
def test_the_window_ends_at_its_level(level: float, duration: float) -> None:
    window = exponential_window(1001, 1000.0 / duration, decay_of_end_level(level, duration))
    assert window[0] == 1.0
    assert window[-1] == pytest.approx(level)


@given(start=st.integers(0, 400), width=st.integers(1, 100))
def test_the_force_window_keeps_the_pulse_and_nothing_else(start: int, width: int) -> None:
    window = force_window(2000, start, start + width)
    assert (window[start : start + width] == 1.0).all()
    assert (window[start + width + 4 * max(width, 16) :] == 0.0).all()
    assert ((window >= 0.0) & (window <= 1.0)).all()
    assert (np.diff(window[start + width :]) <= 0.0).all()
