import numpy as np
import pytest
from small_stators import MATERIALS, ORTHOTROPIC, assemble_whole, rigid_bodies, ring_mesh, stator_mesh

from statorhom.errors import MaterialError
from statorhom.materials.hooke import Hooke
from statorhom.materials.isotropic import Isotropic
from statorhom.model.affine import Material, assemble, hooke_coefficients
from statorhom.model.assembly import HOOKE_ENTRIES, element_geometry, region_volumes, strain_matrix
from statorhom.model.element import gauss_table


@pytest.fixture(scope="module")
def wound():
    return assemble(stator_mesh(6, ("stack", "wound")))


def _random_orthotropic(seed):
    rng = np.random.default_rng(seed)
    factor = rng.standard_normal((3, 3))
    matrix = np.diag(rng.uniform(1e9, 9e10, 6))
    matrix[:3, :3] += 3e10 * factor @ factor.T
    return Hooke(matrix)


def _close(ours, theirs):
    assert abs(ours - theirs).max() < 1e-13 * abs(theirs).max()


@pytest.mark.parametrize("seed", [0, 1])
def test_the_affine_sum_is_the_direct_integral_with_any_orthotropic_material(wound, seed):
    mesh = wound.mesh
    hookes = {name: _random_orthotropic(seed + 10 * i) for i, name in enumerate(mesh.regions)}
    dense = np.zeros((wound.size, wound.size))
    for name, hooke in hookes.items():
        elements = mesh.elements_of(name)
        g = element_geometry(mesh.nodes[elements], gauss_table())
        strain = strain_matrix(g)
        energy = np.einsum("eqia,eq,ij,eqjb->eab", strain, g.volume, hooke.matrix, strain, optimize=True)
        dofs = (3 * elements[:, :, None] + np.arange(3)).reshape(len(elements), 60)
        np.add.at(dense, (dofs[:, :, None], dofs[:, None, :]), energy)
    K = wound.stiffness_matrix({n: Material(h, 1.0) for n, h in hookes.items()})
    np.testing.assert_allclose(K.toarray(), dense, atol=1e-13 * np.abs(dense).max())


def test_terms_add_up_to_the_matrices(wound):
    coefficients = {n: hooke_coefficients(m.hooke) for n, m in MATERIALS.items()}
    terms = [
        coefficients[n][q] * wound.stiffness_term(n, q)
        for n in wound.mesh.regions
        for q in range(len(HOOKE_ENTRIES))
    ]
    _close(wound.stiffness_matrix(MATERIALS), sum(terms[1:], terms[0]))
    masses = [MATERIALS[n].density * wound.mass_term(n) for n in wound.mesh.regions]
    _close(wound.mass_matrix(MATERIALS), sum(masses[1:], masses[0]))


def test_matrices_are_symmetric_and_definite_as_physics_wants(wound):
    K, M = wound.stiffness_matrix(MATERIALS), wound.mass_matrix(MATERIALS)
    _close(K, K.T)
    _close(M, M.T)
    assert np.linalg.eigvalsh(M.toarray())[0] > 0
    energies = np.linalg.eigvalsh(K.toarray())
    # half a pitch on its own is free: six motions without energy, and not one more
    assert np.count_nonzero(energies < 1e-9 * energies[-1]) == 6


def test_rigid_bodies_store_no_energy_and_carry_the_right_inertia():
    half = ring_mesh(120.0, 60.0, 40.0, radial=2, axial=2)
    mesh, _, _ = half.full()
    K, M = assemble_whole(mesh, {"lamination": Material(ORTHOTROPIC.hooke(), 7810.5)})
    rigid = rigid_bodies(mesh.nodes - [0, 0, 0.02])
    assert np.abs(rigid @ (K @ rigid.T)).max() < 1e-12 * abs(K).max()
    R, r, length = 0.06, 0.03, 0.04
    mass = 7810.5 * np.pi * (R**2 - r**2) * length
    polar = mass * (R**2 + r**2) / 2
    across = polar / 2 + mass * length**2 / 12
    expected = np.diag([mass, mass, mass, across, across, polar])
    np.testing.assert_allclose(rigid @ (M @ rigid.T), expected, rtol=3e-6, atol=1e-12 * mass)


def test_each_region_keeps_its_own_mass(wound):
    mesh, _, _ = wound.mesh.full()
    up = rigid_bodies(wound.mesh.nodes)[2]
    for name, volume in region_volumes(mesh).items():
        assert wound.volumes[name] == pytest.approx(volume, rel=1e-12)
        # a translation along the axis has the same components everywhere
        half = up @ (wound.mass_term(name) @ up)
        assert 2 * wound.mesh.slots * half == pytest.approx(volume, rel=1e-12)


def test_the_meshed_volume_tends_to_the_exact_one():
    exact = np.pi * (0.06**2 - 0.03**2) * 0.04
    coarse, fine = (
        assemble(ring_mesh(120.0, 60.0, 40.0, radial=1, axial=1, sectors=6, tangential=n)).volumes[
            "lamination"
        ]
        for n in (1, 2)
    )
    assert coarse == pytest.approx(exact, rel=1e-3)
    # the area under quadratic arcs errs by h⁴
    assert (fine - exact) / (coarse - exact) == pytest.approx(1 / 16, rel=0.1)


def test_half_a_pitch_of_the_whole_matrix_is_the_model(wound):
    whole, source, copy = wound.mesh.full()
    K, M = assemble_whole(whole, MATERIALS)
    first = np.flatnonzero(copy == 0)
    rng = np.random.default_rng(5)
    inner = np.ones(len(wound.mesh.nodes), dtype=bool)
    inner[wound.mesh.tooth_plane] = inner[wound.mesh.slot_plane] = False
    first = first[inner[source[first]]]
    x = np.zeros((len(whole.nodes), 3))
    x[first] = rng.standard_normal((len(first), 3))
    y = np.zeros((len(wound.mesh.nodes), 3))
    y[source[first]] = x[first]
    for a, b in ((K, wound.stiffness_matrix(MATERIALS)), (M, wound.mass_matrix(MATERIALS))):
        assert x.ravel() @ (a @ x.ravel()) == pytest.approx(y.ravel() @ (b @ y.ravel()), rel=1e-12)


def test_coefficients_are_the_nine_entries_of_an_orthotropic_material():
    matrix = ORTHOTROPIC.hooke().matrix
    rebuilt = np.zeros((6, 6))
    for value, (i, j) in zip(hooke_coefficients(ORTHOTROPIC.hooke()), HOOKE_ENTRIES, strict=True):
        rebuilt[i, j] = rebuilt[j, i] = value
    np.testing.assert_array_equal(rebuilt, matrix)


def test_a_material_without_the_stators_mirror_symmetry_is_refused():
    inclined = Isotropic(187e9, 0.3).hooke().matrix.copy()
    inclined[0, 5] = inclined[5, 0] = 1e9
    with pytest.raises(MaterialError, match="orthotropic with its axes along r, θ and z"):
        hooke_coefficients(Hooke(inclined))


def test_the_size_counts_three_components_per_node(wound):
    assert wound.size == 3 * len(wound.mesh.nodes)
    assert wound.stiffness_matrix(MATERIALS).shape == (wound.size, wound.size)
