"""Modes of a contact that is lost over an arc, at fixed materials, as the mesh has them.

What a solution in the bases leaves out of balance is answered in every harmonic, once with the parts bonded and once
with them hardly touching, and the answers join the bases for the next round.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from scipy.linalg import eigh
from scipy.sparse.linalg import SuperLU, splu

from statorhom.diagnose.bases.ring_basis import RingBasis, RingModes, RingProblem
from statorhom.diagnose.contacts.joint_arc import Family, arc_change, arc_groups
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.model.affine import Materials
from statorhom.model.broken.pieces import Pieces
from statorhom.model.harmonic import Harmonic
from statorhom.physics.action import Joint

ROUNDS = 5
REACH = 1.2  # how much higher than the band's end the solutions' λ are followed
RIGID = 1e-4  # part of the band's highest λ below which a body is rigid
WEAK = 3e10  # N/m³: contact of parts that hardly touch
LEAST = 1e-8  # part of a solution's strain energy that a vector must carry
SOLUTIONS, ANSWERS = (
    50,
    25,
)  # vectors of the last two solutions, and of answers to them, that one problem keeps
PARTS = 30  # that are kept of all solutions in the end
CHUNK = 24  # modes whose motion in all half pitches is held at once

# contact of unit stiffness of the half pitch, normal and tangential (m²)
Unit = tuple[sp.csr_array, sp.csr_array]
Parts = list[np.ndarray]  # per problem (m, t): of modes of unit strain energy


@dataclass(frozen=True, eq=False)
class _Problem:
    """One harmonic of the mesh.

    Parameters
    ----------
    space : its coordinates.
    K, M : with the contact intact.
    solvers : of K + σM with the contact intact, and hardly there.
    weak : K + σM of the latter.
    """

    space: Harmonic
    K: sp.csr_array
    M: sp.csr_array
    solvers: tuple[SuperLU, SuperLU]
    weak: sp.csr_array

    def ritz(self, basis: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """λ and vectors (m, k) of unit mass in a basis."""
        K, M = basis.T @ (self.K @ basis), basis.T @ (self.M @ basis)
        values, x = eigh((K + K.T) / 2, (M + M.T) / 2)
        return values, basis @ x

    def joined(self, basis: np.ndarray, more: np.ndarray, most: int) -> np.ndarray:
        """A basis (m, k) with the directions of further vectors that carry most energy of what it lacks."""
        if basis.shape[1]:
            for _ in range(2):
                heavy = self.weak @ basis
                more = more - basis @ np.linalg.solve(basis.T @ heavy, heavy.T @ more)
        values, turn = np.linalg.eigh(more.T @ (self.weak @ more))
        chosen = [i for i in np.argsort(-values)[:most] if values[i] > LEAST]
        return np.hstack([basis, more @ (turn[:, chosen] / np.sqrt(values[chosen]))])


@dataclass(frozen=True, eq=False)
class Arcs:
    """A half pitch of which the contact is lost over arcs.

    Parameters
    ----------
    ring : bases of all harmonics that arcs bring in, on a split mesh.
    pieces : of the contact, normal and tangential.
    unit : their sums.
    materials : of the regions.
    usual : the contact outside the arcs.
    """

    ring: RingBasis
    pieces: tuple[Pieces, Pieces]
    unit: Unit
    materials: Materials
    usual: Joint

    @cached_property
    def top(self) -> float:
        """λ at the end of the band."""
        return (2 * np.pi * self.ring.highest_hz) ** 2

    @cached_property
    def touched(self) -> np.ndarray:
        """Displacements that the contact acts on."""
        return np.unique(self.pieces[0].dofs)

    @cached_property
    def intact(self) -> sp.csr_array:
        """Contact of the half pitch between the displacements that it acts on."""
        return sp.csr_array(self._bond[self.touched][:, self.touched])

    @property
    def _bond(self) -> sp.csr_array:
        return sp.csr_array(self.usual.normal * self.unit[0] + self.usual.tangential * self.unit[1])

    @cached_property
    def problems(self) -> tuple[_Problem, ...]:
        """All harmonics."""
        model = self.ring.model
        K, M = model.stiffness_matrix(self.materials), model.mass_matrix(self.materials)
        loose = WEAK * (self.unit[0] + self.unit[1])
        found = []
        for space in (p.space for p in self.ring.problems):
            bonded, weak, mass = (
                sp.csr_array(space.copies * space.project(sp.csr_array(m)))
                for m in (K + self._bond, K + loose, M)
            )
            shifted = [sp.csr_array(k + self.top * mass) for k in (bonded, weak)]
            solvers = (splu(sp.csc_matrix(shifted[0])), splu(sp.csc_matrix(shifted[1])))
            found.append(_Problem(space, bonded, mass, solvers, shifted[1]))
        return tuple(found)

    def parts(self, trainings: Sequence[Joint]) -> Parts:
        """Of all trainings' modes, per problem."""
        _ = self.problems, self.touched, self.intact  # made once, before processes part
        own = side_by_side(self._solved, trainings)
        return [np.hstack(parts) for parts in zip(*own, strict=True)]

    def _solved(self, joint: Joint) -> Parts:
        """Modes of one arc."""
        plain = [b.basis for b in self.ring.problems]
        bases, before = plain, [np.zeros((p.space.size, 0)) for p in self.problems]
        for _ in range(ROUNDS):
            parts, forces = self._modes(joint, bases)
            # the last two solutions and their answers: the step that led here is not undone
            bases = [
                p.joined(
                    p.joined(b, np.hstack([y, z]), SOLUTIONS),
                    np.hstack([s.solve(f) for s in p.solvers]),
                    ANSWERS,
                )
                for p, b, y, z, f in zip(self.problems, plain, parts, before, forces, strict=True)
            ]
            before = parts
        return self._modes(joint, bases)[0]

    def _modes(self, joint: Joint, bases: Parts) -> tuple[Parts, Parts]:
        """Parts and residual forces of one arc's modes in some bases, per problem."""
        pairs = [p.ritz(b) for p, b in zip(self.problems, bases, strict=True)]
        values, vectors = [v for v, _ in pairs], [x for _, x in pairs]
        problems = tuple(
            RingProblem(p.space, x, {}, {}, np.zeros((0, 0)))
            for p, x in zip(self.problems, vectors, strict=True)
        )
        even = RingModes((), tuple(values), tuple(np.eye(len(v)) for v in values), problems)
        parts: list[list[np.ndarray]] = [[] for _ in problems]
        forces: list[list[np.ndarray]] = [[] for _ in problems]
        for group in arc_groups(replace(self.ring, problems=problems), self.pieces):
            for sine, family in enumerate(group.weakened(even, joint).families):
                chosen, own = self._in_band(family, vectors)
                lost = self._lost(joint, own, bool(sine))
                for n, y in own.items():
                    problem = self.problems[n]
                    parts[n].append(y)
                    forces[n].append(problem.K @ y - problem.M @ y * chosen + lost[n])
        return [np.hstack(p) for p in parts], [np.hstack(f) for f in forces]

    def _in_band(self, family: Family, vectors: Parts) -> tuple[np.ndarray, dict[int, np.ndarray]]:
        """λ of a family's elastic modes, and their coordinates (m, t) in every problem."""
        used = (family.values <= REACH * self.top) & (family.values > RIGID * self.top)
        values = family.values[used]
        own = {
            n: vectors[n] @ family.coordinates[start : start + vectors[n].shape[1], used] / np.sqrt(values)
            for n, start in family.starts.items()
        }
        return values, own

    def _lost(self, joint: Joint, motions: Mapping[int, np.ndarray], sine: bool) -> dict[int, np.ndarray]:
        """Forces (m, t) of the change of the contact by the modes' coordinates (m, t), per problem."""
        count = next(iter(motions.values())).shape[1]
        parts = [
            self._lost_of_some(joint, {n: y[:, first : first + CHUNK] for n, y in motions.items()}, sine)
            for first in range(0, max(count, 1), CHUNK)
        ]
        return {n: np.hstack([part[n] for part in parts]) for n in motions}

    def _lost_of_some(
        self, joint: Joint, motions: Mapping[int, np.ndarray], sine: bool
    ) -> dict[int, np.ndarray]:
        slots = self.ring.model.mesh.slots
        spaces = {n: self.problems[n].space for n in motions}
        # the motion is Re(û z) in a pitch and Re(conj(û) z) in its mirror image, of the sines Im
        phases = np.stack(
            [np.exp(2j * np.pi / slots * s.order * np.arange(slots)) for s in spaces.values()], axis=1
        )
        turned = -1j * phases if sine else phases
        local = np.stack([spaces[n].expand(y)[self.touched] for n, y in motions.items()])
        straight, mirrored = (np.tensordot(turned, u, axes=1).real for u in (local, np.conj(local)))
        change = arc_change(joint, slots)
        pulled, pushed = (
            np.tensordot(np.conj(turned).T * w, u, axes=1)
            for w, u in ((change[0::2], straight), (change[1::2], mirrored))
        )
        # of one side's forces conj(û), of the other's û takes the work
        found = {}
        for (n, space), a, b in zip(spaces.items(), pulled, pushed, strict=True):
            force = self._contact(a) + np.conj(self._contact(b))
            real, imaginary = space.real[self.touched], space.imaginary[self.touched]
            found[n] = np.asarray(real.T @ force.real + imaginary.T @ force.imag)
        return found

    def _contact(self, motion: np.ndarray) -> np.ndarray:
        return np.asarray(self.intact @ motion.real + 1j * (self.intact @ motion.imag))
