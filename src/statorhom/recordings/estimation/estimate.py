"""FRFs from hammer hits: the way from time records to accelerances with their coherence and spread."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.errors import RecordingError
from statorhom.recordings.dof import Dof
from statorhom.recordings.estimation.checks import CheckedHit, check_hits, usable
from statorhom.recordings.estimation.estimators import (
    coherence,
    frf,
    relative_sd_of_coherence,
    relative_sd_of_repeats,
)
from statorhom.recordings.estimation.fault import LEFT_OUT, Fault
from statorhom.recordings.estimation.segments import aligned, common_frame, find_hits
from statorhom.recordings.estimation.settings import HitSettings
from statorhom.recordings.estimation.spectra import average_spectra, hit_spectra
from statorhom.recordings.estimation.windows import decay_of_end_level
from statorhom.recordings.frf_set import FrfSet
from statorhom.recordings.hit import Hit

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Estimate:
    """FRFs and what their records were like.

    Attributes
    ----------
    frf_sets : tuple of FrfSet
        Accelerances, from which `FrfSet.receptance` is equation [4] of van der Giet & Hameyer; one row per
        set-up and response, in the order of the records.
    faults : tuple of Fault
        All that was found wrong, of hits that were used as well.
    used_hits : tuple of tuple of int
        For every row of the FRF sets the numbers of the hits that it averages.
    upper_hz : float
        Frequency up to which the force excites.
    """

    frf_sets: tuple[FrfSet, ...]
    faults: tuple[Fault, ...]
    used_hits: tuple[tuple[int, ...], ...]
    upper_hz: float


@dataclass(frozen=True)
class _Rows:
    """What one set-up contributes to the FRF set."""

    responses: tuple[Dof, ...]
    references: tuple[Dof, ...]
    accelerance: npt.NDArray[np.complex128]
    coherence: FloatArray
    relative_sd: FloatArray
    used_hits: tuple[tuple[int, ...], ...]


def estimate_frf(hits: Sequence[Hit], settings: HitSettings | None = None) -> Estimate:
    """Estimate the FRFs of a measurement from its hits.

    Hits of the same reference and the same responses are averaged. Hits with a double hit or an overloaded
    force, and channels that were overloaded, are left out unless `settings.keep` names the fault.

    Parameters
    ----------
    hits : sequence of Hit
        Records with one hit each, or streams with several.
    settings : HitSettings, optional

    Raises
    ------
    RecordingError
        When the records' sample rates differ, values are no numbers, or no hit is left to average.
    """
    settings = settings or HitSettings()
    found, faults = usable(find_hits(hits, settings), settings)
    if not found:
        raise RecordingError(f"no hit is left to estimate FRFs from: {faults[0].statement}")
    before, samples = common_frame(found, settings)
    rate = found[0].hit.sample_rate_hz
    decay = decay_of_end_level(settings.exponential_end_level, samples / rate)
    checked = check_hits([aligned(one, before, samples) for one in found], decay, settings)
    faults += [fault for one in checked for fault in one.faults]
    set_ups = _set_ups(checked, settings)
    if not set_ups:
        left_out = next(fault for fault in faults if fault.kind in LEFT_OUT)
        raise RecordingError(
            f"every hit has a fault ({left_out.statement}); settings.keep averages them all the same"
        )
    upper = min(float(np.median([one.reach_hz for one in set_up])) for set_up in set_ups)
    if settings.highest_hz is not None:
        upper = min(upper, settings.highest_hz)
    frequency = np.asarray(np.fft.rfftfreq(samples, 1.0 / rate), dtype=float)
    # records are taken over their rest, so the line at 0 Hz says nothing
    lines = slice(1, int(np.searchsorted(frequency, upper, side="right")))
    rows = [_rows(set_up, decay, lines, settings) for set_up in set_ups]
    sources = tuple(dict.fromkeys(hit.source for hit in hits))
    return Estimate(
        frf_sets=(_frf_set(frequency[lines], rows, decay, sources),),
        faults=tuple(faults),
        used_hits=tuple(numbers for one in rows for numbers in one.used_hits),
        upper_hz=upper,
    )


def _set_ups(checked: Sequence[CheckedHit], settings: HitSettings) -> list[list[CheckedHit]]:
    """Hits of the same reference and responses, as far as any of their responses is used."""
    groups: dict[tuple[Dof, tuple[Dof, ...]], list[CheckedHit]] = {}
    for one in checked:
        if any(one.used(settings)):
            hit = one.found.hit
            groups.setdefault((hit.reference, hit.responses), []).append(one)
    return list(groups.values())


def _rows(set_up: Sequence[CheckedHit], decay_per_s: float, lines: slice, settings: HitSettings) -> _Rows:
    used = np.array([one.used(settings) for one in set_up])
    channels = np.flatnonzero(used.any(axis=0))
    used = used[:, channels]
    pairs = [hit_spectra(one.found, decay_per_s, lines) for one in set_up]
    force = np.array([pair[0] for pair in pairs])
    response = np.array([pair[1][channels] for pair in pairs])
    spectra = average_spectra(force, response, used)
    by_repeats = settings.spread == "repeats"
    hit = set_up[0].found.hit
    return _Rows(
        responses=tuple(hit.responses[channel] for channel in channels),
        accelerance=frf(spectra, settings.estimator),
        coherence=coherence(spectra),
        relative_sd=(
            relative_sd_of_repeats(force, response, used, settings.estimator)
            if by_repeats
            else relative_sd_of_coherence(spectra)
        ),
        references=(hit.reference,) * len(channels),
        used_hits=tuple(
            tuple(one.found.hit.number for one, use in zip(set_up, column, strict=True) if use)
            for column in used.T
        ),
    )


def _frf_set(
    frequency_hz: FloatArray, rows: Sequence[_Rows], decay_per_s: float, sources: tuple[str, ...]
) -> FrfSet:
    return FrfSet(
        frequency_hz=frequency_hz,
        responses=tuple(dof for one in rows for dof in one.responses),
        references=tuple(dof for one in rows for dof in one.references),
        accelerance=np.concatenate([one.accelerance for one in rows]),
        coherence=_unless_unknown(np.concatenate([one.coherence for one in rows])),
        relative_sd=_unless_unknown(np.concatenate([one.relative_sd for one in rows])),
        window_decay_per_s=decay_per_s,
        source=sources[0] if len(sources) == 1 else f"{sources[0]} and {len(sources) - 1} more",
    )


def _unless_unknown(values: FloatArray) -> FloatArray | None:
    return None if np.isnan(values).all() else values
