"""N-fold symmetry: one real symmetric problem per circumferential harmonic.

A rotation-invariant stator's motion splits into harmonics h = 0 … N/2: pitch k moves as û e^{i k h α}, α = 2π/N.
The pitch is also its own mirror image, so û can be chosen with û(-θ) = S conj û(θ), S = diag(1, -1, 1). What is
left to solve is half a pitch with û = W y, y real: on the tooth's plane u_r and u_z are real and u_θ imaginary;
on the slot's plane the same holds after turning the phase by h α / 2. K, M of the half pitch act on the real and
the imaginary part alike, so that the harmonic's matrices are real, symmetric and of a pitch's size.

For 0 < h < N/2 every eigenvalue is a doublet (real and imaginary part of û e^{i k h α} are its two shapes); for
h = 0 and h = N/2 the real and the imaginary part decouple into the "even" and the "odd" problem of singlets.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy.sparse as sp
from scipy.spatial import cKDTree

from statorhom.mesh.hex_mesh import HalfPitchMesh

Parity = Literal["pair", "even", "odd"]
Axial = Literal["even", "odd"]
TOLERANCE = 1e-9  # m: how far a node's mirror image may lie from another node


@dataclass(frozen=True)
class Harmonic:
    """The space of one circumferential harmonic.

    Parameters
    ----------
    order : h.
    slots : N.
    parity : "pair", or "even"/"odd" for the two decoupled problems of h = 0 and h = N/2.
    axial : radial motion even or odd about the core's middle, None where the two ends differ.
    real, imaginary : (3 n, m) sparse: û = (real + i imaginary) y.
    """

    order: int
    slots: int
    parity: Parity
    axial: Axial | None
    real: sp.csr_array
    imaginary: sp.csr_array

    @property
    def multiplicity(self) -> int:
        """How often each eigenvalue of the whole stator occurs in this problem."""
        return 2 if self.parity == "pair" else 1

    @property
    def copies(self) -> int:
        """Norm of a shape: the whole stator's modal mass over yᵀ M y."""
        return self.slots if self.parity == "pair" else 2 * self.slots

    @property
    def size(self) -> int:
        """Number of coordinates m."""
        return int(self.real.shape[1])

    def project(self, matrix: sp.csr_array) -> sp.csr_array:
        """Restrict a matrix of the half pitch (K or M) to this harmonic."""
        real, imaginary = self.real, self.imaginary
        return sp.csr_array(real.T @ (matrix @ real) + imaginary.T @ (matrix @ imaginary))

    def expand(self, y: np.ndarray) -> np.ndarray:
        """Complex displacements of the half pitch (3 n, …) of coordinates `y` (m, …)."""
        return np.asarray(self.real @ y + 1j * (self.imaginary @ y))


def harmonic_spaces(mesh: HalfPitchMesh, order: int) -> tuple[Harmonic, ...]:
    """The independent problems of a harmonic.

    One for 0 < h < N/2 and two for h = 0 and h = N/2; twice as many, of half the size, where the
    stator is its own mirror image about the middle of the core.
    """
    spaces = []
    for axial, nodes, copy in _axial_parts(mesh):
        real, imaginary = _constrained(mesh, nodes, order)
        real, imaginary = sp.csr_array(copy @ real), sp.csr_array(copy @ imaginary)
        if 0 < 2 * order < mesh.slots:
            spaces.append(_used("pair", axial, mesh, order, real, imaginary))
            continue
        zero = sp.csr_array(real.shape)
        spaces.append(_used("even", axial, mesh, order, real, zero))
        spaces.append(_used("odd", axial, mesh, order, zero, imaginary))
    return tuple(spaces)


