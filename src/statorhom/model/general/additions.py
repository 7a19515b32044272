"""Springs and lumps on nodes, as sparse matrices that add to K and M."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from numpy.typing import ArrayLike


def nodal_springs(size: int, nodes: ArrayLike, stiffness: ArrayLike) -> sp.csr_array:
    """Springs from nodes to the ground.

    Parameters
    ----------
    size : degrees of freedom of the model.
    nodes : (k,) node numbers; one that occurs twice has both springs.
    stiffness : (3,) or (k, 3) along the components of each node's frame (N/m).
    """
    return _diagonal(size, np.atleast_1d(nodes), np.asarray(stiffness, dtype=float))


def nodal_masses(size: int, nodes: ArrayLike, mass: ArrayLike) -> sp.csr_array:
    """Point masses on nodes.

    Parameters
    ----------
    size : degrees of freedom of the model.
    nodes : (k,) node numbers.
    mass : scalar or (k,) (kg).
    """
    return _diagonal(size, np.atleast_1d(nodes), np.asarray(mass, dtype=float)[..., None])


def _diagonal(size: int, nodes: np.ndarray, values: np.ndarray) -> sp.csr_array:
    dofs = (3 * nodes[:, None] + np.arange(3)).ravel()
    entries = np.broadcast_to(values, (len(nodes), 3)).ravel()
    return sp.csr_array((entries, (dofs, dofs)), shape=(size, size))
