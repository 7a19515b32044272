"""Directions of materials."""

import numpy as np
import pytest
from small_stators import MATERIALS, ORTHOTROPIC, STACK
from wound_box import draws, winding

from statorhom.errors import SolverError
from statorhom.materials.isotropic import Isotropic
from statorhom.model.affine import Material
from statorhom.model.material_span import material_point, material_span

REGIONS = ("lamination", "winding", "overhang")


def test_as_many_directions_as_the_symmetry_has():
    """Whatever of it the materials use: derivatives may ask for the rest."""
    found = material_span([material_point(m, REGIONS) for m in draws(3, 1)], REGIONS)
    assert [len(found.entries[r]) for r in REGIONS] == [5, 5, 5]
    assert found.size == 15
    several = [STACK, Material(ORTHOTROPIC.hooke(), 7800.0)]
    points = [material_point({"lamination": m}, REGIONS[:1]) for m in several]
    assert material_span(points, REGIONS[:1]).size == 9


def test_weights_and_directions_give_the_material_back():
    span = material_span([material_point(m, REGIONS) for m in draws(20, 1)], REGIONS)
    point = material_point(winding(np.array([0.3, -1.0, 0.8])), REGIONS)
    weights = span.weights(point)
    first = 0
    for i, region in enumerate(REGIONS):
        count = len(span.entries[region])
        rebuilt = span.directions[region] @ weights[first : first + count]
        np.testing.assert_allclose(rebuilt, point.hooke[i], rtol=1e-9, atol=1e-6 * point.hooke[i].max())
        first += count


def test_an_isotropic_region_has_two_directions():
    rng = np.random.default_rng(0)
    made = [
        {"lamination": Material(Isotropic(e, nu).hooke(), 7800.0)}
        for e, nu in zip(rng.uniform(1e9, 2e11, 9), rng.uniform(0.1, 0.4, 9), strict=True)
    ]
    assert material_span([material_point(m, REGIONS[:1]) for m in made], REGIONS[:1]).size == 2


def test_other_symmetries_are_refused():
    span = material_span([material_point(MATERIALS, REGIONS)], REGIONS)
    other = Material(ORTHOTROPIC.hooke(), 7800.0)
    with pytest.raises(SolverError, match="'winding'"):
        span.weights(material_point({**MATERIALS, "winding": other}, REGIONS))
