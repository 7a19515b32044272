"""Bases of blocks grow by corrections of their own Ritz vectors, with one full solution a problem."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.geometry.block import BlockGeometry
from statorhom.materials.orthotropic import Orthotropic
from statorhom.mesh.block import block_mesh
from statorhom.model import basis_greedy
from statorhom.model.affine import Material, assemble
from statorhom.model.free_modes import solve_free
from statorhom.model.problems import orders_of, spaces_of
from statorhom.model.reduced import material_box, reduce_harmonic
from statorhom.model.reduced_stator import reduced_stator

TOP_HZ, TOLERANCE = 900.0, 1e-3
MODEL = assemble(block_mesh(BlockGeometry("plate", (0.3, 0.2, 0.004), "test"), 0.5))
SPACES = [space for order in orders_of(MODEL.mesh) for space in spaces_of(MODEL.mesh, order)]


def cloth(E: float, G: float) -> dict[str, Material]:
    moduli = (E, E, 9e9, 0.04, 0.3, 0.3, G, 3e9, 3e9)
    return {MODEL.mesh.regions[0]: Material(Orthotropic(*moduli).hooke(), 1510.0)}


def draws(count: int, seed: int) -> list[dict[str, Material]]:
    """Of a decade of shear moduli and a third of it of moduli."""
    unit = np.random.default_rng(seed).uniform(size=(count, 2))
    return [cloth(25e9 * 3.4**e, 1e9 * 10**g) for e, g in unit]


@pytest.fixture
def solved(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """One entry per full eigenproblem of a basis."""
    found: list[int] = []
    modes_below = basis_greedy.modes_below

    def counted(*args, **named):
        found.append(1)
        return modes_below(*args, **named)

    monkeypatch.setattr(basis_greedy, "modes_below", counted)
    return found


def test_one_full_solution_certifies_a_box_of_a_decade(solved: list[int]) -> None:
    box = material_box([cloth(47e9, 4e9), *draws(32, 1)], MODEL.mesh.regions, most=1, folded=True)
    problems = [reduce_harmonic(MODEL, space, box, TOP_HZ, TOLERANCE) for space in SPACES]
    assert len(solved) <= len(SPACES)
    assert max(problem.error for problem in problems) <= TOLERANCE
    stator = reduced_stator(MODEL, box, problems, TOP_HZ, cloth(47e9, 4e9))
    for materials in draws(5, 2):
        exact = [mode.frequency_hz for mode in solve_free(MODEL, materials, TOP_HZ).modes]
        found = [mode.frequency_hz for mode in stator.solve(materials).modes]
        count = min(len(exact), len(found))
        assert abs(len(exact) - len(found)) <= 1 and count >= 6
        np.testing.assert_allclose(found[:count], exact[:count], rtol=TOLERANCE)


def test_where_corrections_do_not_help_the_full_model_is_asked(
    solved: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(basis_greedy, "SLOW", 0.0)
    monkeypatch.setattr(basis_greedy, "PATIENCE", 1)
    box = material_box([cloth(47e9, 4e9), *draws(32, 1)], MODEL.mesh.regions, most=1, folded=True)
    found = [reduce_harmonic(MODEL, space, box, TOP_HZ, TOLERANCE / 10) for space in SPACES]
    assert max(problem.error for problem in found) <= TOLERANCE / 10
    assert len(solved) > len(SPACES)
