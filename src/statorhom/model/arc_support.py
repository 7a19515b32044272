"""Arcs of the outer surface: the nodes within them, and springs over exactly their area."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from statorhom.model.element import shape_functions
from statorhom.model.surface_grid import SurfaceGrid

_TURN = 2 * np.pi
_CLOSE = 1e-3  # of a cell: an arc that ends this close to a node ends at the node
# the face y = 0 of the reference cube carries these of the element's twenty shape functions
_FACE = np.array([0, 1, 5, 4, 8, 13, 16, 12])
# where they lie in the cell, in halves of its width and height
_PLACES = np.array([[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1]])


def arc_points(grid: SurfaceGrid, arcs: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Angles (rad) and levels (m) of the points that rigid arcs hold: the nodes within, and the arcs' ends.

    Parameters
    ----------
    arcs : (k, 2) from and to (rad).
    """
    corners, middles, slack = grid.angles, _middles(grid.angles), _CLOSE * _TURN / len(grid.angles)
    points = [_product(corners[_within(corners, arcs, slack)], grid.node_levels)]
    points.append(_product(middles[_within(middles, arcs, slack)], grid.levels))
    ends = np.unique(np.round(np.mod(arcs.ravel(), _TURN), 9))
    away = np.abs(np.angle(np.exp(1j * (ends[:, None] - corners)))).min(axis=1, initial=np.pi)
    # beside a corner, which is held anyhow, an end would add the same conditions again
    points.append(_product(ends[away > slack], grid.node_levels))
    angles, levels = np.hstack(points)
    return angles, levels


def arc_stiffness(
    grid: SurfaceGrid, arcs: np.ndarray, per_area: np.ndarray
) -> tuple[np.ndarray, np.ndarray, sp.csr_array]:
    """Springs over arcs, acting on the components of the surface's nodes.

    Parameters
    ----------
    arcs : (k, 2) from and to (rad).
    per_area : (3,) radial, tangential and axial stiffness per square metre (N/m³).

    Returns
    -------
    angles, z : (p,) nodes of the touched element faces (rad, m).
    stiffness : (3 p, 3 p) (N/m).
    """
    cells, low, high = _covered_cells(grid.angles, arcs)
    count, rows = 2 * len(grid.angles), len(grid.levels) - 1
    if len(cells) == 0:
        return np.empty(0), np.empty(0), sp.csr_array((0, 0))
    left = grid.angles[cells]
    width = np.diff(np.append(grid.angles, _TURN))[cells]
    ring = (2 * cells[:, None] + _PLACES[:, 0]) % count
    blocks, nodes = [], []
    for e in range(rows):
        height = grid.levels[e + 1] - grid.levels[e]
        blocks.append(_cell_blocks(grid.radius, left, width, low, high, height, per_area))
        nodes.append((2 * e + _PLACES[:, 1]) * count + ring)
    used, numbers = np.unique(np.concatenate(nodes), return_inverse=True)
    stiffness = _assemble(np.concatenate(blocks), numbers.reshape(-1, len(_FACE)), len(used))
    around = np.sort(np.concatenate([grid.angles, _middles(grid.angles)]))
    return around[used % count], grid.node_levels[used // count], stiffness


def _cell_blocks(
    radius: float,
    left: np.ndarray,
    width: np.ndarray,
    low: np.ndarray,
    high: np.ndarray,
    height: float,
    per_area: np.ndarray,
) -> np.ndarray:
    """Stiffness (c, 24, 24) of cells that are covered from `low` to `high` (rad)."""
    x, w = np.polynomial.legendre.leggauss(4)
    x, w = (x + 1) / 2, w / 2
    theta = (low[:, None] + (high - low)[:, None] * x).repeat(len(x), axis=1)
    along = (theta - left[:, None]) / width[:, None]
    up = np.tile(x, len(x))
    reference = np.column_stack([along.ravel(), np.zeros(along.size), np.tile(up, len(left))])
    values = shape_functions(reference)[0][:, _FACE].reshape(len(left), -1, len(_FACE))
    node = left[:, None] + width[:, None] * _PLACES[:, 0] / 2
    turn = node[:, None, :] - theta[:, :, None]
    cos, sin, zero = values * np.cos(turn), values * np.sin(turn), np.zeros_like(values)
    motion = np.stack(
        [
            np.stack([cos, -sin, zero], axis=-1),
            np.stack([sin, cos, zero], axis=-1),
            np.stack([zero, zero, values], axis=-1),
        ],
        axis=2,
    ).reshape(len(left), -1, 3, 3 * len(_FACE))
    area = radius * height * (high - low)[:, None] * np.outer(w, w).ravel()
    return np.asarray(np.einsum("cgia,cg,i,cgib->cab", motion, area, per_area, motion, optimize=True))


def _covered_cells(corners: np.ndarray, arcs: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Cells that arcs touch, and from where to where (rad); a cell that two arcs touch is listed twice."""
    edges = np.append(corners, _TURN)
    found = []
    for start, end in arcs:
        for turn in range(int(np.floor(start / _TURN)), int(np.ceil(end / _TURN))):
            low = np.maximum(edges[:-1], start - turn * _TURN)
            high = np.minimum(edges[1:], end - turn * _TURN)
            found += [(i, low[i], high[i]) for i in np.flatnonzero(high - low > 1e-12)]
    table = np.array(found).reshape(-1, 3)
    return table[:, 0].astype(int), table[:, 1], table[:, 2]


def _assemble(blocks: np.ndarray, nodes: np.ndarray, count: int) -> sp.csr_array:
    dofs = (3 * nodes[:, :, None] + np.arange(3)).reshape(len(nodes), -1)
    rows = np.broadcast_to(dofs[:, :, None], blocks.shape)
    columns = np.broadcast_to(dofs[:, None, :], blocks.shape)
    return sp.csr_array((blocks.ravel(), (rows.ravel(), columns.ravel())), shape=(3 * count, 3 * count))


def _middles(corners: np.ndarray) -> np.ndarray:
    return np.asarray((corners + np.append(corners[1:], _TURN)) / 2)


def _within(angles: np.ndarray, arcs: np.ndarray, slack: float) -> np.ndarray:
    """Whether angles lie in any of the arcs."""
    offset = np.mod(angles[:, None] - arcs[:, 0] + slack, _TURN) - slack
    return np.asarray((offset <= (arcs[:, 1] - arcs[:, 0]) + slack).any(axis=1))


def _product(angles: np.ndarray, levels: np.ndarray) -> np.ndarray:
    return np.array([np.repeat(angles, len(levels)), np.tile(levels, len(angles))])
