"""Cells beside a curved side follow it: the curvature of a patch's sides fades out linearly across the patch.

gmsh puts the mid-side nodes of inner edges half-way between their corners. A thin cell between an arc and
such a straight edge is distorted, and folded where the arc rises higher than the cell is thick.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np


def follow_boundary(points: np.ndarray, grids: Iterable[np.ndarray]) -> np.ndarray:
    """Positions with the inner mid-side nodes of every patch moved.

    Parameters
    ----------
    points : (n, 2) node positions; those of mid-side nodes on the patches' sides are right.
    grids : (i, j, 8) node numbers of every patch's quadrilaterals.

    Returns
    -------
    ndarray, shape (n, 2)
    """
    moved = points.copy()
    for grid in grids:
        corners = _corners(grid)
        _fade(moved, corners, np.concatenate([grid[:, :, 4], grid[:, -1:, 6]], axis=1))
        _fade(moved, corners.T, np.concatenate([grid[:, :, 7], grid[-1:, :, 5]], axis=0).T)
    return moved


def _corners(grid: np.ndarray) -> np.ndarray:
    """(i + 1, j + 1) node numbers of the cells' corners."""
    last = np.concatenate([grid[-1:, :, 1], grid[-1:, -1:, 2]], axis=1)
    return np.concatenate([np.concatenate([grid[:, :, 0], grid[:, -1:, 3]], axis=1), last])


def _fade(points: np.ndarray, corner: np.ndarray, middle: np.ndarray) -> None:
    """Move the inner mid-sides along the grid's first direction.

    Node middle[i, j] lies between corner[i, j] and corner[i + 1, j]; those of the first and the last j stay.
    """
    straight = (points[corner[:-1]] + points[corner[1:]]) / 2
    first, last = (points[middle[:, side]] - straight[:, side] for side in (0, -1))
    steps = np.linalg.norm(np.diff(straight, axis=1), axis=2)
    share = (np.cumsum(steps, axis=1) / steps.sum(axis=1, keepdims=True))[:, :-1, None]
    points[middle[:, 1:-1]] = straight[:, 1:-1] + (1 - share) * first[:, None] + share * last[:, None]
