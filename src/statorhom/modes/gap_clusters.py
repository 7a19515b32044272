"""Positions that were meant to be one: planes, radii and angles found from the gaps between the points."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int_]

# Scatter within a plane and spacing of planes are different things if their gaps differ this much.
_LEAST_JUMP = 4.0


def gap_clusters(values: npt.ArrayLike, resolution: float) -> IntArray:
    """Sort values into clusters: the gaps between them are either scatter or spacing.

    The sorted gaps jump where scatter ends and spacing begins. The largest jump (as a ratio) is taken, so
    that no accuracy of marking or size of an object has to be known beforehand. Clusters come out as they were
    meant where the least gap between them exceeds the widest within by more than that exceeds the resolution;
    many points leave no jump among their gaps and may scatter further.

    Parameters
    ----------
    values : array_like, shape (points,)
        Positions in any order.
    resolution : float
        Gaps below it are scatter in any case, in the unit of the values.

    Returns
    -------
    ndarray of int, shape (points,)
        Number of each value's cluster, 0 for the lowest values.
    """
    array = np.asarray(values, dtype=float)
    order = np.argsort(array, kind="stable")
    gaps = np.diff(array[order])
    numbers = np.zeros(array.size, dtype=int)
    numbers[order[1:]] = np.cumsum(gaps > _threshold(gaps, resolution))
    return numbers


def angle_clusters(angles_rad: npt.ArrayLike, resolution: float) -> tuple[IntArray, FloatArray]:
    """The same for angles modulo 2π, with the mean angle of every cluster (rad), 0 … 2π ascending.

    Returns
    -------
    numbers : ndarray of int, shape (points,)
    means_rad : ndarray, shape (clusters,)
    """
    angles = np.mod(np.asarray(angles_rad, dtype=float), 2 * np.pi)
    ascending = np.sort(angles)
    gaps = np.diff(ascending, append=ascending[:1] + 2 * np.pi)
    # the circle is opened in its largest gap, so that no cluster is cut
    start = ascending[(int(np.argmax(gaps)) + 1) % angles.size]
    opened = np.mod(angles - start + 1e-12, 2 * np.pi)
    numbers = gap_clusters(opened, resolution)
    means = np.mod(np.bincount(numbers, opened) / np.bincount(numbers) + start - 1e-12, 2 * np.pi)
    means[2 * np.pi - means < resolution] -= 2 * np.pi
    order = np.argsort(means)
    rank = np.empty(order.size, dtype=int)
    rank[order] = np.arange(order.size)
    return rank[numbers], means[order]


def _threshold(gaps: FloatArray, resolution: float) -> float:
    ladder = np.sort(np.concatenate([[resolution], np.maximum(gaps, resolution)]))
    jumps = ladder[1:] / ladder[:-1]
    if jumps.size == 0 or jumps.max() < _LEAST_JUMP:
        return np.inf
    step = int(np.argmax(jumps))
    return float(np.sqrt(ladder[step] * ladder[step + 1]))
