"""Evaluations of reduced stators against the full model: their errors, certificates, names and derivatives."""

import numpy as np
import pytest
import wound_box as stage
from small_stators import MATERIALS, stator_mesh

from statorhom.errors import SolverError
from statorhom.materials.orthotropic import Orthotropic
from statorhom.model.affine import Material, assemble
from statorhom.model.free_modes import solve_free
from statorhom.model.harmonic import harmonic_spaces
from statorhom.model.reduced import material_box, reduce_harmonic
from statorhom.model.reduced_stator import reduced_stator

TOP_HZ = 6000.0


@pytest.fixture(scope="module")
def wound():
    return reduced_stator(
        stage.wound(), stage.box(), [stage.reduced()], stage.TOP_HZ, stage.winding(np.zeros(3))
    )


@pytest.fixture(scope="module")
def model():
    return assemble(stator_mesh(6, ("stack", "wound")))


@pytest.fixture(scope="module")
def reduced(model):
    spaces = [space for order in (0, 2, 3) for space in harmonic_spaces(model.mesh, order)]
    box = material_box([MATERIALS], model.mesh.regions)
    problems = [reduce_harmonic(model, s, box, TOP_HZ) for s in spaces]
    return reduced_stator(model, box, problems, TOP_HZ, MATERIALS)


def compared(wound, materials):
    """True relative errors, certified ones, of all modes of the band."""
    solution = wound.solve(materials)
    (pairs,), (bounds,) = solution.pairs, solution.certificates
    exact = stage.full_modes(materials)[0]
    assert pairs.counts[0] in (len(exact), len(exact) - 1)  # one may lie within the error of the band's end
    count = pairs.counts[0]
    true = np.sqrt(pairs.values[0, :count] / exact[:count]) - 1
    assert exact[0] > 1e4  # no rigid body in this harmonic
    return true, bounds[0, :count]


def test_frequencies_are_right_and_certified_all_over_the_box(wound):
    """Thirty materials that the bases never saw: a true bound, and not a hopeless one."""
    worst, effectivity = 0.0, []
    for materials in stage.draws(30, 2):
        true, certified = compared(wound, materials)
        assert np.all(true >= -1e-9)  # Ritz values are upper bounds
        assert np.all(true <= certified)
        worst = max(worst, true.max())
        effectivity += (certified / true)[true > 1e-6].tolist()
    assert worst < 5e-4
    assert len(effectivity) > 20
    assert 1.0 <= np.median(effectivity) < 30.0


def test_certificates_hold_outside_of_the_box_too(wound):
    far = stage.winding(np.array([4.0, 0.0, -3.0]))
    true, certified = compared(wound, far)
    assert true.max() > 1e-3
    assert np.all(true <= certified)


def test_other_densities_are_followed(wound):
    heavy = stage.winding(np.array([0.3, -0.2, 0.1]), density=3300.0)
    true, certified = compared(wound, heavy)
    assert np.all(true <= certified)
    assert true.max() < 5e-4


def test_the_certificate_of_a_mode_and_of_all(wound):
    solution = wound.solve(stage.draws(1, 5)[0])
    each = [solution.certified_error(mode) for mode in solution.modes]
    assert 0.0 < max(each) <= solution.largest_certified_error < 1e-2


def test_problems_without_modes_in_the_band_have_no_certificate_and_spoil_none(model):
    """Up to 2500 Hz only some harmonics have modes: the others' values, computed all the same, are not certified."""
    spaces = [space for order in (0, 2, 3) for space in harmonic_spaces(model.mesh, order)]
    box = material_box([MATERIALS], model.mesh.regions)
    problems = [reduce_harmonic(model, s, box, TOP_HZ) for s in spaces]
    low = reduced_stator(model, box, problems, 2500.0, MATERIALS).solve(MATERIALS)
    counts = np.concatenate([pairs.counts for pairs in low.pairs])
    assert 0 < (counts > 0).sum() < len(counts)
    for pairs, bounds in zip(low.pairs, low.certificates, strict=True):
        none = np.isinf(bounds).all(axis=1)
        assert not np.any(none & (pairs.counts > 0))
        # a batch's last rows, after those with modes
        assert np.all(none[pairs.used.stop :])
        assert pairs.counts[pairs.used.stop :].sum() == 0
    assert low.largest_certified_error < 1e-5


def test_at_its_only_material_the_reduced_stator_is_the_full_one(model, reduced):
    expected = solve_free(model, MATERIALS, TOP_HZ, (0, 2, 3)).modes
    solution = reduced.solve(MATERIALS)
    found = solution.modes
    np.testing.assert_allclose([m.frequency_hz for m in found], [m.frequency_hz for m in expected], rtol=1e-8)
    assert [(m.order, m.axial, m.kind) for m in found] == [(m.order, m.axial, m.kind) for m in expected]
    np.testing.assert_allclose([m.visibility for m in found], [m.visibility for m in expected], atol=1e-6)
    assert [(m.multiplicity, m.problem, m.column) for m in found] == [
        (m.multiplicity, m.problem, m.column) for m in expected
    ]
    assert solution.largest_certified_error < 1e-5


def test_gradients_are_those_of_the_reduced_frequencies(reduced):
    solution = reduced.solve(MATERIALS)
    for mode in [m for m in solution.modes if m.order is not None][:4]:
        gradient = solution.log_frequency_gradient(mode)
        for region, members in reduced.box.span.groups.items():
            material, (hooke, _) = MATERIALS[region], gradient[region]
            stiffer = type(material.hooke)(material.hooke.matrix * (1 + 1e-4))
            stiff = dict.fromkeys(members, Material(stiffer, material.density))
            slope = _difference(reduced, mode, MATERIALS | stiff)
            # all Hooke entries together: the stiffness of the regions that share the material
            scaled = hooke @ solution.point.hooke[reduced.box.span.regions.index(region)]
            assert scaled == pytest.approx(slope, abs=2e-5)
        for region, (_, density) in gradient.items():
            material = MATERIALS[region]
            heavier = Material(material.hooke, material.density * (1 + 1e-4))
            slope = _difference(reduced, mode, {**MATERIALS, region: heavier})
            assert density * material.density == pytest.approx(slope, abs=2e-5)


def _difference(reduced, mode, changed):
    """d ln f / d ln p of a mode, p greater by 1e-4."""
    found = [m for m in reduced.solve(changed).modes if (m.problem, m.column) == (mode.problem, mode.column)]
    return np.log(found[0].frequency_hz / mode.frequency_hz) / 1e-4


def test_a_material_of_another_symmetry_is_refused(reduced):
    other = Material(Orthotropic(190e9, 170e9, 90e9, 0.28, 0.35, 0.31, 66e9, 21e9, 28e9).hooke(), 7800.0)
    with pytest.raises(SolverError, match=r"'lamination'.*another symmetry"):
        reduced.solve({**MATERIALS, "lamination": other})
