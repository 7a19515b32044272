"""Pulses are found wherever they are, and ringing and noise are no pulses."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from statorhom.recordings.estimation.pulses import find_pulses, noise_sd
from synthetic_hits import RATE_HZ, pulse

TIME = np.arange(12800) / RATE_HZ


def force(
    *pulses: tuple[float, float], noise: float = 0.0, seed: int = 0, width_s: float = 1e-3
) -> np.ndarray:
    clean = sum(height * pulse(TIME, start, width_s) for start, height in pulses)
    return clean + noise * np.random.default_rng(seed).standard_normal(len(TIME))


@given(
    first=st.floats(0.01, 0.3),
    gap=st.floats(0.002, 0.5),
    fraction=st.floats(0.2, 1.5),
    height=st.floats(-1e4, 1e4).filter(lambda h: abs(h) > 1e-3),
    offset=st.floats(-1.0, 1.0),
)
def test_both_pulses_of_a_double_hit_are_found(
    first: float, gap: float, fraction: float, height: float, offset: float
) -> None:
    record = (
        force((first, height), (first + gap, fraction * height), noise=0.02 * abs(height)) + offset * height
    )
    found = find_pulses(record)
    assert len(found) == 2
    middles = [0.5 * (one.start + one.stop) / RATE_HZ for one in found]
    assert middles == pytest.approx([first + 5e-4, first + gap + 5e-4], abs=3e-4)
    assert [one.height_n for one in found] == pytest.approx(
        [height, fraction * height], abs=0.15 * abs(height)
    )


def test_noise_makes_no_pulse() -> None:
    for seed in range(200):
        assert len(find_pulses(force((0.1, 100.0), noise=3.0, seed=seed))) == 1


@pytest.mark.parametrize("ringing_hz", [300.0, 700.0, 1100.0, 2500.0])
def test_ringing_of_the_hammer_is_no_pulse(ringing_hz: float) -> None:
    after = TIME - 0.101
    for phase in np.linspace(0, 2 * np.pi, 9):
        ringing = 3.0 * np.exp(-20.0 * after) * np.cos(2 * np.pi * ringing_hz * after + phase) * (after > 0)
        assert len(find_pulses(force((0.1, 100.0)) + ringing)) == 1


def test_ringing_of_an_ideal_filter_is_no_pulse() -> None:
    spectrum = np.fft.rfft(force((0.1, 100.0), width_s=3e-4))
    spectrum[np.fft.rfftfreq(len(TIME), 1 / RATE_HZ) > 4000.0] = 0.0
    assert len(find_pulses(np.fft.irfft(spectrum))) == 1


@pytest.mark.parametrize("record", [np.zeros(1000), np.random.default_rng(0).standard_normal(1000)])
def test_no_pulse_in_silence_and_in_noise(record: np.ndarray) -> None:
    assert find_pulses(record) == ()


def test_a_pulse_cut_off_by_the_record_s_beginning_is_found() -> None:
    (found,) = find_pulses(force((-4e-4, 100.0)))
    assert found.start == 0


def test_noise_is_measured_beside_the_pulse() -> None:
    assert noise_sd(force((0.1, 1e4), noise=2.0)) == pytest.approx(2.0, rel=0.05)
