"""What breaks a stator's symmetry, assembled on the whole stator's mesh without any use of its symmetry."""

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from small_stators import assemble_whole

from statorhom.materials.hooke import Hooke
from statorhom.mesh.hex_mesh import HalfPitchMesh, HexMesh
from statorhom.model.affine import Material
from statorhom.model.assembly import block_pattern, chunks, mass_blocks, node_blocks, stiffness_blocks
from statorhom.model.broken.interface import contact
from statorhom.model.element import gauss_table


@dataclass(frozen=True)
class WholeStator:
    half: HalfPitchMesh
    mesh: HexMesh
    K: sp.csr_array
    M: sp.csr_array


def whole_stator(half, materials):
    mesh, _, _ = half.full()
    return WholeStator(half, mesh, *assemble_whole(mesh, materials))


def scaled_stiffness(whole, regions, hooke, weights):
    """Stiffness of elements of some regions, each with its own weight (e, 2 N); `hooke`: region → nine entries."""

    def blocks(region, geometry):
        return sum(c * b for c, b in zip(hooke[region], stiffness_blocks(geometry), strict=True))

    return _scaled(whole.mesh, regions, weights, blocks)


def graded_stiffness(whole, region, hooke, along):
    """Stiffness of a region's elements times a weight that depends on the height of every Gauss point (m)."""
    matrices = np.zeros((len(whole.mesh.elements), 60, 60))
    for part, geometry in chunks(whole.mesh, whole.mesh.regions.index(region)):
        z = whole.mesh.nodes[whole.mesh.elements[part], 2] @ gauss_table().values.T
        graded = replace(geometry, volume=geometry.volume * along(z))
        matrices[part] = sum(c * b for c, b in zip(hooke, stiffness_blocks(graded), strict=True))
    return _assembled(whole.mesh, matrices)


def scaled_mass(whole, regions, materials, weights):
    def blocks(region, geometry):
        return materials[region].density * mass_blocks(geometry, gauss_table().values)

    return _scaled(whole.mesh, regions, weights, blocks)


def _scaled(mesh, regions, weights, blocks):
    numbers = [mesh.regions.index(region) for region in regions]
    factor = np.zeros(len(mesh.elements))
    # the whole mesh lists the elements copy by copy
    factor[np.isin(mesh.region, numbers)] = weights.T.ravel()
    matrices = np.zeros((len(mesh.elements), 60, 60))
    for i in numbers:
        for part, geometry in chunks(mesh, i):
            matrices[part] = factor[part][:, None, None] * blocks(mesh.regions[i], geometry)
    return _assembled(mesh, matrices)


def _assembled(mesh, matrices):
    pattern = block_pattern(mesh.elements, len(mesh.nodes))
    return pattern.matrix(pattern.gather(node_blocks(matrices)))


def partial_contact(whole, regions, normal, tangential, start, end, ratio):
    """Contact of a split mesh whose stiffness is scaled on the faces with their middle between two angles."""
    springs = contact(whole.mesh, regions, normal, tangential)
    nodes = whole.mesh.nodes[springs.pieces.dofs[:, :24:3] // 3].mean(axis=1)
    inside = np.mod(np.arctan2(nodes[:, 1], nodes[:, 0]) - start, 2 * np.pi) < end - start
    return springs.pieces.matrix(np.where(inside, ratio, 1.0))


def changed(material, **moduli):
    """A material of the same density with Hooke entries replaced: name `c44` and so on."""
    matrix = material.hooke.matrix.copy()
    for name, value in moduli.items():
        i, j = int(name[1]) - 1, int(name[2]) - 1
        matrix[i, j] = matrix[j, i] = value
    return Material(Hooke(matrix), material.density)
