"""Modes of a contact that is lost over an arc, at fixed materials, as the mesh has them.

What a solution in the bases leaves out of balance is answered in every harmonic, once with the parts bonded and once
with them hardly touching, and the answers join the bases for the next round.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp

from statorhom.diagnose.bases.ring_basis import RingBasis, RingModes, RingProblem
from statorhom.diagnose.contacts.joint_arc import Family, arc_change, arc_groups, where_they_touch
from statorhom.diagnose.contacts.weighed_vectors import Factors, WeighedProblem, WeighedVectors, together
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.model.affine import Materials
from statorhom.model.broken.pieces import Pieces
from statorhom.model.harmonic import Harmonic
from statorhom.physics.action import Joint

# exact: to a few ten-thousandths of a frequency; rough: enough to tell arcs apart, in half the time
EXACT, ROUGH = 5, 2
REACH = 1.2  # how much higher than the band's end the solutions' λ are followed
RIGID = 1e-4  # part of the band's highest λ below which a body is rigid
WEAK = 3e10  # N/m³: contact of parts that hardly touch
# vectors of the last two solutions, and of answers to them, that one problem keeps
SOLUTIONS, ANSWERS = 50, 25
PARTS = 30  # that are kept of all solutions in the end
CHUNK = 24  # modes whose motion in all half pitches is held at once

# contact of unit stiffness of the half pitch, normal and tangential (m²)
Unit = tuple[sp.csr_array, sp.csr_array]
Parts = list[np.ndarray]  # per problem (m, t): of modes of unit strain energy


class ArcTraining(NamedTuple):
    """An arc around θ = 0 that bases know.

    Parameters
    ----------
    materials : of the regions.
    joint : the contact and the arc.
    rounds : of its solution, `EXACT` or `ROUGH`.
    """

    materials: Materials
    joint: Joint
    rounds: int = EXACT


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
    def touched(self) -> tuple[tuple[Harmonic, ...], sp.csr_array]:
        """All harmonics at the displacements that the contact acts on, and the intact contact between these."""
        dofs, _ = where_they_touch(self.pieces)
        spaces = tuple(p.space.at(dofs) for p in self.ring.problems)
        return spaces, sp.csr_array(self._bond[dofs][:, dofs])

    @property
    def _bond(self) -> sp.csr_array:
        return sp.csr_array(self.usual.normal * self.unit[0] + self.usual.tangential * self.unit[1])

    @cached_property
    def problems(self) -> tuple[WeighedProblem, ...]:
        """All harmonics."""
        model = self.ring.model
        K, M = model.stiffness_matrix(self.materials), model.mass_matrix(self.materials)
        loose = sp.csr_array(WEAK * (self.unit[0] + self.unit[1]))
        matrices = sp.csr_array(K + loose), M, sp.csr_array(self._bond - loose), self.top
        return tuple(WeighedProblem.of(p.space, *matrices) for p in self.ring.problems)

    def parts(self, trainings: Sequence[ArcTraining]) -> Parts:
        """Of the modes of all arcs, per problem; their materials are these."""
        _ = self.problems, self.plain, self.touched  # made once, before processes part
        # gigabytes, that are gone before another winding's are made
        factors = [p.factored() for p in self.problems]
        own = side_by_side(partial(self._solved, factors), trainings)
        return [np.hstack(parts) for parts in zip(*own, strict=True)]

    @cached_property
    def plain(self) -> tuple[WeighedVectors, ...]:
        """The bases that all arcs begin with."""
        own = zip(self.problems, self.ring.problems, strict=True)
        return tuple(problem.of_unit_energies(p.basis) for problem, p in own)

    def _solved(self, factors: Sequence[Factors], training: ArcTraining) -> Parts:
        """Modes of one arc."""
        joint = training.joint
        bases, before = self.plain, [p.weighed(np.zeros((p.space.size, 0))) for p in self.problems]
        for _ in range(training.rounds):
            parts, forces = self._modes(joint, bases)
            # the last two solutions and their answers: the step that led here is not undone
            bases = tuple(
                p.joined(p.joined(b, together([y, z]), SOLUTIONS), p.answers(own, f), ANSWERS)
                for p, own, b, y, z, f in zip(
                    self.problems, factors, self.plain, parts, before, forces, strict=True
                )
            )
            before = parts
        return [y.own for y in self._modes(joint, bases)[0]]

    def _modes(
        self, joint: Joint, bases: Sequence[WeighedVectors]
    ) -> tuple[list[WeighedVectors], list[np.ndarray]]:
        """Parts and residual forces of one arc's modes in some bases, per problem."""
        pairs = [p.ritz(b) for p, b in zip(self.problems, bases, strict=True)]
        values, vectors = [v for v, _ in pairs], [x for _, x in pairs]
        problems = tuple(
            RingProblem(p.space, x.own, {}, {}, np.zeros((0, 0)))
            for p, x in zip(self.problems, vectors, strict=True)
        )
        even = RingModes((), tuple(values), tuple(np.eye(len(v)) for v in values), problems)
        parts: list[list[WeighedVectors]] = [[] for _ in problems]
        forces: list[list[np.ndarray]] = [[] for _ in problems]
        for group in arc_groups(replace(self.ring, problems=problems), self.pieces):
            for sine, family in enumerate(group.weakened(even, joint).families):
                chosen, own = self._in_band(family, vectors)
                lost = self._lost(joint, {n: y.own for n, y in own.items()}, bool(sine))
                for n, y in own.items():
                    parts[n].append(y)
                    forces[n].append(self.problems[n].stiffness(y) - y.mass * chosen + lost[n])
        return [together(p) for p in parts], [np.hstack(f) for f in forces]

    def _in_band(
        self, family: Family, vectors: Sequence[WeighedVectors]
    ) -> tuple[np.ndarray, dict[int, WeighedVectors]]:
        """λ of a family's elastic modes, and what of them is in every problem."""
        used = (family.values <= REACH * self.top) & (family.values > RIGID * self.top)
        values = family.values[used]
        own = {
            n: vectors[n] @ (family.coordinates[start : start + len(vectors[n]), used] / np.sqrt(values))
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
        spaces = {n: self.touched[0][n] for n in motions}
        # the motion is Re(û z) in a pitch and Re(conj(û) z) in its mirror image, of the sines Im
        phases = np.stack(
            [np.exp(2j * np.pi / slots * s.order * np.arange(slots)) for s in spaces.values()], axis=1
        )
        turned = -1j * phases if sine else phases
        local = np.stack([spaces[n].expand(y) for n, y in motions.items()])
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
            found[n] = np.asarray(space.real.T @ force.real + space.imaginary.T @ force.imag)
        return found

    def _contact(self, motion: np.ndarray) -> np.ndarray:
        _, intact = self.touched
        return np.asarray(intact @ motion.real + 1j * (intact @ motion.imag))