def all_orders(slots: int) -> range:
    """All harmonics of N slots."""
    return range(slots // 2 + 1)


def _axial_parts(mesh: HalfPitchMesh) -> list[tuple[Axial | None, np.ndarray, sp.csr_array]]:
    """Nodes that carry coordinates, and the matrix that copies them to all nodes, per axial parity."""
    image = _mirror_images(mesh)
    n = len(mesh.nodes)
    if image is None:
        return [(None, np.arange(n), sp.eye_array(3 * n, format="csr"))]
    lower = np.flatnonzero(mesh.nodes[:, 2] <= mesh.length / 2 + TOLERANCE)
    place = np.full(n, -1)
    place[lower] = np.arange(len(lower))
    upper = place < 0
    source = np.where(upper, place[image], place)
    middle = image == np.arange(n)
    signs: tuple[tuple[Axial, tuple[float, float, float]], ...] = (
        ("even", (1.0, 1.0, -1.0)),
        ("odd", (-1.0, -1.0, 1.0)),
    )
    return [
        (axial, lower, _copies(source, upper, middle, np.array(sign), len(lower))) for axial, sign in signs
    ]


def _copies(
    source: np.ndarray, upper: np.ndarray, middle: np.ndarray, signs: np.ndarray, count: int
) -> sp.csr_array:
    """Displacement of every node from those of the lower half; `signs` is what mirroring does to it."""
    values = np.where(upper[:, None], signs, 1.0)
    # what would have to be its own opposite on the middle plane vanishes
    values = np.where(middle[:, None] & (signs < 0), 0.0, values)
    n = len(source)
    columns = 3 * source[:, None] + np.arange(3)
    matrix = sp.csr_array((values.ravel(), (np.arange(3 * n), columns.ravel())), shape=(3 * n, 3 * count))
    matrix.eliminate_zeros()
    return matrix


def _mirror_images(mesh: HalfPitchMesh) -> np.ndarray | None:
    """Node at the mirror image of each node about the core's middle, None where the ends differ."""
    # nodes of two parts may lie on each other
    part = np.full(len(mesh.nodes), len(mesh.regions))
    np.minimum.at(part, mesh.elements, mesh.region[:, None])
    tagged = np.column_stack([mesh.nodes, part])
    distance, image = cKDTree(tagged).query(tagged * [1.0, 1.0, -1.0, 1.0] + [0.0, 0.0, mesh.length, 0.0])
    if distance.max() > TOLERANCE or not _same_regions(mesh, image):
        return None
    return np.asarray(image)


def _same_regions(mesh: HalfPitchMesh, image: np.ndarray) -> bool:
    def signature(elements: np.ndarray) -> np.ndarray:
        rows = np.column_stack([np.sort(elements, axis=1), mesh.region])
        return rows[np.lexsort(rows.T)]

    return bool(np.array_equal(signature(mesh.elements), signature(image[mesh.elements])))


def _constrained(mesh: HalfPitchMesh, nodes: np.ndarray, order: int) -> tuple[sp.csr_array, sp.csr_array]:
    """Real and imaginary part of û at `nodes` from the real coordinates that the mirror symmetry leaves."""
    n = len(nodes)
    on_tooth, on_slot = np.isin(nodes, mesh.tooth_plane), np.isin(nodes, mesh.slot_plane)
    inner = np.flatnonzero(~np.repeat(on_tooth | on_slot, 3))
    m = len(inner)
    tooth, tooth_phase = _plane_dofs(np.flatnonzero(on_tooth), 0.0)
    slot, slot_phase = _plane_dofs(np.flatnonzero(on_slot), np.pi * order / mesh.slots)
    rows = np.concatenate([inner, tooth, slot])
    shape = (3 * n, 2 * m + len(tooth) + len(slot))
    # inner nodes have an imaginary part of their own; on the planes it follows from the phase
    planes = 2 * m + np.arange(len(tooth) + len(slot))
    phase = np.concatenate([tooth_phase, slot_phase])
    real = _sparse(np.r_[np.ones(m), phase.real], rows, np.r_[np.arange(m), planes], shape)
    imaginary = _sparse(np.r_[np.ones(m), phase.imag], rows, np.r_[m + np.arange(m), planes], shape)
    return real, imaginary


def _sparse(
    values: np.ndarray, rows: np.ndarray, columns: np.ndarray, shape: tuple[int, int]
) -> sp.csr_array:
    matrix = sp.csr_array((values, (rows, columns)), shape=shape)
    matrix.eliminate_zeros()
    return matrix


def _plane_dofs(nodes: np.ndarray, phase: float) -> tuple[np.ndarray, np.ndarray]:
    turn = np.exp(1j * phase)
    # exact zeros keep the even and the odd problem apart
    turn = complex(round(turn.real, 15), round(turn.imag, 15))
    dofs = (3 * nodes[:, None] + np.arange(3)).ravel()
    return dofs, np.tile([turn, 1j * turn, turn], len(nodes))


def _used(
    parity: Parity,
    axial: Axial | None,
    mesh: HalfPitchMesh,
    order: int,
    real: sp.csr_array,
    imaginary: sp.csr_array,
) -> Harmonic:
    """Leave out coordinates that move nothing."""
    used = np.flatnonzero((abs(real) + abs(imaginary)).sum(axis=0))
    real, imaginary = sp.csr_array(real[:, used]), sp.csr_array(imaginary[:, used])
    return Harmonic(order, mesh.slots, parity, axial, real, imaginary)


def problems_of(mesh: HalfPitchMesh, names: set[tuple[int, int | None]]) -> tuple[Harmonic, ...]:
    """The radial problems that hold the modes of the given names (r, n); n None: of either axial parity."""
    found = []
    for order in sorted({r for r, _ in names}):
        wanted = {None if n is None else n % 2 for r, n in names if r == order}
        for space in harmonic_spaces(mesh, order):
            parity = {"even": 0, "odd": 1, None: None}[space.axial]
            if space.parity != "odd" and (parity is None or None in wanted or parity in wanted):
                found.append(space)
    return tuple(found)
