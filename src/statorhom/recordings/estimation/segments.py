"""From records to hits: one hit per record, or several in one stream; all cut to begin alike."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from scipy import fft

from statorhom.errors import RecordingError
from statorhom.recordings.estimation.pulses import Pulse, find_pulses
from statorhom.recordings.estimation.settings import HitSettings
from statorhom.recordings.hit import Hit

_OWN_HIT = 0.25  # of the stream's strongest pulse; a weaker one belongs to the hit before
_FEWEST_SAMPLES = 16


@dataclass(frozen=True)
class FoundHit:
    """A hit and the pulses that its force holds, none where nothing stands out from the noise."""

    hit: Hit
    pulses: tuple[Pulse, ...]


def find_hits(records: Sequence[Hit], settings: HitSettings) -> list[FoundHit]:
    """Find the hits of all records.

    Where a record holds more than one hit, all hits are numbered anew in the order of the records; else they
    keep the numbers of their file.

    Raises
    ------
    RecordingError
        When there is no record, one is too short or holds values that are no numbers, or the sample rates
        differ.
    """
    check_records(records)
    found = [one for record in records for one in _split(record, settings)]
    if len(found) == len(records):
        return found
    return [FoundHit(replace(one.hit, number=i), one.pulses) for i, one in enumerate(found, start=1)]


def check_records(records: Sequence[Hit]) -> None:
    """Refuse records that no FRF can be estimated from.

    Raises
    ------
    RecordingError
    """
    if not records:
        raise RecordingError("there is no time record to estimate FRFs from")
    for record in records:
        if len(record.force_n) < _FEWEST_SAMPLES or not record.responses:
            raise RecordingError(
                f"{record_name(record)} holds {len(record.force_n)} samples of {len(record.responses)} responses: "
                f"at least {_FEWEST_SAMPLES} of one are needed"
            )
        if not (np.isfinite(record.force_n).all() and np.isfinite(record.acceleration_m_s2).all()):
            raise RecordingError(
                f"{record_name(record)} holds values that are no finite numbers: leave it out"
            )
        if not record.sample_rate_hz > 0.0:
            raise RecordingError(f"{record_name(record)} has no positive sample rate")
    first = records[0]
    for record in records:
        if not np.isclose(record.sample_rate_hz, first.sample_rate_hz, rtol=1e-6, atol=0.0):
            raise RecordingError(
                f"{record_name(record)} was sampled at {record.sample_rate_hz:g} Hz and {record_name(first)} at "
                f"{first.sample_rate_hz:g} Hz: give records of one sample rate at a time"
            )


def record_name(hit: Hit) -> str:
    """File and number of a hit, for messages."""
    return f"{hit.source}: hit {hit.number}" if hit.source else f"hit {hit.number}"


def common_frame(found: Sequence[FoundHit], settings: HitSettings) -> tuple[int, int]:
    """Samples before the first pulse and samples in all that every hit offers.

    The end is cut by a percent or two to a length without large prime factors, whose FFT is several times
    faster.
    """
    wanted = round(settings.pre_trigger_s * found[0].hit.sample_rate_hz)
    before = min(wanted, *(one.pulses[0].start for one in found))
    after = min(len(one.hit.force_n) - one.pulses[0].start for one in found)
    samples = before + after
    while fft.next_fast_len(samples, real=True) != samples:
        samples -= 1
    return before, samples


def aligned(found: FoundHit, before: int, samples: int) -> FoundHit:
    """The hit cut to begin `before` samples ahead of its first pulse."""
    start = found.pulses[0].start - before
    return _cut(found, start, start + samples)


def _split(record: Hit, settings: HitSettings) -> list[FoundHit]:
    pulses = find_pulses(record.force_n)
    whole = FoundHit(record, pulses)
    if len(pulses) < 2:
        return [whole]
    heights = np.abs([pulse.height_n for pulse in pulses])
    strong = [p for p, height in zip(pulses, heights, strict=True) if height >= _OWN_HIT * heights.max()]
    separation = settings.separation_s * record.sample_rate_hz
    firsts = [b.start for a, b in pairwise(strong) if b.start - a.start > separation]
    lead = round(min(settings.pre_trigger_s, 0.5 * settings.separation_s) * record.sample_rate_hz)
    starts = [0, *(first - lead for first in firsts)]
    stops = [*starts[1:], len(record.force_n)]
    return [_cut(whole, start, stop) for start, stop in zip(starts, stops, strict=True)]


def _cut(found: FoundHit, start: int, stop: int) -> FoundHit:
    hit = found.hit
    part = replace(
        hit, force_n=hit.force_n[start:stop], acceleration_m_s2=hit.acceleration_m_s2[:, start:stop]
    )
    pulses = tuple(pulse.shifted(start) for pulse in found.pulses if start <= pulse.start < stop)
    return FoundHit(part, pulses)
