"""Rates, stages and signal of a sine sweep."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import signal

from statorhom.errors import RecordingError
from statorhom.recordings.estimation.sweep_plan import (
    SweepStage,
    fine_stages,
    highest_rate_hz_per_s,
    sweep_signal,
    two_stage_plan,
)


@pytest.mark.parametrize("damping", [0.003, 0.02])
def test_at_the_highest_rate_the_envelope_is_nearly_that_of_the_steady_state(damping: float) -> None:
    frequency, rate = 200.0, 20000.0
    peaks = []
    for factor in (1.0, 30.0):
        speed = factor * highest_rate_hz_per_s(frequency, damping)
        reach = 15 * damping * frequency
        force = sweep_signal([SweepStage(frequency - reach, frequency + reach, speed)], rate)
        natural = 2 * np.pi * frequency
        mode = ([1.0, 0.0, 0.0], [1.0, 2 * damping * natural, natural**2])
        numerator, denominator, _ = signal.cont2discrete(mode, 1 / rate, method="foh")
        response = signal.lfilter(np.ravel(numerator), denominator, force)
        peaks.append(2 * damping * np.abs(response).max())
    assert peaks[0] == pytest.approx(1.0, abs=0.1)
    assert peaks[1] < 0.7


@given(
    start=st.floats(0.0, 400.0), span=st.floats(10.0, 500.0), rate=st.floats(20.0, 500.0), down=st.booleans()
)
def test_the_signal_runs_through_its_band_at_its_rate(
    start: float, span: float, rate: float, down: bool
) -> None:
    ends = (start + span, start) if down else (start, start + span)
    stage = SweepStage(*ends, rate)
    sampled = sweep_signal([stage], 20000.0)
    assert stage.duration_s == pytest.approx(span / rate)
    assert len(sampled) == round(stage.duration_s * 20000.0)
    cycles = np.count_nonzero(np.diff(np.signbit(sampled))) / 2
    assert cycles == pytest.approx((start + span / 2) * stage.duration_s, abs=2)


def test_fine_stages_that_meet_are_swept_in_one() -> None:
    apart = fine_stages([(1432.0, 0.003), (612.0, 0.004)])
    assert [0.5 * (stage.start_hz + stage.stop_hz) for stage in apart] == pytest.approx([612.0, 1432.0])
    (one,) = fine_stages([(1000.0, 0.003), (1004.0, 0.001)])
    assert (one.start_hz, one.stop_hz) == pytest.approx((970.0, 1030.0))
    assert one.rate_hz_per_s == highest_rate_hz_per_s(1004.0, 0.001)


def test_only_modes_that_the_coarse_stage_passes_too_fast_get_a_fine_one() -> None:
    coarse, fine = two_stage_plan(100.0, 3000.0, 50.0, [(612.0, 0.004), (2650.0, 0.006)])
    assert (coarse.start_hz, coarse.stop_hz, coarse.rate_hz_per_s) == (100.0, 3000.0, 50.0)
    assert fine.start_hz < 612.0 < fine.stop_hz
    assert fine.rate_hz_per_s == pytest.approx(216 / 60 * (0.004 * 612.0) ** 2)


@pytest.mark.parametrize(
    "stage", [(100.0, 100.0, 1.0), (100.0, 200.0, 0.0), (-1.0, 5.0, 1.0), (1.0, 5.0, np.nan)]
)
def test_a_sweep_that_is_none_is_refused(stage: tuple[float, float, float]) -> None:
    with pytest.raises(RecordingError, match="is none"):
        SweepStage(*stage)


def test_a_sample_rate_too_low_is_refused() -> None:
    with pytest.raises(RecordingError, match="sample rate"):
        sweep_signal([SweepStage(0.0, 600.0, 10.0)], 1000.0)
