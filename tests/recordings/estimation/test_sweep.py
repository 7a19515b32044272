"""FRFs of an exactly known structure from sine sweeps."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from statorhom.errors import RecordingError
from statorhom.recordings.estimation.settings import SweepSettings
from statorhom.recordings.estimation.sweep import estimate_sweep_frf
from statorhom.recordings.estimation.sweep_plan import SweepStage, two_stage_plan
from synthetic_hits import DAMPING, FREQUENCIES_HZ, accelerance, sweep

BAND = SweepSettings(start_hz=500.0, stop_hz=2800.0, segment_s=4.0)
TWO_STAGES = two_stage_plan(450.0, 2900.0, 200.0, list(zip(FREQUENCIES_HZ, DAMPING, strict=True)))


def errors(frfs) -> np.ndarray:
    exact = accelerance(frfs.frequency_hz)
    return np.abs(frfs.accelerance - exact) / np.abs(exact)


def test_a_two_stage_sweep_gives_the_exact_frf_within_a_percent() -> None:
    frfs = estimate_sweep_frf([sweep(TWO_STAGES)], BAND)
    near = np.abs(frfs.frequency_hz[:, np.newaxis] / FREQUENCIES_HZ - 1).min(axis=1) < 0.05
    assert errors(frfs)[:, near].max() < 0.01
    assert frfs.frequency_hz[[0, -1]] == pytest.approx([500.0, 2800.0])


def test_stages_in_records_of_their_own_are_averaged() -> None:
    stages = [
        sweep([stage]) for stage in (SweepStage(450.0, 1800.0, 100.0), SweepStage(1700.0, 2900.0, 200.0))
    ]
    frfs = estimate_sweep_frf(stages, BAND)
    assert len(frfs) == 2
    at_modes = np.searchsorted(frfs.frequency_hz, FREQUENCIES_HZ)
    assert errors(frfs)[:, at_modes].max() < 0.01


def test_the_bias_of_short_segments_is_the_stated_one() -> None:
    segment = 2.0
    frfs = estimate_sweep_frf([sweep([SweepStage(450.0, 900.0, 20.0)])], SweepSettings(500.0, 800.0, segment))
    decay = 2 * np.pi * FREQUENCIES_HZ[0] * DAMPING[0]
    at_mode = np.argmin(np.abs(frfs.frequency_hz - FREQUENCIES_HZ[0]))
    assert errors(frfs)[:, at_mode] == pytest.approx((2 * np.pi / (decay * segment)) ** 2 / 3, rel=0.1)


def test_noise_scatters_as_the_relative_sd_says() -> None:
    frfs = estimate_sweep_frf([sweep([SweepStage(450.0, 2900.0, 200.0)], noise=0.03)], BAND)
    ratio = errors(frfs) / frfs.relative_sd
    # the modulus of a complex normal error: median √ln 2 of its standard deviation
    assert np.median(ratio) == pytest.approx(np.sqrt(np.log(2)), rel=0.1)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (SweepSettings(500.0, 6390.0, 1.0), "does not excite"),
        (SweepSettings(500.0, 800.0, 60.0), "shorter than a segment"),
        (SweepSettings(500.1, 500.2, 1.0), "no line"),
    ],
)
def test_what_a_sweep_cannot_give_is_one_clear_line(settings: SweepSettings, words: str) -> None:
    with pytest.raises(RecordingError, match=words):
        estimate_sweep_frf([sweep([SweepStage(450.0, 900.0, 100.0)])], settings)


def test_sweeps_of_mixed_sample_rates_are_refused() -> None:
    record = sweep([SweepStage(450.0, 900.0, 100.0)])
    with pytest.raises(RecordingError, match="sampled at"):
        estimate_sweep_frf([record, replace(record, sample_rate_hz=1e4)], BAND)


@pytest.mark.parametrize("wrong", [(900.0, 500.0, 1.0), (500.0, 900.0, 0.0), (-5.0, 900.0, 1.0)])
def test_settings_of_no_sweep_are_refused(wrong: tuple[float, float, float]) -> None:
    with pytest.raises(RecordingError):
        SweepSettings(*wrong)
