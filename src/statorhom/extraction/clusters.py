"""Windows of lines: one around every cluster of overlapping poles, and tiles over what lies between them."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_GAP = 3.0  # bandwidths between poles that are fitted apart
_MARGIN = 8.0  # bandwidths of a window beyond its outermost poles
_LARGEST_MARGIN = (
    0.15  # of the frequency, but at least two bandwidths: far lines tell little of a damped mode
)
_LEAST_MARGIN = 15  # lines
_MIXED = 4.0  # a cluster's margin goes by its narrowest pole times this, at most
_LARGEST_CLUSTER = 8
_TILE = 400  # lines
NEIGHBOURS = 3
"""Poles on each side of a cluster whose residues are fitted with it."""


def clusters(poles: ComplexArray) -> list[list[int]]:
    """Indices of poles that overlap, in ascending frequency; very long chains are cut at their widest gaps."""
    order = np.argsort(poles.real)
    frequency = np.sqrt(poles.real)
    width = frequency * poles.imag / poles.real
    groups: list[list[int]] = []
    for i in order.tolist():
        last = groups[-1][-1] if groups else None
        if last is not None and frequency[i] - frequency[last] <= _GAP * max(width[i], width[last]):
            groups[-1].append(i)
        else:
            groups.append([i])
    return [part for group in groups for part in _cut(group, frequency)]


def _cut(group: list[int], frequency: FloatArray) -> list[list[int]]:
    if len(group) <= _LARGEST_CLUSTER:
        return [group]
    gaps = np.diff(frequency[group])[1:-1]
    at = int(np.argmax(gaps)) + 2
    return _cut(group[:at], frequency) + _cut(group[at:], frequency)


def cluster_lines(poles: ComplexArray, omega: FloatArray) -> slice:
    """Lines around the poles of one cluster (angular frequencies squared, in (rad/s)²)."""
    frequency = np.sqrt(poles.real)
    width = frequency * poles.imag / poles.real
    reach = np.minimum(_MARGIN * width, np.maximum(2 * width, _LARGEST_MARGIN * frequency))
    # broad poles among narrow ones do not need their whole margin: long windows with fine lines are slow
    narrowest, spacing = float(width.min()), float(omega[-1] - omega[0]) / (len(omega) - 1)
    reach = np.minimum(reach, np.maximum(_MARGIN * _MIXED * narrowest, _MIXED * _LEAST_MARGIN * spacing))
    low = int(np.searchsorted(omega, np.min(frequency - reach)))
    high = int(np.searchsorted(omega, np.max(frequency + reach)))
    first = int(np.searchsorted(omega, frequency.min())) - _LEAST_MARGIN
    last = int(np.searchsorted(omega, frequency.max())) + _LEAST_MARGIN
    begin = max(0, min(low, first, len(omega) - 2 * _LEAST_MARGIN))
    return slice(begin, min(len(omega), max(high, last, 2 * _LEAST_MARGIN)))


def tiles(covered: list[slice], lines: int) -> list[slice]:
    """Stretches of lines that no window covers, in tiles; short rests are widened into the windows."""
    free = np.ones(lines, dtype=bool)
    for one in covered:
        free[one] = False
    edges = np.flatnonzero(np.diff(np.concatenate([[0], free.astype(int), [0]])))
    result = []
    for begin, end in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        short = max(0, 2 * _LEAST_MARGIN - (end - begin))
        begin, end = max(0, begin - short), min(lines, end + short)
        count = int(np.ceil((end - begin) / _TILE))
        cuts = np.linspace(begin, end, count + 1).astype(int)
        result += [slice(int(a), int(b)) for a, b in pairwise(cuts)]
    return result


def nearest(
    poles: ComplexArray, own: list[int], lines: slice, omega: FloatArray, most: int = NEIGHBOURS
) -> list[int]:
    """Poles beside those of a window: all that lie inside it, and the nearest on each side."""
    frequency = np.sqrt(poles.real)
    others = [i for i in np.argsort(frequency).tolist() if i not in own and np.isfinite(frequency[i])]
    low, high = omega[lines.start], omega[lines.stop - 1]
    below = [i for i in others if frequency[i] < low][-most:]
    above = [i for i in others if frequency[i] > high][:most]
    return below + [i for i in others if low <= frequency[i] <= high] + above
