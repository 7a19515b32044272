"""The second stage of a two-stage sweep, from the modes that the first one found."""

from __future__ import annotations

import math
from collections.abc import Sequence

from statorhom.extraction.extraction import ExtractedMode
from statorhom.recordings.estimation.sweep_plan import SweepStage, fine_stages

_BIAS = 36.0  # over the decay rate: segments that keep the bias at a resonance at 1 %


def second_sweeps(modes: Sequence[ExtractedMode]) -> tuple[SweepStage, ...]:
    """Slow sweeps around the modes; those without damping of their own are left out."""
    return fine_stages([(m.frequency_hz, m.damping_ratio) for m in modes if m.damping_ratio > 0.0])


def segment_s(stage: SweepStage, modes: Sequence[ExtractedMode]) -> float:
    """Length of segments (s) that keeps the bias at the resonances of a stage at 1 %."""
    rates = [
        m.damping_ratio * m.frequency_hz * 2 * math.pi
        for m in modes
        if stage.start_hz <= m.frequency_hz <= stage.stop_hz and m.damping_ratio > 0.0
    ]
    return _BIAS / min(rates)


def second_stage(modes: Sequence[ExtractedMode]) -> list[str]:
    """What to sweep next, one line per stage."""
    return [
        f"second stage: sweep {stage.start_hz:.4g} … {stage.stop_hz:.4g} Hz at {stage.rate_hz_per_s:.2g} Hz/s at most "
        f"({stage.duration_s:.0f} s), segments of {segment_s(stage, modes):.2g} s"
        for stage in second_sweeps(modes)
    ]
