"""Overload: a record that was clipped at the end of its range."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from statorhom.recordings.estimation.pulses import noise_sd

FloatArray = npt.NDArray[np.float64]

_SIDE = 0.25  # of the largest swing; a hammer only pushes, and its rest on the other side is no top
_FEWEST = 3  # samples that equal the extreme
_FINEST_STEP = 1e-5  # of the extreme: universal files in ASCII hold six digits
# steps; a parabola whose top holds n equal samples drops by at most nine within n beside them, and by three times that
# where noise lengthens a short top by one
_FLAT_DROP = 30.0
_CLOSE = 100.0  # steps
_LONELY = 2.0  # a smooth top has many more samples close to the extreme than at it
_PILE_FEWEST = 20  # samples
# a smooth top holds at most this many times the next slice's samples and one that sampling may leave out: 2/(√2 − 1),
# where the record begins or ends so near it that the next slice has one flank alone
_PILE = 5.0
_PILE_SIGMAS = 6.0
_WIDEST_SLICE = 0.1  # of the extreme; beyond it noise hides what a top looks like


def is_clipped(record: FloatArray, quiet: FloatArray) -> bool:
    """Whether a record has flat tops at its largest or smallest value.

    Samples that equal the extreme exactly tell it, where a smooth top and the converter's steps do not explain
    them. Where noise was added after clipping, values pile up at the extreme as no smooth top makes them: a
    parabola spends 1/(√2 − 1) = 2.4 times as long in its uppermost slice as in the next one.

    Parameters
    ----------
    record : array, shape (samples,)
    quiet : array
        The part of it that shows the noise.
    """
    swing = record - np.median(record)
    largest = np.abs(swing).max()
    steps = np.diff(np.unique(record))
    step = max(steps.min(initial=largest), _FINEST_STEP * largest)
    noise = noise_sd(quiet)
    sides = [side for side in (swing, -swing) if side.max() > _SIDE * largest]
    return any(_is_flat(side, step) or _stands_alone(side, step) or _piles_up(side, noise) for side in sides)


def _is_flat(side: FloatArray, step: float) -> bool:
    """Samples in a row equal the extreme, and the record falls off steeply beside them."""
    top = side.max()
    edges = np.flatnonzero(np.diff(np.concatenate(([False], side == top, [False])).astype(int)))
    for start, stop in edges.reshape(-1, 2):
        run = stop - start
        beside = np.concatenate((side[max(0, start - run) : start], side[stop : stop + run]))
        if run >= _FEWEST and top - beside.min(initial=top) > _FLAT_DROP * step:
            return True
    return False


def _stands_alone(side: FloatArray, step: float) -> bool:
    """Samples, in a row or not, equal the extreme, and hardly any others come close to it."""
    equal = np.count_nonzero(side == side.max())
    close = np.count_nonzero(side > side.max() - _CLOSE * step)
    return bool(equal >= _FEWEST and close < _LONELY * equal)


def _piles_up(side: FloatArray, noise: float) -> bool:
    top = float(side.max())
    slice_height = _PILE_SIGMAS * noise
    if not 0.0 < slice_height < _WIDEST_SLICE * top:
        return False
    uppermost = int(np.count_nonzero(side > top - slice_height))
    next_one = int(np.count_nonzero(side > top - 2.0 * slice_height)) - uppermost
    return uppermost >= _PILE_FEWEST and uppermost > _PILE * (next_one + 1)
