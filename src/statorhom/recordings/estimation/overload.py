"""Overload: a record that was clipped at the end of its range."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from statorhom.recordings.estimation.pulses import noise_sd

FloatArray = npt.NDArray[np.float64]

_SIDE = 0.25  # of the largest swing; a hammer only pushes, and its rest on the other side is no top
_SHORTEST_FLAT = 3  # samples
_FLAT_DROP = 6.0  # quantization steps; a parabola whose top spans three equal samples drops by at most four
_LEAST_PILE = 6  # samples
_PILE = 5.0  # a smooth top holds at most 5 times as many samples as the next equally high slice
_PILE_SIGMAS = 6.0
_WIDEST_SLICE = 0.2  # of the extreme value; beyond it noise hides what a top looks like


def is_clipped(record: FloatArray, quiet: FloatArray | None = None) -> bool:
    """Whether a record has flat tops at its largest or smallest value.

    Either samples in a row equal the extreme exactly and their neighbours lie further off than a smooth top
    and the converter's steps explain; or, where noise was added after clipping, values pile up at the extreme
    as no smooth top makes them: a parabola spends 1/(√2 − 1) = 2.4 times as long in its uppermost slice as
    in the next one.

    Parameters
    ----------
    record : array, shape (samples,)
    quiet : array or None
        The part of it that shows the noise; None to judge by exactly flat tops alone.
    """
    step = _quantization_step(record)
    noise = 0.0 if quiet is None else noise_sd(quiet)
    swing = record - np.median(record)
    sides = [side for side in (swing, -swing) if side.max() > _SIDE * np.abs(swing).max()]
    return any(_has_flat_top(side, step) or _has_pile(side, noise) for side in sides)


def _quantization_step(record: FloatArray) -> float:
    steps = np.diff(np.unique(record))
    return float(steps.min()) if len(steps) else 0.0


def _has_flat_top(record: FloatArray, step: float) -> bool:
    top = record.max()
    edges = np.flatnonzero(np.diff(np.concatenate(([False], record == top, [False])).astype(int)))
    for start, stop in edges.reshape(-1, 2):
        beside = [record[i] for i in (start - 1, stop) if 0 <= i < len(record)]
        if stop - start >= _SHORTEST_FLAT and beside and top - min(beside) > _FLAT_DROP * step:
            return True
    return False


def _has_pile(record: FloatArray, noise: float) -> bool:
    top = float(record.max())
    slice_height = _PILE_SIGMAS * noise
    if not 0.0 < slice_height < _WIDEST_SLICE * top:
        return False
    uppermost = int(np.count_nonzero(record > top - slice_height))
    next_one = int(np.count_nonzero(record > top - 2.0 * slice_height)) - uppermost
    return uppermost >= _LEAST_PILE and uppermost > _PILE * max(next_one, 1)
