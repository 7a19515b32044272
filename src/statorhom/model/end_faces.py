"""Held end faces of the core: they keep the N-fold symmetry and change every harmonic's own problem."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from skfem import ElementQuad2
from skfem.quadrature import get_quadrature

from statorhom.errors import SupportError
from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.element import shape_functions
from statorhom.model.harmonic import Harmonic, harmonic_spaces
from statorhom.study.regions import core_region

TOLERANCE = 1e-9  # m
_BOTTOM = np.array([0, 1, 2, 3, 8, 9, 10, 11])
_TOP = np.array([4, 5, 6, 7, 16, 17, 18, 19])


@dataclass(frozen=True)
class EndFaces:
    """Held end faces of the core.

    Parameters
    ----------
    lower, upper : which ones.
    stiffness : (3,) normal to the face and along its two directions per square metre (N/m³); None: rigid.
    """

    lower: bool
    upper: bool
    stiffness: np.ndarray | None


def held_spaces(mesh: HalfPitchMesh, order: int, ends: EndFaces | None) -> tuple[Harmonic, ...]:
    """The independent problems of a harmonic of a stator that may be held at its ends.

    Where only one end is held, motions even and odd about the core's middle are no longer independent.
    """
    spaces = harmonic_spaces(mesh, order)
    if ends is None:
        return spaces
    fixed = _face_dofs(mesh, ends) if ends.stiffness is None else np.empty(0, dtype=int)
    if ends.lower and ends.upper:
        return tuple(_without(space, _touched(space, fixed)) for space in spaces)
    found = []
    for parity in dict.fromkeys(space.parity for space in spaces):
        parts = [space for space in spaces if space.parity == parity]
        found.append(
            _joined(parts, fixed) if len(parts) == 2 else _without(parts[0], _touched(parts[0], fixed))
        )
    return tuple(found)


def face_stiffness(mesh: HalfPitchMesh, ends: EndFaces) -> sp.csr_array:
    """Stiffness of elastic ends, for the half pitch (3 n, 3 n) in N/m; empty where they are rigid."""
    n = 3 * len(mesh.nodes)
    total = sp.csr_array((n, n))
    if ends.stiffness is None:
        return total
    for held, elements, corners in _sides(mesh, ends):
        if held:
            total = total + _springs(mesh, elements, corners, ends.stiffness)
    return sp.csr_array(total)


def _sides(mesh: HalfPitchMesh, ends: EndFaces) -> list[tuple[bool, np.ndarray, np.ndarray]]:
    elements = mesh.elements_of(core_region(mesh.regions))
    z = mesh.nodes[elements, 2]
    lower = np.all(np.abs(z[:, _BOTTOM]) < TOLERANCE, axis=1)
    upper = np.all(np.abs(z[:, _TOP] - mesh.length) < TOLERANCE, axis=1)
    return [(ends.lower, elements[lower], _BOTTOM), (ends.upper, elements[upper], _TOP)]


def _face_dofs(mesh: HalfPitchMesh, ends: EndFaces) -> np.ndarray:
    nodes = [elements[:, corners].ravel() for held, elements, corners in _sides(mesh, ends) if held]
    return np.asarray((3 * np.unique(np.concatenate(nodes))[:, None] + np.arange(3)).ravel())


def _springs(
    mesh: HalfPitchMesh, elements: np.ndarray, corners: np.ndarray, stiffness: np.ndarray
) -> sp.csr_array:
    points, weights = get_quadrature(ElementQuad2, 6)
    level = 0.0 if corners is _BOTTOM else 1.0
    values, gradients = shape_functions(np.column_stack([*points, np.full(len(weights), level)]))
    values, gradients = values[:, corners], gradients[:, corners, :2]
    nodes = elements[:, corners]
    plane = mesh.nodes[nodes][..., :2]
    area = weights * np.linalg.det(np.einsum("eai,qaj->eqij", plane, gradients))
    angle = np.arctan2(plane[..., 1], plane[..., 0])
    turn = angle[:, :, None] - angle[:, None, :]
    product = np.einsum("eq,qa,qb->eab", area, values, values)
    blocks = np.zeros((len(nodes), 8, 3, 8, 3))
    # springs that are equal in all directions of the plane need only the angle between two nodes' axes
    blocks[:, :, 0, :, 0] = blocks[:, :, 1, :, 1] = stiffness[1] * product * np.cos(turn)
    blocks[:, :, 0, :, 1] = stiffness[1] * product * np.sin(turn)
    blocks[:, :, 1, :, 0] = -blocks[:, :, 0, :, 1]
    blocks[:, :, 2, :, 2] = stiffness[0] * product
    dofs = (3 * nodes[:, :, None] + np.arange(3)).reshape(len(nodes), 24)
    rows = np.repeat(dofs, 24, axis=1)
    columns = np.tile(dofs, (1, 24))
    n = 3 * len(mesh.nodes)
    return sp.csr_array((blocks.ravel(), (rows.ravel(), columns.ravel())), shape=(n, n))


def _touched(space: Harmonic, dofs: np.ndarray) -> np.ndarray:
    """Whether each coordinate moves any of the displacements `dofs`."""
    moved = abs(space.real[dofs]).sum(axis=0) + abs(space.imaginary[dofs]).sum(axis=0)
    return np.asarray(np.ravel(moved) > 0)


def _without(space: Harmonic, gone: np.ndarray) -> Harmonic:
    """Fix coordinates; each belongs to a single displacement and its images."""
    keep = np.flatnonzero(~gone)
    if len(keep) == 0:
        raise SupportError("the support holds every node of the model; hold less of it")
    return replace(
        space, real=sp.csr_array(space.real[:, keep]), imaginary=sp.csr_array(space.imaginary[:, keep])
    )


def _joined(parts: list[Harmonic], fixed: np.ndarray) -> Harmonic:
    """Even and odd motions in one space, without those that move the displacements `fixed`.

    An even and an odd coordinate of the same node are the same at one end and opposite at the other: of each
    such pair that moves a held end, one combination stays.
    """
    first, second = parts
    a, b = _touched(first, fixed), _touched(second, fixed)
    matrices = []
    sign = _relative_sign(first, second, a, b, fixed)
    for one, other in ((first.real, second.real), (first.imaginary, second.imaginary)):
        kept = [one[:, np.flatnonzero(~a)], other[:, np.flatnonzero(~b)]]
        pairs = one[:, np.flatnonzero(a)] - other[:, np.flatnonzero(b)] @ sp.diags_array(sign)
        matrices.append(sp.csr_array(sp.hstack([*kept, pairs])))
    return replace(first, axial=None, real=matrices[0], imaginary=matrices[1])


def _relative_sign(
    first: Harmonic, second: Harmonic, a: np.ndarray, b: np.ndarray, fixed: np.ndarray
) -> np.ndarray:
    """+1 where a pair of coordinates moves the held end alike, -1 where it moves it oppositely."""
    product = [
        one[fixed][:, np.flatnonzero(a)].multiply(other[fixed][:, np.flatnonzero(b)]).sum(axis=0)
        for one, other in ((first.real, second.real), (first.imaginary, second.imaginary))
    ]
    return np.sign(np.ravel(product[0]) + np.ravel(product[1]))
