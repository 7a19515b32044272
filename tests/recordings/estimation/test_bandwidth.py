"""How high a hit reaches, against the closed-form spectrum of its pulse."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq

from statorhom.recordings.estimation.bandwidth import LARGEST_DROP_DB, upper_usable_hz
from synthetic_hits import pulse


@pytest.mark.parametrize("width_s", [2e-4, 1e-3])
def test_a_haversine_reaches_as_far_as_its_transform(width_s: float) -> None:
    rate = 100e3
    force = pulse(np.arange(100_000) / rate, 0.01, width_s)
    frequency = np.fft.rfftfreq(len(force), 1 / rate)
    reach = upper_usable_hz(frequency, np.abs(np.fft.rfft(force)) ** 2)
    # transform of the haversine of width T: sinc(fT)/(1 − (fT)²)
    expected = brentq(lambda x: np.sinc(x) / (1 - x**2) - 10 ** (-LARGEST_DROP_DB / 20), 1.1, 1.9)
    assert reach == pytest.approx(expected / width_s, abs=2.0)


def test_a_perfect_impulse_reaches_to_the_end() -> None:
    assert upper_usable_hz(np.arange(10.0), np.ones(10)) == 9.0
