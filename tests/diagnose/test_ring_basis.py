"""Small bases of the symmetric stator."""

from __future__ import annotations

import pytest
from small_stators import stator_mesh

from statorhom.diagnose.ring_basis import ring_basis
from statorhom.materials.symmetry import SYMMETRIES
from statorhom.model.affine import Material, Materials, assemble
from statorhom.model.convergence import mode_keys
from statorhom.model.free_modes import solve_free

TOP = 9000.0


def stack(nu: float) -> Materials:
    return {"lamination": Material(SYMMETRIES["isotropic"](1.9e11, nu).hooke(), 7800.0)}


def test_a_basis_is_exact_at_a_snapshot_that_hardly_changes_its_volume() -> None:
    """Its shapes differ little from those of other snapshots, but that little is stiff."""
    model = assemble(stator_mesh(12))
    ring = ring_basis(model, [stack(0.28), stack(0.31)], TOP, range(5)).extended([stack(0.49)])
    for nu in (0.28, 0.31, 0.49):
        full = mode_keys(solve_free(model, stack(nu), TOP, range(5)).modes)
        found = mode_keys(ring.solve(stack(nu)).modes)
        for key, mode in full.items():
            assert found[key].frequency_hz == pytest.approx(mode.frequency_hz, rel=1e-5), (nu, key)
