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

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
import scipy.sparse as sp

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.pitch_parts import Axial, PitchPart, pitch_parts

Parity = Literal["pair", "even", "odd"]


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
    def kind(self) -> tuple[int, Parity, Axial | None]:
        """What tells the problem from the others of its mesh."""
        return self.order, self.parity, self.axial

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

    def at(self, dofs: np.ndarray) -> Harmonic:
        """The same of some displacements alone, by their numbers (d,): all that is said of 3 n is of d then."""
        return replace(self, real=self.real[dofs], imaginary=self.imaginary[dofs])

    def expand(self, y: np.ndarray) -> np.ndarray:
        """Complex displacements of the half pitch (3 n, …) of coordinates `y` (m, …)."""
        return np.asarray(self.real @ y + 1j * (self.imaginary @ y))


def harmonic_spaces(mesh: HalfPitchMesh, order: int) -> tuple[Harmonic, ...]:
    """The independent problems of a harmonic.

    One for 0 < h < N/2 and two for h = 0 and h = N/2; twice as many, of half the size, where the
    stator is its own mirror image about the middle of the core.
    """
    return spaces_of(pitch_parts(mesh), order)


def spaces_of(parts: Iterable[PitchPart], order: int) -> tuple[Harmonic, ...]:
    """The same, of the parts of a mesh, for those who ask for many harmonics."""
    return tuple(_space(part, order, parity) for part in parts for parity in parities(order, part.slots))


def parities(order: int, slots: int) -> tuple[Parity, ...]:
    """The problems that a harmonic of one part falls into."""
    return ("pair",) if 0 < 2 * order < slots else ("even", "odd")


def all_orders(slots: int) -> range:
    """All harmonics of N slots."""
    return range(slots // 2 + 1)


def slot_phase(order: int, slots: int) -> complex:
    """Turn of the phase on the slot's plane."""
    turn = np.exp(1j * np.pi * order / slots)
    # exact zeros keep the even and the odd problem apart
    return complex(round(turn.real, 15), round(turn.imag, 15))


def plane_phases(dofs: np.ndarray, turn: complex) -> np.ndarray:
    """û of displacements on a plane of symmetry per real coordinate."""
    return np.asarray(np.array([turn, 1j * turn, turn])[dofs % 3])


def _space(part: PitchPart, order: int, parity: Parity) -> Harmonic:
    # inner nodes have an imaginary part of their own; on the planes it follows from the phase
    tooth = plane_phases(part.tooth, 1.0)
    slot = plane_phases(part.slot, slot_phase(order, part.slots))
    ones, zeros = np.ones(len(part.inner)), np.zeros(len(part.inner))
    dofs = np.r_[part.inner, part.inner, part.tooth, part.slot]
    real = np.r_[ones, zeros, tooth.real, slot.real]
    imaginary = np.r_[zeros, ones, tooth.imag, slot.imag]
    # the even problem has the real part alone, the odd one the imaginary part
    if parity != "pair":
        used = (real if parity == "even" else imaginary) != 0
        dofs, real, imaginary = dofs[used], real[used], imaginary[used]
        (imaginary if parity == "even" else real)[:] = 0.0
    matrices = (_carried(part, dofs, values) for values in (real, imaginary))
    return Harmonic(order, part.slots, parity, part.axial, *matrices)


def _carried(part: PitchPart, dofs: np.ndarray, values: np.ndarray) -> sp.csr_array:
    """All displacements by coordinates that move the displacements `dofs` by `values`."""
    moving = np.flatnonzero(values)
    value, column = np.zeros(len(part.source)), np.zeros(len(part.source), dtype=np.int32)
    value[dofs[moving]], column[dofs[moving]] = values[moving], moving
    value = part.sign * value[part.source]
    kept = value != 0
    begin = np.concatenate([[0], np.cumsum(kept, dtype=np.int32)], dtype=np.int32)
    shape = (len(value), len(dofs))
    return sp.csr_array((value[kept], column[part.source[kept]], begin), shape=shape)


def problems_of(mesh: HalfPitchMesh, names: set[tuple[int, int | None]]) -> tuple[Harmonic, ...]:
    """The radial problems that hold the modes of the given names (r, n); n None: of either axial parity."""
    found = []
    parts = pitch_parts(mesh)
    for order in sorted({r for r, _ in names}):
        wanted = {None if n is None else n % 2 for r, n in names if r == order}
        for space in spaces_of(parts, order):
            parity = {"even": 0, "odd": 1, None: None}[space.axial]
            if space.parity != "odd" and (parity is None or None in wanted or parity in wanted):
                found.append(space)
    return tuple(found)
