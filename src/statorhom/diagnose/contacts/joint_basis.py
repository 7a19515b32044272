"""A step whose parts meet over a contact of finite stiffness: its modes at any materials and any contact.

The mesh is split along the contact (`statorhom.model.broken.interface`). Small bases per harmonic hold the modes at
contacts from a bond down to parts that hardly touch; materials and contact stiffness enter them linearly, so that an
evaluation costs milliseconds.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial

import numpy as np

from statorhom.diagnose.bases.ring_basis import RingBasis, RingModes, mark_of, ring_basis
from statorhom.diagnose.contacts.arc_slopes import KnownSlope
from statorhom.diagnose.contacts.joint_arc import ArcGroup, JoinedMode, Weakened, arc_groups
from statorhom.diagnose.contacts.joint_born import born_modes, surface
from statorhom.diagnose.contacts.joint_condensed import CondensedGroup, Span, condensed
from statorhom.diagnose.contacts.joint_fields import with_local_fields
from statorhom.diagnose.contacts.joint_solution import ArcTraining
from statorhom.diagnose.contacts.joint_training import with_arcs
from statorhom.diagnose.measured.feature import SINGLE
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import Materials, assemble
from statorhom.model.blas_threads import one_blas_thread
from statorhom.model.broken.interface import contact, split
from statorhom.model.broken.pieces import Pieces
from statorhom.model.convergence import ModeKey, mode_keys
from statorhom.model.free_modes import total_mass
from statorhom.model.kept import Kept
from statorhom.model.stator_mode import StatorMode
from statorhom.physics.action import Joint

LADDER = (1e14, 1e12, 1e11, 1e10)  # N/m³: contacts whose modes span the bases
SOLUTIONS = 64  # that are kept
TOGETHER = 8  # samples whose sketches are added before they are handed over


@dataclass(frozen=True, eq=False)
class JointBasis:
    """The bases of a step with a joint.

    Parameters
    ----------
    ring : on the split mesh, without the contact.
    pieces : of the half pitch, normal and tangential contact per unit stiffness (m²).
    springs : (2, k, k) per problem, the same in the bases.
    few : the groups that an arc couples, in few vectors; empty where all of the bases count.
    """

    ring: RingBasis
    pieces: tuple[Pieces, Pieces]
    springs: tuple[np.ndarray, ...]
    few: tuple[CondensedGroup, ...] = ()
    _latest: Kept = field(default_factory=partial(Kept, SOLUTIONS), repr=False)

    @cached_property
    def groups(self) -> tuple[ArcGroup, ...]:
        """What an arc couples."""
        return tuple(arc_groups(self.ring, self.pieces))

    def solve(self, materials: Materials, joint: Joint) -> dict[ModeKey, JoinedMode]:
        """Named modes of the band.

        Raises
        ------
        SolverError
            If a mass or stiffness is not definite.
        """
        centre = 0.0 if joint.arc is None else joint.arc[0]
        # the place of an arc turns the splits alone: all places are solved as one
        still = replace(joint, arc=None if joint.arc is None else (0.0, joint.arc[1]), loss_factor=0.0)
        mark = mark_of(materials)
        solved = self._latest.once((mark, still), lambda: self._solved(materials, still))
        return {
            key: replace(one, split=complex(one.split * np.exp(2j * key[0] * centre)))
            for key, one in solved.items()
        }

    def _solved(self, materials: Materials, joint: Joint) -> dict[ModeKey, JoinedMode]:
        with one_blas_thread():
            return self._modes(materials, joint)

    def _modes(self, materials: Materials, joint: Joint) -> dict[ModeKey, JoinedMode]:
        even = self._even(materials, joint)
        keys = mode_keys(even.modes)
        if joint.arc is None or joint.ratio == 1.0:
            return {
                key: JoinedMode(
                    mode, float(np.log(mode.frequency_hz)), 0j, KnownSlope(even.slope(mode, materials))
                )
                for key, mode in keys.items()
            }
        found: dict[ModeKey, JoinedMode] = {}
        born: list[JoinedMode] = []
        place = len(self.ring.problems)
        for number, group in enumerate(self.groups):
            weakened = self._weakened(number, even, materials, joint)
            own = {key: mode for key, mode in keys.items() if mode.problem in group.numbers}
            named, others = self._named(weakened, own, place, materials)
            found |= named
            born += others
            place += len(weakened.families)
        return found | _with_names(born)

    def _weakened(self, number: int, even: RingModes, materials: Materials, joint: Joint) -> Weakened:
        """Modes of one group."""
        if self.few:
            return self.few[number].weakened(even, joint, materials)
        return self.groups[number].weakened(even, joint)

    def condensed(self, samples: Sequence[tuple[Materials, Joint]], most: int) -> JointBasis:
        """The same in the few vectors that the modes at some materials and arcs span; nearly right between them."""
        top = (2 * np.pi * self.ring.highest_hz) ** 2
        span = Span.of(self.ring.problems, [materials for materials, _ in samples], top, most)
        # the same ones are added first, whatever the number of processes
        some = [samples[first : first + TOGETHER] for first in range(0, len(samples), TOGETHER)]
        summed = side_by_side(partial(self._sketched, span), some)
        own = zip(self.groups, zip(*summed, strict=True), strict=True)
        few = [condensed(g, self.ring.problems, span, _added(sketches)) for g, sketches in own]
        return JointBasis(self.ring, self.pieces, self.springs, tuple(few))

    def _sketched(self, span: Span, samples: Sequence[tuple[Materials, Joint]]) -> list[list[np.ndarray]]:
        """Sketches of the modes of all groups, family by family."""
        found = []
        with one_blas_thread():
            for materials, joint in samples:
                even = self._even(materials, joint)
                found.append([span.sketches(g.weakened(even, joint)) for g in self.groups])
        return [_added(of_group) for of_group in zip(*found, strict=True)]

    def _named(
        self, weakened: Weakened, keys: Mapping[ModeKey, StatorMode], place: int, materials: Materials
    ) -> tuple[dict[ModeKey, JoinedMode], list[JoinedMode]]:
        """Modes of one axial parity that look like the even contact's, and all others."""
        surfaces = [surface(family, self.ring.highest_hz) for family in weakened.families]
        found: dict[ModeKey, JoinedMode] = {}
        known: list[set[int]] = [set() for _ in surfaces]
        for key, mode in keys.items():
            members = [i for i in weakened.members(mode) if i is not None]
            pairs = list(zip(surfaces, members, strict=False))
            if len(members) < mode.multiplicity or not all(s.shows(i, mode) for s, i in pairs):
                continue
            found[key] = JoinedMode(mode, *weakened.response(members, materials))
            for numbers, i in zip(known, members, strict=False):
                numbers.add(i)
        mass = total_mass(self.ring.model, materials)
        born = [
            one
            for n, (seen, numbers) in enumerate(zip(surfaces, known, strict=True))
            for one in born_modes(weakened, n, seen, numbers, place + n, mass, materials)
        ]
        return found, born

    def _even(self, materials: Materials, joint: Joint) -> RingModes:
        """Modes with the contact the same all around."""
        matrices = []
        for problem, springs in zip(self.ring.problems, self.springs, strict=True):
            K, M = problem.matrices(materials)
            matrices.append((K + joint.normal * springs[0] + joint.tangential * springs[1], M))
        return self.ring.solve_matrices(matrices, materials)


