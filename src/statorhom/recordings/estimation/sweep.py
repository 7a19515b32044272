"""FRFs from sine sweeps: spectra averaged over overlapping segments.

A segment counts at a line as much as the sweep excites it there, so noise from the time when the sweep was
elsewhere hardly enters. Overlapping Hann segments leave no first-order bias from vibration that one segment
hands on to the next; the second-order one is given with `SweepSettings.segment_s`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import numpy.typing as npt

from statorhom.errors import RecordingError
from statorhom.recordings.dof import Dof
from statorhom.recordings.estimation.estimators import coherence, frf, relative_sd_of_coherence
from statorhom.recordings.estimation.segments import check_records, record_name
from statorhom.recordings.estimation.settings import SweepSettings
from statorhom.recordings.estimation.spectra import AveragedSpectra
from statorhom.recordings.frf_set import FrfSet
from statorhom.recordings.hit import Hit

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_STEPS = 4  # per segment: 75 % overlap, from which Hann segments weigh all samples alike in power
_INDEPENDENT = 0.52  # of segments at that overlap (Welch 1967, with Hann's correlations 0.66, 0.17, 0.01)
_UNEXCITED = 1e-8  # of the strongest line's power


def estimate_sweep_frf(records: Sequence[Hit], settings: SweepSettings) -> FrfSet:
    """Estimate FRFs from records of sine sweeps.

    Records of the same reference and responses are averaged, so the stages of a sweep may come in one record
    or in several.

    Parameters
    ----------
    records : sequence of Hit
        Force and accelerations of each sweep, from before its start until the vibration has decayed.
    settings : SweepSettings

    Raises
    ------
    RecordingError
        When the records' sample rates differ, they are shorter than a segment, values are no numbers, or
        the force does not reach all of the band.
    """
    check_records(records)
    rate = records[0].sample_rate_hz
    samples = round(settings.segment_s * rate)
    frequency = np.fft.rfftfreq(samples, 1.0 / rate)
    lines = slice(
        max(1, int(np.searchsorted(frequency, settings.start_hz))),
        int(np.searchsorted(frequency, settings.stop_hz, side="right")),
    )
    if lines.stop <= lines.start:
        raise RecordingError("the swept band holds no line: give a longer segment_s")
    groups: dict[tuple[Dof, tuple[Dof, ...]], list[Hit]] = {}
    for record in records:
        groups.setdefault((record.reference, record.responses), []).append(record)
    spectra = [_averaged(group, samples, lines) for group in groups.values()]
    return FrfSet(
        frequency_hz=frequency[lines],
        responses=tuple(dof for _, responses in groups for dof in responses),
        references=tuple(reference for reference, responses in groups for _ in responses),
        accelerance=np.concatenate([frf(one, settings.estimator) for one in spectra]),
        coherence=np.concatenate([coherence(one) for one in spectra]),
        relative_sd=np.concatenate([relative_sd_of_coherence(one) for one in spectra]),
        source=records[0].source,
    )


def _averaged(records: Sequence[Hit], samples: int, lines: slice) -> AveragedSpectra:
    """Averages over all segments of all records of a set-up."""
    channels = len(records[0].responses)
    force = np.zeros(lines.stop - lines.start)
    response = np.zeros((channels, len(force)))
    cross = np.zeros(response.shape, dtype=complex)
    window = np.hanning(samples + 1)[:-1]
    step = samples // _STEPS
    segments = 0.0
    for record in records:
        for signals in _segments(record, samples, step):
            spectrum = np.fft.rfft(window * signals, axis=1)[:, lines]
            force += np.abs(spectrum[0]) ** 2
            response += np.abs(spectrum[1:]) ** 2
            cross += spectrum[1:] * spectrum[0].conj()
        segments += len(record.force_n) / step
    if force.min() <= _UNEXCITED * force.max():
        raise RecordingError(f"{record_name(records[0])}: the force does not excite all of the swept band")
    return AveragedSpectra(
        force=np.broadcast_to(force, response.shape) / segments,
        response=response / segments,
        cross=np.asarray(cross / segments, dtype=complex),
        averages=np.full(channels, max(_INDEPENDENT * segments, 2.0)),
    )


def _segments(record: Hit, samples: int, step: int) -> Iterator[FloatArray]:
    """Overlapping segments of the force and, below it, the accelerations."""
    if len(record.force_n) < samples:
        raise RecordingError(f"{record_name(record)} is shorter than a segment: give a shorter segment_s")
    signals = np.vstack([record.force_n, record.acceleration_m_s2])
    signals -= signals.mean(axis=1, keepdims=True)
    # all rests before and after the sweep; so its first and last samples count as much as those between
    signals = np.pad(signals, ((0, 0), (samples, samples)))
    for start in range(0, signals.shape[1] - samples + 1, step):
        yield signals[:, start : start + samples]
