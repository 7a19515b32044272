"""What is left of a vibration when its record ends."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from statorhom.recordings.estimation.leakage import end_level

TIME = np.arange(16000) / 16000.0


def noise(size: float, seed: int = 0) -> np.ndarray:
    return size * np.random.default_rng(seed).standard_normal(len(TIME))


@given(decay=st.floats(0.5, 6.0), frequency_hz=st.floats(60.0, 7000.0), size=st.floats(1e-3, 1e3))
def test_level_of_one_mode(decay: float, frequency_hz: float, size: float) -> None:
    record = size * np.exp(-decay * TIME) * np.sin(2 * np.pi * frequency_hz * TIME)
    level, line = end_level(record)
    assert level == pytest.approx(np.exp(-decay), rel=0.05)
    assert 8 * line == pytest.approx(frequency_hz, abs=12.0)


def test_a_lightly_damped_mode_is_found_below_a_heavily_damped_one() -> None:
    strong = np.exp(-60.0 * TIME) * np.sin(2 * np.pi * 900 * TIME)
    weak = 0.1 * np.exp(-1.0 * TIME) * np.sin(2 * np.pi * 2100 * TIME)
    level, line = end_level(strong + weak + noise(0.01))
    assert level == pytest.approx(np.exp(-1.0), rel=0.1)
    assert 8 * line == pytest.approx(2100, abs=12)


def test_noise_is_no_leakage() -> None:
    for seed in range(100):
        record = np.exp(-30.0 * TIME) * np.sin(2 * np.pi * 900 * TIME) + noise(0.03, seed)
        assert end_level(record)[0] < 0.02


def test_filtered_noise_is_no_leakage() -> None:
    spectrum = np.fft.rfft(noise(0.03))
    spectrum[len(spectrum) // 2 :] *= 1e-6
    record = np.exp(-30.0 * TIME) * np.sin(2 * np.pi * 900 * TIME) + np.fft.irfft(spectrum)
    assert end_level(record)[0] < 0.02


def test_a_record_of_a_few_samples_says_nothing() -> None:
    assert end_level(np.ones(60)) == (0.0, 0)