def _added(sketches: Sequence[Sequence[np.ndarray]]) -> list[np.ndarray]:
    """Family by family."""
    return [np.asarray(sum(own)) for own in zip(*sketches, strict=True)]


def _with_names(born: Sequence[JoinedMode]) -> dict[ModeKey, JoinedMode]:
    """Ranks of modes that the even contact has not."""
    ordered = sorted(born, key=lambda one: one.log_f)
    keys = mode_keys(one.mode for one in ordered)
    pairs = zip(keys, ordered, strict=True)
    return {(order, axial, SINGLE + rank): one for (order, axial, rank), one in pairs}


def joint_basis(
    mesh: HalfPitchMesh,
    regions: tuple[str, ...],
    materials: Materials,
    highest_hz: float,
    orders: Sequence[int],
    *,
    may_differ: bool,
    arcs: Sequence[ArcTraining] = (),
) -> JointBasis:
    """Bases of a joint.

    Parameters
    ----------
    mesh : of the half pitch, bonded.
    regions : that get nodes of their own.
    materials : whose modes span the bases.
    highest_hz : upper end of the band.
    orders : harmonics that are named.
    may_differ : whether the contact may be weaker over an arc.
    arcs : near which it is predicted as the mesh has it; others, and all without, roughly.
    """
    apart = split(mesh, regions)
    pieces = (contact(apart, regions, 1.0, 0.0).pieces, contact(apart, regions, 0.0, 1.0).pieces)
    unit = [p.matrix(np.ones(len(p))) for p in pieces]
    joints = [k * (unit[0] + unit[1]) for k in LADDER]
    ring = ring_basis(assemble(apart), [materials], highest_hz, orders, joints)
    if arcs:
        ring = with_arcs(ring, pieces, arcs)
    elif may_differ:
        ring = with_local_fields(ring, materials, unit[0] + unit[1])
    springs = []
    for problem in ring.problems:
        images = problem.space.expand(problem.basis)
        springs.append(
            np.stack([problem.space.copies * (np.conj(images.T) @ (u @ images)).real for u in unit])
        )
    return JointBasis(ring, pieces, tuple(springs))
