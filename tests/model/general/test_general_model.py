import json
from pathlib import Path

import numpy as np
import pytest
from boxes import box_mesh
from small_stators import MATERIALS, ORTHOTROPIC, STACK, assemble_whole, rigid_bodies, stator_mesh

from statorhom.errors import MaterialError, SolverError
from statorhom.geometry import stator_geometry
from statorhom.materials.hooke import Hooke
from statorhom.materials.symmetry import SYMMETRIES
from statorhom.mesh import mesh_step, uniform
from statorhom.mesh.hex_mesh import HexMesh
from statorhom.model.affine import Material, assemble
from statorhom.model.free_modes import solve_free
from statorhom.model.general.general_model import general_model, whole_ring
from statorhom.study.geometry_file import read_geometry

ROOT = Path(__file__).resolve().parents[3]
TOP_HZ = 5500.0


@pytest.fixture(scope="module")
def half():
    return stator_mesh(6, ("stack", "wound"))


@pytest.fixture(scope="module")
def ring(half):
    return whole_ring(half)


def _close(ours, theirs, tolerance=1e-13):
    assert abs(ours - theirs).max() <= tolerance * abs(theirs).max()


def test_the_whole_ring_has_the_cyclic_models_modes_doublets_twice(half, ring):
    free = solve_free(assemble(half), MATERIALS, TOP_HZ)
    expected = np.sort(np.repeat([m.frequency_hz for m in free.modes], [m.multiplicity for m in free.modes]))
    modes = ring.solve(TOP_HZ, MATERIALS)
    assert len(expected) > 15
    # a body without mass-less parts has six rigid motions
    assert np.all(modes.frequencies_hz[:6] < 1e-3 * expected[0])
    np.testing.assert_allclose(modes.frequencies_hz[6:], expected, rtol=1e-7)
    K, M = ring.stiffness_matrix(MATERIALS), ring.mass_matrix(MATERIALS)
    v = modes.vectors
    np.testing.assert_allclose(v.T @ (M @ v), np.eye(v.shape[1]), atol=1e-9)
    np.testing.assert_allclose(v.T @ (K @ v), np.diag(modes.eigenvalues), atol=1e-8 * modes.eigenvalues[-1])


def test_copied_element_matrices_are_those_of_the_elements_themselves(ring):
    K, M = assemble_whole(ring.mesh, MATERIALS)
    for model in (ring, general_model(ring.mesh)):
        _close(model.stiffness_matrix(MATERIALS), K)
        _close(model.mass_matrix(MATERIALS), M)


def test_rigid_bodies_store_no_energy(ring):
    rigid = rigid_bodies(ring.mesh.nodes)
    K = ring.stiffness_matrix(MATERIALS)
    assert np.abs(K @ rigid.T).max() < 1e-11 * abs(K).max()


def test_the_scale_of_elements_is_that_of_their_hooke_matrix(ring):
    doubled = MATERIALS | {"winding": Material(Hooke(2 * MATERIALS["winding"].hooke.matrix), 1.0)}
    winding = ring.mesh.region == ring.mesh.regions.index("winding")
    _close(
        ring.stiffness_matrix(MATERIALS, np.where(winding, 2.0, 1.0)), ring.stiffness_matrix(doubled), 1e-14
    )


def test_stiffness_is_the_sum_of_its_elements(ring):
    rng = np.random.default_rng(8)
    scale = rng.uniform(0.0, 3.0, len(ring.mesh.elements))
    one = np.zeros_like(scale)
    one[17] = scale[17]
    rest = scale - one
    parts = ring.stiffness_matrix(MATERIALS, one) + ring.stiffness_matrix(MATERIALS, rest)
    _close(parts, ring.stiffness_matrix(MATERIALS, scale))
    touched = np.unique(np.nonzero(ring.stiffness_matrix(MATERIALS, one).toarray())[0] // 3)
    np.testing.assert_array_equal(touched, np.sort(ring.mesh.elements[17]))


def test_a_strip_of_its_own_material(half, ring):
    angle = np.arctan2(*ring.mesh.nodes[ring.mesh.elements[:, :8]].mean(axis=1)[:, 1::-1].T)
    strip = (np.abs(angle - 1.0) < 0.3) & (ring.mesh.region == 0)
    assert 0 < np.count_nonzero(strip) < len(half.elements)
    heavy = Material(Hooke(0.5 * STACK.hooke.matrix), 3 * STACK.density)
    model, materials = ring.with_region("strip", strip), MATERIALS | {"strip": heavy}
    _close(
        model.stiffness_matrix(materials), ring.stiffness_matrix(MATERIALS, np.where(strip, 0.5, 1.0)), 1e-14
    )
    K, M = assemble_whole(model.mesh, materials)
    _close(model.stiffness_matrix(materials), K)
    _close(model.mass_matrix(materials), M)
    # the original is as it was, and a region that lost all its elements needs no material
    assert "strip" not in ring.mesh.regions
    renamed = ring.with_region("core", ring.mesh.region == 0)
    left = {"core": STACK, "winding": MATERIALS["winding"], "overhang": MATERIALS["overhang"]}
    _close(renamed.mass_matrix(left), ring.mass_matrix(MATERIALS), 1e-14)


def test_elements_go_back_to_an_existing_region(ring):
    again = ring.with_region("strip", np.array([3, 5])).with_region("lamination", np.array([3, 5]))
    np.testing.assert_array_equal(again.mesh.region[[3, 5]], 0)
    assert again.mesh.regions.count("lamination") == 1


@pytest.mark.parametrize("wrong", [np.ones(5), -1.0, np.nan, np.inf])
def test_a_scale_that_no_material_has_is_refused(ring, wrong):
    scale = np.ones(len(ring.mesh.elements))
    if np.ndim(wrong):
        scale = wrong
    else:
        scale[2] = wrong
    with pytest.raises(MaterialError, match="element_scale: needs one number ≥ 0 for each of the"):
        ring.stiffness_matrix(MATERIALS, scale)


def test_a_node_without_an_element_is_refused():
    box = box_mesh((0.1, 0.1, 0.1), (1, 1, 1))
    nodes = np.vstack([box.nodes, [1.0, 1.0, 1.0]])
    with pytest.raises(SolverError, match="nodes that belong to no element"):
        general_model(HexMesh(nodes, box.elements, box.region, box.regions))


def test_a_material_that_gives_energy_away_is_refused():
    model = general_model(box_mesh((0.1, 0.1, 0.1), (1, 1, 1)))
    with pytest.raises(SolverError, match="not positive definite; check materials"):
        model.solve(1e4, {"box": Material(Hooke(-ORTHOTROPIC.hooke().matrix), 7800.0)})


@pytest.mark.slow
def test_the_papers_stack_has_calculixs_frequencies():
    file = ROOT / "benchmarks" / "figures" / "calculix_stack_26k_transversely_isotropic.json"
    figures = json.loads(file.read_text())
    path = ROOT / "geometries" / figures["geometry"]
    model = whole_ring(mesh_step(stator_geometry(read_geometry(path), path).step(("stack",)), uniform(1)))
    core = Material(
        SYMMETRIES[figures["material"]](**figures["constants"]).hooke(), figures["density_kg_per_m3"]
    )
    theirs = np.array(figures["frequencies_hz"])
    ours = model.solve(1.0001 * theirs[-1], {"lamination": core}).frequencies_hz[6:]
    np.testing.assert_allclose(ours[: len(theirs)], theirs, rtol=5e-7)
