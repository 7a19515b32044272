import numpy as np
import pytest
from boxes import box_mesh, corners
from scipy.linalg import eigh
from scipy.optimize import brentq
from small_stators import ORTHOTROPIC

from statorhom.errors import SolverError
from statorhom.model.affine import Material
from statorhom.model.frames import cartesian
from statorhom.model.general.additions import nodal_masses, nodal_springs
from statorhom.model.general.general_model import general_model

SIZE = (0.12, 0.05, 0.03)
MATERIALS = {"box": Material(ORTHOTROPIC.hooke(), 7810.5)}
MASS = 7810.5 * np.prod(SIZE)


@pytest.fixture(scope="module")
def body():
    return general_model(box_mesh(SIZE, (3, 1, 1)), cartesian)


def test_a_body_on_soft_springs_bounces_as_a_rigid_one(body):
    feet, k = corners(body.mesh), np.array([1e3, 3e3, 2e3])
    model = body.with_added(nodal_springs(body.size, feet, k), nodal_masses(body.size, feet, 0.1))
    hz = model.solve(200.0, MATERIALS).frequencies_hz
    bounce = np.sqrt(8 * k / (MASS + 0.8)) / (2 * np.pi)
    # springs and lumps at the corners: rocking does not couple with bouncing
    half = np.array(SIZE) / 2
    arms = np.array([half[1] ** 2 + half[2] ** 2, half[0] ** 2 + half[2] ** 2, half[0] ** 2 + half[1] ** 2])
    inertia = MASS * arms / 3 + 0.8 * arms
    stiffness = 8 * np.array(
        [k[2] * half[1] ** 2 + k[1] * half[2] ** 2, k[2] * half[0] ** 2 + k[0] * half[2] ** 2,
         k[1] * half[0] ** 2 + k[0] * half[1] ** 2]
    )  # fmt: skip
    rock = np.sqrt(stiffness / inertia) / (2 * np.pi)
    np.testing.assert_allclose(hz, np.sort(np.r_[bounce, rock]), rtol=1e-5)


def test_one_spring_obeys_the_secular_equation(body):
    # K + k e eᵀ: 1/k + Σ φᵢ²/(λᵢ − λ) = 0 (Golub 1973), with all modes of the free body
    node, k = int(corners(body.mesh)[5]), 4e7
    values, vectors = eigh(body.stiffness_matrix(MATERIALS).toarray(), body.mass_matrix(MATERIALS).toarray())
    values[:6] = 0.0
    phi = vectors[3 * node + 2] ** 2
    held = body.with_added(stiffness=nodal_springs(body.size, node, [0.0, 0.0, k]))
    found = held.solve(1.05 * np.sqrt(values[9]) / (2 * np.pi), MATERIALS).eigenvalues
    # five rigid motions of the free body do without the spring
    assert np.all(found[:5] < 1e-6 * found[5])
    for low, high, value in zip(values[5:9], values[6:10], found[5:9], strict=True):
        gap = 1e-9 * (high - low)
        exact = brentq(lambda x: 1 / k + np.sum(phi / (values - x)), low + gap, high - gap, rtol=1e-14)
        assert value == pytest.approx(exact, rel=1e-8)


def test_lumps_and_springs_are_placed_and_added_up(body):
    nodes = [3, 11, 3]
    K, M = np.zeros((body.size, body.size)), np.zeros((body.size, body.size))
    for node, k, m in zip(
        nodes, ([1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]), (0.1, 0.2, 0.3), strict=True
    ):
        place = 3 * node + np.arange(3)
        K[place, place] += k
        M[place, place] += m
    springs = nodal_springs(body.size, nodes, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]])
    masses = nodal_masses(body.size, nodes, [0.1, 0.2, 0.3])
    np.testing.assert_allclose(springs.toarray(), K)
    np.testing.assert_allclose(masses.toarray(), M)
    twice = body.with_added(stiffness=springs).with_added(stiffness=springs, mass=masses)
    for whole, bare, added in (
        (twice.stiffness_matrix(MATERIALS), body.stiffness_matrix(MATERIALS), 2 * K),
        (twice.mass_matrix(MATERIALS), body.mass_matrix(MATERIALS), M),
    ):
        np.testing.assert_allclose((whole - bare).toarray(), added, atol=1e-14 * abs(whole).max())


def test_a_stiffness_factor_leaves_springs_alone(body):
    springs = nodal_springs(body.size, corners(body.mesh), [1e8, 1e8, 1e8])
    nothing = np.zeros(len(body.mesh.elements))
    K = body.with_added(stiffness=springs).stiffness_matrix(MATERIALS, nothing)
    np.testing.assert_array_equal(K.toarray(), springs.toarray())


def test_a_negative_spring_that_no_body_can_hold_is_refused(body):
    model = body.with_added(stiffness=nodal_springs(body.size, 0, [-1e13, 0.0, 0.0]))
    with pytest.raises(SolverError, match="not positive definite; check materials, springs and masses"):
        model.solve(3e4, MATERIALS)
