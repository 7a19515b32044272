"""Scaled Jacobian of the section's quadrilaterals: 1 for a rectangle, 0 where a cell begins to fold."""

from __future__ import annotations

import numpy as np

# (ξ, η) of the nodes: four corners, then the mid-sides of edges 01, 12, 23, 30; the centre is the ninth point
_NODES = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1), (0, -1), (1, 0), (0, 1), (-1, 0)], dtype=float)
_POINTS = np.vstack([_NODES, (0.0, 0.0)])


def scaled_jacobians(points: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """Least scaled Jacobian det J / (|∂x/∂ξ| |∂x/∂η|) of 8-node quadrilaterals at their nodes and centres.

    Parameters
    ----------
    points : (n, 2) node positions.
    quads : (..., 8) node numbers, counter-clockwise.

    Returns
    -------
    ndarray, shape (...)
    """
    along = np.einsum("pda,...ai->...pdi", _GRADIENTS, points[quads])
    xi, eta = along[..., 0, :], along[..., 1, :]
    determinant = xi[..., 0] * eta[..., 1] - xi[..., 1] * eta[..., 0]
    size = np.linalg.norm(xi, axis=-1) * np.linalg.norm(eta, axis=-1)
    return np.asarray((determinant / size).min(axis=-1))


def _gradients(point: np.ndarray) -> np.ndarray:
    """(2, 8) derivatives of the serendipity functions by ξ and η."""
    columns = []
    for node in _NODES:
        (x, y), (a, b) = point, node
        if a and b:
            by_x = a * (1 + b * y) * (2 * a * x + b * y) / 4
            by_y = b * (1 + a * x) * (2 * b * y + a * x) / 4
        elif b:
            by_x, by_y = -x * (1 + b * y), b * (1 - x**2) / 2
        else:
            by_x, by_y = a * (1 - y**2) / 2, -y * (1 + a * x)
        columns.append((by_x, by_y))
    return np.array(columns).T


_GRADIENTS = np.array([_gradients(point) for point in _POINTS])
