"""Directions of materials."""

import numpy as np
import pytest
from small_stators import MATERIALS, ORTHOTROPIC, STACK
from wound_box import draws, winding

from statorhom.errors import SolverError
from statorhom.materials.isotropic import Isotropic
from statorhom.materials.orthotropic import Orthotropic
from statorhom.model.affine import Material
from statorhom.model.material_span import material_point, material_span

REGIONS = ("lamination", "winding", "overhang")
FOAM = Isotropic(60e6, 0.3)


def test_as_many_directions_as_the_symmetry_has():
    """Whatever of it the materials use: derivatives may ask for the rest."""
    found = material_span([material_point(m, REGIONS) for m in draws(3, 1)], REGIONS)
    assert {r: len(e) for r, e in found.entries.items()} == {"lamination": 5, "winding": 5}
    assert found.size == 10
    several = [STACK, Material(ORTHOTROPIC.hooke(), 7800.0)]
    points = [material_point({"lamination": m}, REGIONS[:1]) for m in several]
    assert material_span(points, REGIONS[:1]).size == 9


def test_weights_and_directions_give_the_material_back():
    span = material_span([material_point(m, REGIONS) for m in draws(20, 1)], REGIONS)
    point = material_point(winding(np.array([0.3, -1.0, 0.8])), REGIONS)
    weights = span.weights(point)
    start = 0
    for first, members in span.groups.items():
        count = len(span.entries[first])
        rebuilt = span.directions[first] @ weights[start : start + count]
        for region in members:
            hooke = point.hooke[REGIONS.index(region)]
            np.testing.assert_allclose(rebuilt, hooke, rtol=1e-9, atol=1e-6 * hooke.max())
        start += count


def test_regions_of_one_material_move_together():
    shared = [material_point(m, REGIONS) for m in draws(5, 1)]
    span = material_span(shared, REGIONS)
    assert span.groups == {"lamination": ("lamination",), "winding": ("winding", "overhang")}
    parted = winding(np.zeros(3)) | {"overhang": STACK}
    with pytest.raises(SolverError, match="'overhang'"):
        span.weights(material_point(parted, REGIONS))
    apart = material_span([*shared, material_point(parted, REGIONS)], REGIONS)
    assert list(apart.groups) == list(REGIONS)


def test_a_group_s_derivative_stands_once():
    span = material_span([material_point(m, REGIONS) for m in draws(5, 1)], REGIONS)
    found = span.hooke_gradients(np.arange(1.0, 11.0))
    assert sorted(found) == sorted(REGIONS)
    assert np.all(found["overhang"] == 0.0)
    np.testing.assert_array_equal(found["winding"][span.entries["winding"]], np.arange(6.0, 11.0))


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


def test_what_never_changes_folds_into_one_direction():
    rng = np.random.default_rng(0)
    cloths = [
        Orthotropic(e, e, 9e9, 0.04, 0.3, 0.3, g, 3e9, 3e9)
        for e, g in zip(rng.uniform(25e9, 85e9, 9), rng.uniform(1e9, 10e9, 9), strict=True)
    ]
    made = [{"cloth": Material(c.hooke(), 1500.0), "foam": Material(FOAM.hooke(), 80.0)} for c in cloths]
    points = [material_point(m, ("cloth", "foam")) for m in made]
    span = material_span(points, ("cloth", "foam"), folded=True)
    assert {r: len(e) for r, e in span.entries.items()} == {"cloth": 6, "foam": 1}
    assert material_span(points, ("cloth", "foam")).size == 9 + 2
    weights = span.weights(points[4])
    np.testing.assert_allclose(span.directions["cloth"] @ weights[:6], points[4].hooke[0], rtol=1e-9)
    np.testing.assert_allclose(span.directions["foam"] @ weights[6:], points[4].hooke[1], rtol=1e-9)
    with pytest.raises(SolverError, match="'foam'"):
        span.weights(material_point({**made[0], "foam": made[0]["cloth"]}, ("cloth", "foam")))
