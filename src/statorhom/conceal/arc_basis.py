"""What the modes of a contact that is lost over an arc have in every harmonic, as vectors of the symmetric basis.

Within the arc parts move against each other in so many local shapes that the residuals' answers take thousands of
vectors and stay a percent too stiff. The parts of an arc's own modes leave a tenth of a percent.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.joint_basis import LADDER
from statorhom.diagnose.joint_training import arcs_around
from statorhom.diagnose.ring_basis import ring_basis
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.broken.basis import SymmetricBasis
from statorhom.model.broken.enrich import extended
from statorhom.model.broken.interface import contact
from statorhom.physics.action import Joint

MOST = 90  # vectors that a harmonic gets
ORDERS = range(7)  # whose modes the arcs' solutions begin with


def with_lost_contacts(
    basis: SymmetricBasis, model: AffineModel, materials: Materials, lost: Sequence[Joint]
) -> SymmetricBasis:
    """A basis in which arcs of lost contact have accurate modes, wherever they begin.

    Parameters
    ----------
    basis : of the stator whose contact is intact.
    model : of the half pitch, split along the contact.
    materials : of all regions.
    lost : arcs around θ = 0, all in the same intact contact.
    """
    regions = lost[0].regions
    pieces = contact(model.mesh, regions, 1.0, 0.0).pieces, contact(model.mesh, regions, 0.0, 1.0).pieces
    unit = sum(p.matrix(np.ones(len(p))) for p in pieces)
    ring = ring_basis(model, [materials], basis.highest_hz, ORDERS, [k * unit for k in LADDER])
    arcs = arcs_around(ring, pieces, materials, lost[0])
    parts = {p.space.kind: (p, part) for p, part in zip(arcs.problems, arcs.parts(lost), strict=True)}
    problems = []
    for problem in basis.problems:
        if problem.sector.space.kind in parts:
            own, part = parts[problem.sector.space.kind]
            more = own.joined(problem.vectors, part, MOST)[:, len(problem.values) :]
            problem = extended(problem, more, 0.0)
        problems.append(problem)
    return replace(basis, problems=tuple(problems), grams=type(basis.grams)())
