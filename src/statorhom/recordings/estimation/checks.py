"""What is wrong with each hit."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.recordings.estimation.bandwidth import LARGEST_DROP_DB, upper_usable_hz
from statorhom.recordings.estimation.fault import LEFT_OUT, NEVER_USED, Fault, FaultKind
from statorhom.recordings.estimation.leakage import end_level
from statorhom.recordings.estimation.overload import is_clipped
from statorhom.recordings.estimation.pulses import noise_sd
from statorhom.recordings.estimation.segments import FoundHit, record_name
from statorhom.recordings.estimation.settings import HitSettings
from statorhom.recordings.estimation.spectra import windowed_force

_SHORT = 0.5  # of the median length
_WEAK = 0.1  # of the median height
_NARROW = 0.5  # of the median bandwidth
_NOISY = 0.05  # of the pulse's height
_NOT_DECAYED = 0.05  # of the beginning's amplitude, with the window
_FEWEST_FOR_A_MEDIAN = 3


@dataclass(frozen=True)
class CheckedHit:
    """An aligned hit, what is wrong with it, and the frequency up to which its force excites."""

    found: FoundHit
    faults: tuple[Fault, ...]
    reach_hz: float

    def used(self, settings: HitSettings) -> list[bool]:
        """Which of its responses are averaged."""
        dropped = {fault.channel for fault in self.faults if fault.kind in LEFT_OUT - settings.keep}
        return [not {None, channel} & dropped for channel in range(len(self.found.hit.responses))]


def usable(found: Sequence[FoundHit], settings: HitSettings) -> tuple[list[FoundHit], list[Fault]]:
    """Hits without those that hold no pulse, or a record that would cut all others short."""
    left, faults = [], []
    lengths = [len(one.hit.force_n) - one.pulses[0].start for one in found if one.pulses]
    for one in found:
        if not one.pulses:
            faults.append(_fault(one, None, "no_hit", "no force pulse stands out from the noise", settings))
        elif len(one.hit.force_n) - one.pulses[0].start < _SHORT * float(np.median(lengths)):
            seconds = len(one.hit.force_n) / one.hit.sample_rate_hz
            what = f"its record of {seconds:.3g} s is less than half as long as the others"
            faults.append(_fault(one, None, "short", what, settings))
        else:
            left.append(one)
    return left, faults


def check_hits(found: Sequence[FoundHit], decay_per_s: float, settings: HitSettings) -> list[CheckedHit]:
    """Check hits that hold a pulse and are aligned.

    Parameters
    ----------
    found : sequence of FoundHit
        All hits of a measurement: weak ones are told by comparison.
    decay_per_s : float
        Of the exponential window that will be applied (1/s).
    settings : HitSettings
    """
    heights = np.array([max(abs(pulse.height_n) for pulse in one.pulses) for one in found])
    reaches = np.array([_reach_hz(one) for one in found])
    checked = []
    for one, height, reach in zip(found, heights, reaches, strict=True):
        faults = (
            *_double_hit(one, settings),
            *_overload(one, settings),
            *_leakage(one, decay_per_s, settings),
            *_weak(one, height, heights, settings),
            *_bandwidth(one, reach, reaches, settings),
            *_noisy_force(one, height, settings),
        )
        checked.append(CheckedHit(one, faults, reach))
    return checked


def _reach_hz(found: FoundHit) -> float:
    # of its strongest pulse alone: the notches of a double hit's spectrum are not the tip's doing
    strongest = max(found.pulses, key=lambda pulse: abs(pulse.height_n))
    force = windowed_force(found.hit.force_n, [strongest])
    frequency = np.asarray(np.fft.rfftfreq(len(force), 1.0 / found.hit.sample_rate_hz), dtype=float)
    return upper_usable_hz(frequency, np.abs(np.fft.rfft(force)) ** 2)


def _double_hit(one: FoundHit, settings: HitSettings) -> Iterator[Fault]:
    if len(one.pulses) > 1:
        first, *others = one.pulses
        second = max(others, key=lambda pulse: abs(pulse.height_n))
        part = 100 * second.height_n / first.height_n
        later = 1e3 * (second.start - first.start) / one.hit.sample_rate_hz
        what = f"a second pulse of {part:.0f} % of the first, {later:.1f} ms after it"
        yield _fault(one, None, "double_hit", what, settings)


def _overload(one: FoundHit, settings: HitSettings) -> Iterator[Fault]:
    if is_clipped(one.hit.force_n, one.hit.force_n):
        yield _fault(one, None, "overload", "the force is clipped", settings)
    for channel, response in enumerate(one.hit.acceleration_m_s2):
        if is_clipped(response, response[-len(response) // 8 :]):
            yield _fault(one, channel, "overload", "the response is clipped", settings)


def _leakage(one: FoundHit, decay_per_s: float, settings: HitSettings) -> Iterator[Fault]:
    start = one.pulses[0].start
    for channel, response in enumerate(one.hit.acceleration_m_s2):
        seconds = len(response[start:]) / one.hit.sample_rate_hz
        level, line = end_level(response[start:])
        level *= float(np.exp(-decay_per_s * seconds))
        if level > _NOT_DECAYED:
            what = (
                f"near {8 * line / seconds:.0f} Hz {100 * level:.0f} % of the vibration are left when the record "
                "ends; record longer or set exponential_end_level"
            )
            yield _fault(one, channel, "leakage", what, settings)


def _weak(one: FoundHit, height: float, heights: np.ndarray, settings: HitSettings) -> Iterator[Fault]:
    typical = float(np.median(heights))
    if len(heights) >= _FEWEST_FOR_A_MEDIAN and height < _WEAK * typical:
        what = f"its {height:.3g} N are less than a tenth of the usual {typical:.3g} N"
        yield _fault(one, None, "weak", what, settings)
    for channel, response in enumerate(one.hit.acceleration_m_s2):
        if np.ptp(response) == 0.0:
            yield _fault(one, channel, "weak", "the response does not move at all", settings)


def _bandwidth(one: FoundHit, reach: float, reaches: np.ndarray, settings: HitSettings) -> Iterator[Fault]:
    if settings.highest_hz is not None:
        needed = settings.highest_hz
    elif len(reaches) >= _FEWEST_FOR_A_MEDIAN:
        needed = _NARROW * float(np.median(reaches))
    else:
        return
    if reach < needed:
        what = (
            f"its force reaches up to {reach:.0f} Hz only ({LARGEST_DROP_DB:g} dB down), {needed:.0f} Hz are needed; "
            "take a harder tip"
        )
        yield _fault(one, None, "bandwidth", what, settings)


def _noisy_force(one: FoundHit, height: float, settings: HitSettings) -> Iterator[Fault]:
    noise = noise_sd(one.hit.force_n) / height
    if noise > _NOISY:
        yield _fault(
            one, None, "noisy_force", f"the force's noise is {100 * noise:.0f} % of its pulse", settings
        )


def _fault(one: FoundHit, channel: int | None, kind: FaultKind, what: str, settings: HitSettings) -> Fault:
    where = "" if channel is None else f", response at node {one.hit.responses[channel].node}"
    dropped = kind in NEVER_USED or (kind in LEFT_OUT and kind not in settings.keep)
    end = "; left out of the average" if dropped else ""
    return Fault(one.hit.number, channel, kind, f"{record_name(one.hit)}{where}: {what}{end}")
