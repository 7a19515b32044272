"""How FRFs are estimated."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

from statorhom.errors import RecordingError
from statorhom.recordings.estimation.fault import FaultKind

Estimator = Literal["H1", "H2", "Hv"]
Spread = Literal["coherence", "repeats"]


@dataclass(frozen=True)
class HitSettings:
    """How FRFs are estimated from hits.

    Parameters
    ----------
    estimator : "H1", "H2" or "Hv"
        H1 is free of bias from noise of the response, H2 from noise of the force.
    spread : "coherence" or "repeats"
        Whether the standard deviation comes from the coherence (two hits) or from leaving out one hit at a
        time (three hits).
    exponential_end_level : float
        What the exponential window has fallen to when the record ends, over 0 up to 1; 1 is no window.
    highest_hz : float or None
        Upper end of the FRFs; None as far as the force reaches.
    separation_s : float
        Strong pulses further apart are hits of their own, closer ones are a double hit.
    pre_trigger_s : float
        What is kept of a record before the pulse.
    keep : frozenset of FaultKind
        Faults whose hits are averaged all the same: "double_hit", "overload".

    Raises
    ------
    RecordingError
        When a value is outside its range.
    """

    estimator: Estimator = "H1"
    spread: Spread = "coherence"
    exponential_end_level: float = 1.0
    highest_hz: float | None = None
    separation_s: float = 0.5
    pre_trigger_s: float = 0.005
    keep: frozenset[FaultKind] = frozenset()

    def __post_init__(self) -> None:
        _one_of("estimator", self.estimator, get_args(Estimator))
        _one_of("spread", self.spread, get_args(Spread))
        for kind in self.keep:
            _one_of("keep", kind, get_args(FaultKind))
        if not 0.0 < self.exponential_end_level <= 1.0:
            raise RecordingError("exponential_end_level must lie over 0 and at most at 1")
        if self.highest_hz is not None and not self.highest_hz > 0.0:
            raise RecordingError("highest_hz must be positive")
        if not self.separation_s > 0.0 or not self.pre_trigger_s >= 0.0:
            raise RecordingError("separation_s must be positive and pre_trigger_s not negative")


@dataclass(frozen=True)
class SweepSettings:
    """How FRFs are estimated from sine sweeps.

    Parameters
    ----------
    start_hz, stop_hz : float
        Band that was swept.
    segment_s : float
        Length of the segments that are averaged (s); its inverse is the spacing of the lines. The bias at a
        resonance of decay rate σ is (2π/(σ·segment_s))²/3, so 36/σ keeps it at 1 %.
    estimator : "H1", "H2" or "Hv"

    Raises
    ------
    RecordingError
        When a value is outside its range.
    """

    start_hz: float
    stop_hz: float
    segment_s: float
    estimator: Estimator = "H1"

    def __post_init__(self) -> None:
        _one_of("estimator", self.estimator, get_args(Estimator))
        if not 0.0 <= self.start_hz < self.stop_hz:
            raise RecordingError("a sweep's stop_hz must lie over its start_hz, and that not below 0")
        if not self.segment_s > 0.0:
            raise RecordingError("segment_s must be positive")


def _one_of(name: str, value: str, allowed: tuple[str, ...]) -> None:
    if value not in allowed:
        raise RecordingError(f"{name} = {value!r} is not known: use one of {', '.join(allowed)}")
