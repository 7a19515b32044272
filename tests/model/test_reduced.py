"""Reduced bases against the full model."""

import numpy as np
import pytest
from small_stators import MATERIALS, STACK, stator_mesh

from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.mesh import MeshDensity, uniform
from statorhom.model.affine import Material, assemble
from statorhom.model.eigen import modes_below
from statorhom.model.harmonic import harmonic_spaces
from statorhom.model.radial_profile import radial_profile
from statorhom.model.reduced import coefficients, lowest_pairs, reduce_harmonic
from statorhom.model.stator_mode import VISIBLE

TOP_HZ = 5000.0
CENTRE = np.log([2.0, 11.0, 0.9])  # E_p, E_z, G_rz of the winding in GPa
SPREAD = np.array([0.6, 0.5, 0.6])  # of their logarithms


def winding(z):
    """Materials of a wound stator whose winding lies `z` standard deviations from the middle, (3,)."""
    e_p, e_z, g = 1e9 * np.exp(CENTRE + SPREAD * z)
    made = Material(TransverselyIsotropic(e_p, e_z, 0.33, 0.03, g).hooke(), 3100.0)
    return {"lamination": STACK, "winding": made, "overhang": made}


def draws(count, seed):
    z = np.random.default_rng(seed).standard_normal((count, 3))
    return [winding(row) for row in np.clip(z, -2.5, 2.5)]


@pytest.fixture(scope="module")
def wound():
    cells = dict(uniform(1).cells) | {"core": 2, "yoke": 1, "overhang": 1, "radial": 1}
    return assemble(stator_mesh(8, ("stack", "wound"), MeshDensity(cells)))


@pytest.fixture(scope="module")
def reduced(wound):
    space = harmonic_spaces(wound.mesh, 2)[0]
    return reduce_harmonic(wound, space, [winding(np.zeros(3)), *draws(64, 1)], TOP_HZ)


def full_modes(model, space, materials, top=TOP_HZ):
    return modes_below(
        space.project(model.stiffness_matrix(materials)), space.project(model.mass_matrix(materials)), top
    )


def test_frequencies_are_right_all_over_the_prior(wound, reduced):
    """Thirty materials that the basis never saw: visible modes within 0.05 %."""
    space, profile = reduced.harmonic, radial_profile(wound.mesh)
    largest, seen = 0.0, 0
    for materials in draws(30, 2):
        exact, vectors = full_modes(wound, space, materials)
        amplitudes = profile.orders(space, space.expand(vectors) / np.sqrt(space.copies))
        mass = sum(materials[r].density * v for r, v in wound.volumes.items())
        visible = (mass * np.mean(amplitudes**2, axis=0) > VISIBLE) & (exact > 1e4)
        found, _ = reduced.modes(coefficients(materials), 1.2 * TOP_HZ)
        error = np.sqrt(found[: len(exact)] / np.maximum(exact, 1e4)) - 1
        largest = max(largest, error[visible].max(initial=0.0))
        seen += visible.sum()
        # Ritz values are upper bounds
        assert np.all(found[: len(exact)] >= exact * (1 - 1e-7) - 1.0)
    assert seen > 30
    assert largest < 5e-4


def test_the_error_it_states_is_of_the_size_of_the_true_one(reduced):
    assert 0.0 < reduced.error < 3e-4
    assert reduced.basis.shape[1] < 0.6 * reduced.basis.shape[0]


def test_vectors_are_mass_normalised_shapes_of_the_full_model(wound, reduced):
    materials = draws(1, 3)[0]
    values, q = reduced.modes(coefficients(materials), TOP_HZ)
    space = reduced.harmonic
    K, M = (
        space.project(matrix) for matrix in (wound.stiffness_matrix(materials), wound.mass_matrix(materials))
    )
    shapes = reduced.basis @ q
    np.testing.assert_allclose(shapes.T @ (M @ shapes), np.eye(len(values)), atol=1e-6)
    np.testing.assert_allclose(shapes.T @ (K @ shapes), np.diag(values), atol=1e-6 * np.abs(values).max())


def test_other_densities_are_followed(reduced):
    materials = winding(np.zeros(3))
    heavy = {r: Material(m.hooke, 1.1 * m.density) for r, m in materials.items()}
    light, dense = (reduced.modes(coefficients(m), TOP_HZ)[0] for m in (materials, heavy))
    np.testing.assert_allclose(dense[: len(light)], light / 1.1, rtol=1e-7, atol=1.0)


def test_one_material_is_exact_and_has_no_error(wound):
    space = harmonic_spaces(wound.mesh, 3)[0]
    alone = reduce_harmonic(wound, space, [MATERIALS], TOP_HZ)
    exact, _ = full_modes(wound, space, MATERIALS)
    np.testing.assert_allclose(alone.modes(coefficients(MATERIALS), TOP_HZ)[0], exact, rtol=1e-8, atol=1.0)
    assert alone.error == 0.0


def test_the_number_of_snapshots_is_limited_and_what_is_left_is_told(wound):
    space = harmonic_spaces(wound.mesh, 2)[0]
    training = [winding(np.zeros(3)), *draws(16, 1)]
    small = reduce_harmonic(wound, space, training, TOP_HZ, most=3)
    assert small.error > 1e-3
    large = reduce_harmonic(wound, space, training, TOP_HZ, tolerance=1e-2)
    assert large.error < 1e-2
    assert small.basis.shape[1] < large.basis.shape[1]


@pytest.mark.parametrize("unit_mass", [True, False])
def test_dense_pairs(unit_mass):
    rng = np.random.default_rng(4)
    root = rng.standard_normal((9, 9))
    K = root @ root.T
    M = np.eye(9) if unit_mass else np.eye(9) + 0.05 * (root + root.T)
    top = np.median(np.linalg.eigvals(np.linalg.solve(M, K)).real)
    values, vectors = lowest_pairs(K, M, top)
    assert 0 < len(values) < 9
    assert np.all(values <= top)
    np.testing.assert_allclose(K @ vectors, M @ vectors * values, atol=1e-9 * np.abs(K).max())
    np.testing.assert_allclose(vectors.T @ M @ vectors, np.eye(len(values)), atol=1e-9)
