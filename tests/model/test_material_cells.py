"""Distances between materials, and cells."""

import numpy as np
import pytest
from small_stators import MATERIALS, ORTHOTROPIC, STACK
from wound_box import draws, winding, wound

from statorhom.materials.hooke import Hooke
from statorhom.model.affine import Material
from statorhom.model.material_cells import divided, features, material_cells, stiffness_ratio
from statorhom.model.material_span import material_point

REGIONS = ("lamination", "winding", "overhang")


def points(materials):
    return [material_point(m, REGIONS) for m in materials]


def test_the_stiffness_ratio_bounds_every_energy():
    reference, other = winding(np.zeros(3)), winding(np.array([-1.5, 0.5, 1.0]), density=2800.0)
    ratio = stiffness_ratio(*points([other, reference]))
    rng = np.random.default_rng(1)
    shapes = rng.standard_normal((wound().size, 20))
    energies = []
    for materials in (other, reference):
        A = wound().stiffness_matrix(materials) + 1e8 * wound().mass_matrix(materials)
        energies.append(np.einsum("ij,ij->j", shapes, A @ shapes))
    assert np.all(energies[0] >= ratio * energies[1])
    assert 0.05 < ratio < 0.5


@pytest.mark.parametrize("factor", [0.5, 2.0])
def test_a_scaled_material_has_its_factor(factor):
    scaled = {r: Material(Hooke(m.hooke.matrix * factor), m.density * factor) for r, m in MATERIALS.items()}
    assert stiffness_ratio(*points([scaled, MATERIALS])) == pytest.approx(factor)


def test_cells_cover_all_within_the_radius_or_are_as_many_as_allowed():
    all_points = np.array([features(p) for p in points(draws(60, 4))])
    cells, centres = material_cells(all_points, 0.8, 60)
    assert len(set(centres)) == len(centres) == len(cells.centres)
    wide, few = material_cells(all_points, 0.8, 3)
    assert len(few) == 3
    assert few == centres[:3]
    single, chosen = material_cells(all_points, 1e9, 60)
    assert chosen == [0]
    assert single.locate(all_points[5]) == 0
    assert [wide.locate(all_points[i]) for i in few] == [0, 1, 2]


def test_orthotropic_materials_have_distances_too():
    material = {r: Material(ORTHOTROPIC.hooke(), STACK.density) for r in REGIONS}
    assert stiffness_ratio(*points([material, material])) == pytest.approx(1.0)


def test_every_material_is_a_member_of_its_cell_and_cells_have_enough():
    all_points = points(draws(60, 4))
    division = divided(all_points, 0.8, 60)
    for number, point in enumerate(all_points):
        assert number in division.members[division.cells.locate(features(point))]
    assert min(len(members) for members in division.members) >= 12
    for cell, members in enumerate(division.members):
        assert division.cells.locate(features(all_points[members[0]])) == cell
        assert len(set(members)) == len(members)
    assert [len(members) for members in divided(all_points, np.inf, 60).members] == [60]
