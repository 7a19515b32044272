"""Bases for arcs over which a contact is lost: the parts that the modes of a few of them have in every harmonic.

Other arcs' modes are nearly sums of these parts.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp

from statorhom.diagnose.bases.ring_basis import RingBasis, affine_terms, grown, mark_of
from statorhom.diagnose.contacts.joint_fields import unsolved, with_local_fields
from statorhom.diagnose.contacts.joint_solution import EXACT, PARTS, Arcs, ArcTraining, Parts
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.model.affine import Materials
from statorhom.model.broken.pieces import Pieces
from statorhom.model.radial_profile import radial_profile
from statorhom.physics.action import Joint

EACH = 5  # vectors of one problem that every arc may bring


class KnownArc(NamedTuple):
    """An arc of lost contact that bases know as the mesh has it.

    Parameters
    ----------
    width_rad, ratio : of the contact there to that elsewhere.
    materials : of the regions; None where they are the reference's.
    rounds : of its solution, `EXACT` or `ROUGH`.
    """

    width_rad: float
    ratio: float
    materials: Materials | None = None
    rounds: int = EXACT

    def of(self, joint: Joint, reference: Materials) -> ArcTraining:
        """It in a joint."""
        own = replace(joint, arc=(0.0, self.width_rad), ratio=self.ratio)
        return ArcTraining(self.materials or reference, own, self.rounds)


def with_arcs(ring: RingBasis, pieces: tuple[Pieces, Pieces], trainings: Sequence[ArcTraining]) -> RingBasis:
    """The bases with what arcs like some need, and the harmonics that these bring in.

    Parameters
    ----------
    ring : on a split mesh, its modes at several even contacts.
    pieces : of the contact, normal and tangential, per unit stiffness (m²).
    trainings : arcs, all in the same intact contact; the first one's materials are the ring's.
    """
    unit = pieces[0].matrix(np.ones(len(pieces[0]))), pieces[1].matrix(np.ones(len(pieces[1])))
    known = {p.space.kind: p for p in ring.problems}
    profile, terms = radial_profile(ring.model.mesh), affine_terms(ring.model)
    begun = with_local_fields(ring, trainings[0].materials, sp.csr_array(unit[0] + unit[1]))
    windings = _by_materials(trainings)
    first = Arcs(begun, pieces, unit, trainings[0].materials, trainings[0].joint)

    def parts_of(number: int) -> Parts:
        # what is made for one winding is gone before the next one's is
        own = windings[number]
        return (replace(first, materials=own[0].materials) if number else first).parts(own)

    # this process takes the first ones, whose energy weighs all others' parts
    solved = side_by_side(parts_of, range(len(windings)), here=(0,))
    most = max(PARTS, EACH * len(trainings))
    problems = []
    for own, *parts in zip(first.problems, *solved, strict=True):
        old = known.get(own.space.kind, unsolved(own.space))
        basis = own.of_unit_energies(old.basis)
        more = own.joined(basis, own.weighed(np.hstack(parts)), most).own[:, len(basis) :]
        problems.append(grown(old, more, terms, profile))
    return replace(ring, problems=tuple(problems))


def _by_materials(trainings: Sequence[ArcTraining]) -> list[list[ArcTraining]]:
    """The arcs of the same materials together: what is solved there, is solved once."""
    found: dict[bytes, list[ArcTraining]] = {}
    for training in trainings:
        found.setdefault(mark_of(training.materials), []).append(training)
    return list(found.values())
