"""Mirror symmetry: one problem of the part for each combination of parities.

At a plane of symmetry a mode is its own mirror image or the opposite of it. An image's component along the plane's
normal is turned round: of an even mode this component vanishes on the plane, of an odd one the other two do. The part
with these components held has all modes of that combination.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.space import MIRROR


@dataclass(frozen=True)
class MirrorSpace:
    """The space of one combination of parities.

    Parameters
    ----------
    order : number of the combination; bit i is set where the motion is odd at plane i.
    signs : (planes, 3) what mirroring at each plane does to the components.
    free : (m,) components (3 node + axis) that are not held.
    total : number of all components, 3 n.
    """

    order: int
    signs: np.ndarray
    free: np.ndarray
    total: int

    parity = MIRROR
    axial = None
    multiplicity = 1

    @property
    def copies(self) -> int:
        """Parts of the body: the whole body's modal mass over yᵀ M y."""
        return int(2 ** len(self.signs))

    @property
    def size(self) -> int:
        """Number of coordinates m."""
        return len(self.free)

    def project(self, matrix: sp.csr_array) -> sp.csr_array:
        """Restrict a matrix of the part (K or M) to this combination."""
        return sp.csr_array(matrix[self.free][:, self.free])

    def expand(self, y: np.ndarray) -> np.ndarray:
        """Displacements of the part (3 n, …) of coordinates `y` (m, …)."""
        shape = np.zeros((self.total, *y.shape[1:]))
        shape[self.free] = y
        return shape


def mirror_space(mesh: MirrorMesh, order: int) -> MirrorSpace:
    """The space of a combination of parities; see `MirrorSpace`."""
    signs = mesh.signs(order)
    held = np.zeros((len(mesh.nodes), 3), dtype=bool)
    for i, sign in enumerate(signs):
        held |= mesh.on_plane(i)[:, None] & (sign < 0)
    return MirrorSpace(order, signs, np.flatnonzero(~held.ravel()), held.size)
