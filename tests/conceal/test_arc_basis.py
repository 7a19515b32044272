"""Arcs of lost contact in the basis of a concealed stator, against enrichment by residuals."""

from __future__ import annotations

import numpy as np
import pytest
from small_stators import MATERIALS, stator_mesh

from statorhom.conceal.arc_basis import with_lost_contacts
from statorhom.conceal.breaks import LostContact
from statorhom.conceal.ground import arcs_like
from statorhom.model.affine import assemble
from statorhom.model.broken.basis import symmetric_basis
from statorhom.model.broken.cells import Sectors
from statorhom.model.broken.change import PieceChange
from statorhom.model.broken.interface import contact, split
from statorhom.model.broken.soften import softened
from statorhom.model.broken.solve import solve_broken
from statorhom.physics.action import Joint

SLOTS, TOP, BOND = 8, 3000.0, 3e13
WOUND = ("winding", "overhang")
INTACT = Joint(WOUND, BOND, BOND)


@pytest.mark.parametrize(("start", "most"), [(-0.9, 4e-3), (-0.63, 4e-2)])
def test_arcs_have_their_modes_before_any_enrichment(start: float, most: float) -> None:
    lost = LostContact(start, start + 1.8, 1e-3)
    model = assemble(split(stator_mesh(SLOTS, ("stack", "wound")), WOUND))
    joint = contact(model.mesh, WOUND, BOND, BOND)
    basis = symmetric_basis(model, MATERIALS, TOP, margin=1.4, contact=joint.matrix)
    own = with_lost_contacts(basis, model, MATERIALS, arcs_like(lost, INTACT, SLOTS))
    share = Sectors(np.array([[0.0, np.pi / SLOTS]]), SLOTS).share_of_arc(lost.start, lost.end)
    change = PieceChange(joint.pieces, None, np.repeat((lost.ratio - 1) * share, len(joint.pieces), axis=0))
    exact = solve_broken(basis, [change], 2e-3).frequencies_hz
    plain, found = (
        solve_broken(softened(b, [change]), [change], None).frequencies_hz[: len(exact)] for b in (basis, own)
    )
    assert np.abs(np.log(found / exact)).max() < most
    assert np.abs(np.log(plain / exact)).max() > 0.05


def test_arcs_that_serve_lose_a_half_pitch_less_and_more() -> None:
    found = arcs_like(LostContact(0.1, 0.1 + 4.3 * np.pi / SLOTS, 1e-3), INTACT, SLOTS)
    assert [round(j.arc[1] / (np.pi / SLOTS), 9) for j in found] == [3.0, 4.0, 5.0]
    assert {j.ratio for j in found} == {1e-3}
    # no less than one and no more than all
    assert len(arcs_like(LostContact(0.0, 1.1 * np.pi / SLOTS, 1e-3), INTACT, SLOTS)) == 2
