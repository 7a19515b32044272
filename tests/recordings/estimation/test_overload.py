"""Clipped records are told from smooth tops, however finely they were sampled or quantized."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from statorhom.recordings.estimation.overload import is_clipped

TIME = np.arange(20000) / 20000.0


def decaying(frequency_hz: float, decay_per_s: float, phase: float) -> np.ndarray:
    return np.exp(-decay_per_s * TIME) * np.cos(2 * np.pi * frequency_hz * TIME + phase)


def tail(record: np.ndarray) -> np.ndarray:
    return record[-len(record) // 8 :]


SIGNALS = {
    "frequency_hz": st.floats(5.0, 6000.0),
    "decay_per_s": st.floats(5.0, 80.0),
    "phase": st.floats(0, 6.2),
}


@example(frequency_hz=39.0, decay_per_s=6.0, phase=6.07421875, bits=11, noise=0.0)
@example(frequency_hz=60.359375, decay_per_s=5.0, phase=5.0, bits=13, noise=1e-4)
@given(**SIGNALS, bits=st.integers(10, 24), noise=st.sampled_from([0.0, 1e-4, 0.01, 0.03]))
def test_no_smooth_record_is_clipped(
    frequency_hz: float, decay_per_s: float, phase: float, bits: int, noise: float
) -> None:
    record = decaying(frequency_hz, decay_per_s, phase)
    record = record + noise * np.random.default_rng(0).standard_normal(len(record))
    record = np.round(record * 2 ** (bits - 1)) / 2 ** (bits - 1)
    assert not is_clipped(record, tail(record))


@given(
    **SIGNALS,
    level=st.floats(0.3, 0.7),
    noise=st.sampled_from([0.0, 1e-4, 0.01, 0.03]),
    bits=st.integers(12, 24),
)
def test_clipped_records_are_found(
    frequency_hz: float, decay_per_s: float, phase: float, level: float, noise: float, bits: int
) -> None:
    record = decaying(frequency_hz, decay_per_s, phase)
    record = record + noise * np.random.default_rng(0).standard_normal(len(record))
    limit = level * np.abs(record).max()
    record = np.clip(np.round(record * 2 ** (bits - 1)) / 2 ** (bits - 1), -limit, limit)
    assert is_clipped(record, tail(record))
    assert is_clipped(-1e4 * record, tail(-1e4 * record))


@pytest.mark.parametrize("noise", [1e-3, 5e-3])
def test_noise_added_after_clipping_does_not_hide_it(noise: float) -> None:
    record = np.clip(decaying(400.0, 20.0, 0.3), -0.6, 0.6)
    record += noise * np.random.default_rng(1).standard_normal(len(record))
    assert is_clipped(record, tail(record))


@pytest.mark.parametrize("record", [np.zeros(100), np.full(100, 3.0)])
def test_a_silent_channel_is_not_clipped(record: np.ndarray) -> None:
    assert not is_clipped(record, record)


def test_a_force_at_rest_is_not_clipped() -> None:
    force = np.zeros(1000)
    force[100:109] = np.sin(np.pi * np.arange(1, 10) / 10)
    assert not is_clipped(force, force)
    assert is_clipped(np.minimum(force, 0.7), force)
