"""Plan of a sine sweep: stages of constant rate, slow enough for the modes that they pass.

Source of the highest rate: ISO 7626-2:1990, for a linear sweep 54·f²/Q² Hz/min = 216·ζ²f² Hz/min
(see also Ewins, Modal Testing, 2000, section 3.6).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.errors import RecordingError

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class SweepStage:
    """A sweep at constant rate.

    Attributes
    ----------
    start_hz, stop_hz : float
    rate_hz_per_s : float
        Positive; the sweep runs from start to stop in either direction.

    Raises
    ------
    RecordingError
        When the stage has no length or no positive rate.
    """

    start_hz: float
    stop_hz: float
    rate_hz_per_s: float

    def __post_init__(self) -> None:
        if (
            min(self.start_hz, self.stop_hz) < 0.0
            or self.start_hz == self.stop_hz
            or not self.rate_hz_per_s > 0.0
        ):
            raise RecordingError(
                f"a sweep from {self.start_hz:g} to {self.stop_hz:g} Hz at {self.rate_hz_per_s:g} Hz/s is none: "
                "give two frequencies and a positive rate"
            )

    @property
    def duration_s(self) -> float:
        """How long the stage takes (s)."""
        return abs(self.stop_hz - self.start_hz) / self.rate_hz_per_s


def highest_rate_hz_per_s(frequency_hz: float, damping_ratio: float) -> float:
    """Highest rate at which a linear sweep past a resonance still shows its steady state: 3.6·ζ²f²."""
    return 216.0 / 60.0 * (damping_ratio * frequency_hz) ** 2


def fine_stages(
    modes: Sequence[tuple[float, float]], half_power_bandwidths: float = 5.0
) -> tuple[SweepStage, ...]:
    """Second stage of a two-stage sweep: slowly around each resonance that the first, coarse one showed.

    Parameters
    ----------
    modes : sequence of (frequency_hz, damping_ratio)
    half_power_bandwidths : float
        Half-power bandwidths 2ζf on either side of a resonance; ranges that meet are swept in one, at the
        lower one of their rates.

    Returns
    -------
    tuple of SweepStage
        In the order of frequency.
    """
    stages: list[SweepStage] = []
    for frequency, damping in sorted(modes):
        reach = half_power_bandwidths * 2.0 * damping * frequency
        stage = SweepStage(
            max(frequency - reach, 0.0), frequency + reach, highest_rate_hz_per_s(frequency, damping)
        )
        if stages and stage.start_hz <= stages[-1].stop_hz:
            stage = _joined(stages.pop(), stage)
        stages.append(stage)
    return tuple(stages)


def two_stage_plan(
    start_hz: float, stop_hz: float, rate_hz_per_s: float, modes: Sequence[tuple[float, float]]
) -> tuple[SweepStage, ...]:
    """Coarse sweep over the band, then the fine stages of those modes that it passes too fast.

    Parameters
    ----------
    start_hz, stop_hz, rate_hz_per_s : float
        The coarse stage.
    modes : sequence of (frequency_hz, damping_ratio)
        As far as the coarse stage, or a guess, tells them.
    """
    slow = [mode for mode in modes if highest_rate_hz_per_s(*mode) < rate_hz_per_s]
    return (SweepStage(start_hz, stop_hz, rate_hz_per_s), *fine_stages(slow))


def sweep_signal(stages: Sequence[SweepStage], sample_rate_hz: float) -> FloatArray:
    """Sine of amplitude one that runs through the stages, one after the other and each from phase zero.

    Raises
    ------
    RecordingError
        When a stage goes beyond half the sample rate.
    """
    highest = max(max(stage.start_hz, stage.stop_hz) for stage in stages)
    if highest > 0.5 * sample_rate_hz:
        raise RecordingError(f"a sweep to {highest:g} Hz needs a sample rate of more than {2 * highest:g} Hz")
    return np.concatenate([_stage_signal(stage, sample_rate_hz) for stage in stages])


def _stage_signal(stage: SweepStage, sample_rate_hz: float) -> FloatArray:
    time = np.arange(round(stage.duration_s * sample_rate_hz)) / sample_rate_hz
    rate = np.copysign(stage.rate_hz_per_s, stage.stop_hz - stage.start_hz)
    return np.asarray(np.sin(2.0 * np.pi * (stage.start_hz + 0.5 * rate * time) * time))


def _joined(lower: SweepStage, upper: SweepStage) -> SweepStage:
    return SweepStage(
        min(lower.start_hz, upper.start_hz),
        max(lower.stop_hz, upper.stop_hz),
        min(lower.rate_hz_per_s, upper.rate_hz_per_s),
    )
