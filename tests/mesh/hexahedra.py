"""Shape functions, volumes and faces of 20-node hexahedra, written down without the program's own tables."""

import itertools

import numpy as np

CORNERS = np.array(
    [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)],
    dtype=float,
)
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 5), (2, 6), (3, 7), (4, 5), (5, 6), (6, 7), (7, 4)]
NODES = np.vstack([CORNERS, [(CORNERS[a] + CORNERS[b]) / 2 for a, b in EDGES]])


def monomials(points):
    """The 20 serendipity monomials: superlinear degree at most 2."""
    powers = [
        p
        for p in itertools.product(range(3), repeat=3)
        if sum(q for q in p if q > 1) <= 2 and sum(q == 2 for q in p) <= 1
    ]
    value = np.stack([np.prod(points**p, axis=1) for p in powers], axis=1)
    gradient = np.zeros((*value.shape, 3))
    for k, p in enumerate(powers):
        for axis in range(3):
            lower = [q - (i == axis) for i, q in enumerate(p)]
            if lower[axis] >= 0:
                gradient[:, k, axis] = p[axis] * np.prod(points**lower, axis=1)
    return value, gradient


def gradients(points):
    """(p, 20, 3) derivatives of the nodal functions."""
    inverse = np.linalg.inv(monomials(NODES)[0])
    return np.einsum("pka,ki->pia", monomials(points)[1], inverse)


def jacobians(nodes, elements, points):
    """(e, p, 3, 3) ∂x/∂ξ."""
    return np.einsum("eid,pia->epda", nodes[elements], gradients(points))


def volumes(nodes, elements):
    """(e,) volumes by four Gauss points per direction: exact for these elements."""
    x, w = np.polynomial.legendre.leggauss(4)
    points = np.array(list(itertools.product(x, repeat=3)))
    weights = np.prod(list(itertools.product(w, repeat=3)), axis=1)
    return np.linalg.det(jacobians(nodes, elements, points)) @ weights


def least_scaled_jacobian(nodes, elements):
    """(e,) least det J over the product of its columns' lengths, at the nodes and the centre."""
    jacobian = jacobians(nodes, elements, np.vstack([NODES, np.zeros(3)]))
    lengths = np.linalg.norm(jacobian, axis=2).prod(axis=-1)
    return (np.linalg.det(jacobian) / lengths).min(axis=1)


def faces(elements):
    """(6 e, 8) sorted node numbers of all faces."""
    local = []
    for axis in range(3):
        for side in (-1.0, 1.0):
            local.append(np.flatnonzero(NODES[:, axis] == side))
    return np.sort(elements[:, local], axis=2).reshape(-1, 8)
