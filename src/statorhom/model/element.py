"""Shape functions of scikit-fem's 20-node hexahedron at Gauss points, in the mesh's local numbering."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from skfem import ElementHexS2
from skfem.quadrature import get_quadrature

# positions of the mesh's local nodes in the reference cube [0, 1]³ (see mesh/hex_mesh.py)
_CORNERS = np.array(
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], dtype=float
)
_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 5), (2, 6), (3, 7), (4, 5), (5, 6), (6, 7), (7, 4)]
REFERENCE_NODES = np.vstack([_CORNERS, [(_CORNERS[a] + _CORNERS[b]) / 2 for a, b in _EDGES]])
ROUNDED = 9  # decimals of a reference coordinate
ORDER = 5  # of the polynomials that Gauss points integrate exactly, unless a mesh asks for another one


@dataclass(frozen=True)
class ShapeTable:
    """Shape functions at points of the reference cube.

    Parameters
    ----------
    points : (q, 3) reference coordinates.
    values : (q, 20).
    gradients : (q, 20, 3), with respect to the reference coordinates.
    weights : (q,) quadrature weights.
    """

    points: np.ndarray
    values: np.ndarray
    gradients: np.ndarray
    weights: np.ndarray

    def by_height(self) -> tuple[ShapeTable, ...]:
        """The points of every height apart, by the third coordinate, which is along the axis of extruded meshes."""
        height = self.points[:, 2].round(ROUNDED)
        parts = (np.flatnonzero(height == one) for one in np.unique(height))
        fields = (self.points, self.values, self.gradients, self.weights)
        return tuple(ShapeTable(*(field[part] for field in fields)) for part in parts)


def shape_functions(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Values (q, 20) and reference gradients (q, 20, 3) at `points` (q, 3)."""
    element = ElementHexS2()
    order = [int(np.argmin(np.abs(element.doflocs - node).sum(axis=1))) for node in REFERENCE_NODES]
    basis = [element.lbasis(points.T, i) for i in order]
    return np.stack([b[0] for b in basis], axis=1), np.stack([b[1].T for b in basis], axis=1)


def shape_values(points: np.ndarray) -> np.ndarray:
    """Values (q, 20) at `points` (q, 3): the same as those of `shape_functions`, from the closed form of the family.

    Zienkiewicz, Taylor and Zhu (2005), The Finite Element Method: Its Basis and Fundamentals, section 4.7.
    """
    nodes = 2.0 * REFERENCE_NODES - 1.0
    place = 2.0 * np.asarray(points, dtype=float)[:, None, :] - 1.0
    factors = 1.0 + place * nodes
    corners = np.prod(factors[:, :8], axis=2) * (np.sum(place * nodes[:8], axis=2) - 2.0) / 8.0
    # along an edge's own axis a parabola, which its node at 0 leaves out of the factors
    middle = np.where(nodes[8:] == 0.0, 1.0 - place**2, factors[:, 8:])
    return np.concatenate([corners, np.prod(middle, axis=2) / 4.0], axis=1)


@cache
def gauss_table(order: int = ORDER) -> ShapeTable:
    """Table on the Gauss points that integrate polynomials of `order` exactly (5: 3 × 3 × 3 points)."""
    points, weights = get_quadrature(ElementHexS2, order)
    return _table(points.T, weights)


def layer_table(axis: int, low: float, high: float, order: int = ORDER) -> ShapeTable:
    """Table on the Gauss points of a layer of the reference cube, between two coordinates of one axis."""
    points, weights = get_quadrature(ElementHexS2, order)
    within = points.T.copy()
    within[:, axis] = low + (high - low) * within[:, axis]
    return _table(within, (high - low) * weights)


def _table(points: np.ndarray, weights: np.ndarray) -> ShapeTable:
    values, gradients = shape_functions(points)
    for array in (points, values, gradients, weights):
        array.setflags(write=False)
    return ShapeTable(points, values, gradients, weights)
