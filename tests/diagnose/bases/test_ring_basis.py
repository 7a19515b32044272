"""Small bases of the symmetric stator."""

from __future__ import annotations

import numpy as np
import pytest
from small_stators import MATERIALS, stator_mesh

from statorhom.diagnose.bases.ring_basis import ring_basis
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


def test_some_problems_have_the_modes_that_they_have_among_all() -> None:
    model = assemble(stator_mesh(12))
    ring = ring_basis(model, [stack(0.28)], TOP, range(5))
    whole, part = ring.solve(stack(0.3)), ring.solve(stack(0.3), {1, 3})
    assert part.modes == tuple(mode for mode in whole.modes if mode.problem in {1, 3})
    assert part.modes, "nothing was compared"


def test_slopes_are_those_of_the_frequencies() -> None:
    model = assemble(stator_mesh(12, ("stack", "wound")))
    materials = {region: MATERIALS[region] for region in model.mesh.regions}
    ring = ring_basis(model, [materials], TOP, range(4))
    solved = ring.solve(materials)
    # the order of the regions is that of the materials, whatever the mesh's
    for order in (list(materials), list(materials)[::-1]):
        for number, region in enumerate(order):
            heavier = {
                r: Material(m.hooke, m.density * (1.001 if r == region else 1.0))
                for r, m in materials.items()
            }
            after = {mode.place: mode for mode in ring.solve(heavier).modes}
            for mode in solved.modes[:6]:
                slope = solved.slope(mode, {r: materials[r] for r in order}).reshape(-1, 10)[number, 9]
                change = np.log(after[mode.place].frequency_hz / mode.frequency_hz)
                step = 0.001 * materials[region].density
                assert change / step == pytest.approx(slope, rel=0.01, abs=1e-9)
