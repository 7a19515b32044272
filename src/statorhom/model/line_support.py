"""Axial lines on the outer surface: the points that carry a line's motion, and springs along it.

On a line the displacement is quadratic in z within every element, whatever the line's angle: its values at
the levels of corners and mid-sides say all.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from statorhom.model.surface_grid import SurfaceGrid

# ∫ N_i N_j over a quadratic element of unit length: low end, middle, high end
_CONSISTENT = np.array([[4.0, 2.0, -1.0], [2.0, 16.0, 2.0], [-1.0, 2.0, 4.0]]) / 30


def line_points(grid: SurfaceGrid, angles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Angles and levels of the points of lines at `angles` (rad), line by line."""
    levels = grid.node_levels
    return np.repeat(angles, len(levels)), np.tile(levels, len(angles))


def line_stiffness(grid: SurfaceGrid, lines: int, per_metre: np.ndarray) -> sp.csr_array:
    """Springs (3 p, 3 p) along lines, acting on the components of their points.

    Parameters
    ----------
    lines : number of lines.
    per_metre : (3,) radial, tangential and axial stiffness per metre of a line (N/m²).
    """
    lengths = np.diff(grid.levels)
    first = 2 * np.arange(len(lengths))[:, None, None]
    local = np.arange(3)
    rows = np.broadcast_to(first + local[:, None], (len(lengths), 3, 3))
    columns = np.broadcast_to(first + local, (len(lengths), 3, 3))
    values = lengths[:, None, None] * _CONSISTENT
    n = 2 * len(lengths) + 1
    one = sp.csr_array((values.ravel(), (rows.ravel(), columns.ravel())), shape=(n, n))
    return sp.csr_array(sp.kron(sp.kron(sp.eye_array(lines), one), sp.diags_array(per_metre)))
