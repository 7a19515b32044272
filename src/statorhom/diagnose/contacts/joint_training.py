"""Bases for arcs over which a contact is lost: the parts that the modes of a few of them have in every harmonic.

Other arcs' modes are nearly sums of these parts.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from statorhom.diagnose.bases.ring_basis import RingBasis, affine_terms, grown
from statorhom.diagnose.contacts.joint_fields import unsolved, with_local_fields
from statorhom.diagnose.contacts.joint_solution import PARTS, Arcs
from statorhom.model.affine import Materials
from statorhom.model.broken.pieces import Pieces
from statorhom.model.radial_profile import radial_profile
from statorhom.physics.action import Joint


def with_arcs(
    ring: RingBasis, pieces: tuple[Pieces, Pieces], materials: Materials, trainings: Sequence[Joint]
) -> RingBasis:
    """The bases with what arcs like some need, and the harmonics that these bring in.

    Parameters
    ----------
    ring : on a split mesh, its modes at several even contacts.
    pieces : of the contact, normal and tangential, per unit stiffness (m²).
    materials : at which the arcs are solved.
    trainings : arcs around θ = 0, all in the same intact contact.
    """
    unit = pieces[0].matrix(np.ones(len(pieces[0]))), pieces[1].matrix(np.ones(len(pieces[1])))
    known = {p.space.kind: p for p in ring.problems}
    profile, terms = radial_profile(ring.model.mesh), affine_terms(ring.model)
    begun = with_local_fields(ring, materials, sp.csr_array(unit[0] + unit[1]))
    arcs = Arcs(begun, pieces, unit, materials, trainings[0])
    problems = []
    for own, part in zip(arcs.problems, arcs.parts(trainings), strict=True):
        old = known.get(own.space.kind, unsolved(own.space))
        more = own.joined(old.basis, part, PARTS)[:, old.basis.shape[1] :]
        problems.append(grown(old, more, terms, profile))
    return replace(ring, problems=tuple(problems))
