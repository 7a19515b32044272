"""Modes of the structure without the sensor as the sensor moves them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from statorhom.extraction.extraction import ExtractedMode, Extraction, Loaded
from statorhom.extraction.roving.load import RovingLoad

FloatArray = npt.NDArray[np.float64]

_NEAR = 0.6  # half-power bandwidths, beside half of the split
_FAINT = 0.05  # of a mode's peak: what a load that is not quite right leaves of it where it was
_UNLIKE, _FAINT_AND_UNLIKE = 0.15, 0.2  # the same of one whose loss factor differs by as much
_BESIDE = 1.5  # half-power bandwidths


def loaded(free: Extraction, load: RovingLoad) -> Extraction:
    """The extraction of a recording under a roving sensor from that of its freed FRFs."""
    shifts = load.relative_shifts()
    of = [_mode_of(mode, load) for mode in free.modes]
    strongest = np.zeros(len(load))
    for mode, m in zip(free.modes, of, strict=True):
        if m is not None:
            strongest[m] = max(strongest[m], _peak(mode))
    kept = [i for i, mode in enumerate(free.modes) if not _is_image(mode, load, shifts, strongest)]
    modes = tuple(_moved(free.modes[i], None if of[i] is None else shifts[of[i]], load) for i in kept)
    images = tuple(mode for i, mode in enumerate(free.modes) if i not in kept)
    return replace(
        free,
        modes=modes,
        outside=(*free.outside, *images),
        loaded=Loaded(load, shifts, free, tuple(of[i] for i in kept)),
    )


def _peak(mode: ExtractedMode) -> float:
    size = np.linalg.norm(mode.shape) * np.linalg.norm(mode.participation)
    return float(size / (mode.observed.imag / mode.observed.real))


def _mode_of(mode: ExtractedMode, load: RovingLoad) -> int | None:
    """Number of the load's mode that a freed one is."""
    apart = np.abs(load.poles.real - mode.observed.real)
    reach = _NEAR * load.poles.imag + 0.5 * np.linalg.norm(load.split, axis=1) * load.poles.real
    inside = np.flatnonzero(apart < reach)
    return int(inside[np.argmin(apart[inside])]) if len(inside) else None


def _is_image(mode: ExtractedMode, load: RovingLoad, shifts: FloatArray, strongest: FloatArray) -> bool:
    """Whether a mode is but what is left of a stronger one between its places with and without the sensor."""
    lowest = load.poles.real * (1 + shifts.min(axis=1)) ** 2
    reach = _BESIDE * load.poles.imag
    place = mode.observed.real
    near = (lowest - reach < place) & (place < load.poles.real + reach)
    # halves of a doublet dissipate alike
    loss, own = load.poles.imag / load.poles.real, mode.observed.imag / mode.observed.real
    least = np.where(np.abs(own / loss - 1) > _UNLIKE, _FAINT_AND_UNLIKE, _FAINT)
    return bool(np.any(near & (_peak(mode) < least * strongest)))


def _moved(mode: ExtractedMode, shifts: FloatArray | None, load: RovingLoad) -> ExtractedMode:
    if shifts is None:
        return mode
    moved = 1 + shifts[load.rings.plane]
    middle = float(np.median(moved))
    return replace(
        mode,
        frequency_hz=mode.frequency_hz * middle,
        observed=mode.observed * middle**2,
        shift=(moved / middle - 1).astype(complex)[:, None],
    )
