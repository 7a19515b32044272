"""Strain energy of the elements of a body in a basis: stiffness that varies over the plan is their weighted sum."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.affine import AffineModel, Materials, hooke_coefficients
from statorhom.model.assembly import chunks, stiffness_blocks
from statorhom.model.frames import FRAMES

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ElementEnergy:
    """Energies of the part's elements.

    Parameters
    ----------
    centres : (copies, m, 3) of the elements in the whole body.
    energy : (m, k (k + 1) / 2) of one copy: upper triangles, row by row.
    signs : (copies, k (k + 1) / 2) of every copy's energy, by the parities of both vectors.
    size : k.
    """

    centres: FloatArray
    energy: FloatArray
    signs: FloatArray
    size: int

    def weighted(self, weight: Callable[[FloatArray], FloatArray]) -> FloatArray:
        """Sum (k, k) of all elements' energies times a function of their centres (m, 3)."""
        weights = np.stack([weight(centres) for centres in self.centres])
        # all copies at once: energies are read from memory once, and that is what takes the time
        upper = np.einsum("cp,cp->p", weights @ self.energy, self.signs)
        found = np.zeros((self.size, self.size))
        rows, columns = np.triu_indices(self.size)
        found[rows, columns] = found[columns, rows] = upper
        return found


def element_energy(
    model: AffineModel[MirrorMesh],
    materials: Materials,
    shapes: FloatArray,
    parities: npt.NDArray[np.int_],
) -> ElementEnergy:
    """Energies at given materials of a basis (3 n, k) on the part."""
    mesh = model.mesh
    k = shapes.shape[1]
    moved = shapes.reshape(-1, 3, k)
    rows, columns = np.triu_indices(k)
    energy = np.zeros((len(mesh.elements), len(rows)))
    for number, region in enumerate(mesh.regions):
        if region not in model.stiffness:
            continue  # lumps have no elements
        entries = hooke_coefficients(materials[region].hooke)
        for cells, geometry in chunks(mesh, number, FRAMES[mesh.axes], mesh.quadrature):
            blocks = stiffness_blocks(geometry, mesh.cell_axes(cells))
            K = sum(c * block for c, block in zip(entries, blocks, strict=True))
            local = moved[mesh.elements[cells]].reshape(len(cells), 60, k)
            energy[cells] = (np.swapaxes(local, 1, 2) @ (K @ local))[:, rows, columns]
    middle = mesh.nodes[mesh.elements[:, :8]].mean(axis=1)
    centres, signs = [], []
    for flips in itertools.product((False, True), repeat=len(mesh.mirrors)):
        image, sign = middle.copy(), np.ones(k)
        for i, (axis, position) in enumerate(mesh.mirrors):
            if flips[i]:
                image[:, axis] = 2 * position - image[:, axis]
                sign *= np.where(parities >> i & 1, -1.0, 1.0)
        centres.append(image)
        signs.append(sign[rows] * sign[columns])
    return ElementEnergy(np.array(centres), energy, np.array(signs), k)
