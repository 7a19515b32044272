import numpy as np
import pytest
import skfem
from skfem.helpers import dot, sym_grad
from small_stators import ORTHOTROPIC, assemble_whole, ring_mesh, stator_mesh

from statorhom.errors import SolverError
from statorhom.materials.isotropic import Isotropic
from statorhom.materials.rotation import cylinder_axes, rotate
from statorhom.mesh.hex_mesh import HexMesh
from statorhom.model import assembly
from statorhom.model.affine import Material
from statorhom.model.assembly import (
    CHUNK,
    block_pattern,
    element_geometry,
    region_volumes,
    stiffness_blocks,
    strain_matrix,
)
from statorhom.model.element import REFERENCE_NODES, gauss_table

_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 5), (2, 6), (3, 7), (4, 5), (5, 6), (6, 7), (7, 4)]
_DENSITY = 7810.5


@skfem.BilinearForm
def _mass(u, v, _):
    return _DENSITY * dot(u, v)


@skfem.BilinearForm
def _isotropic(u, v, w):
    strain, virtual = sym_grad(u), sym_grad(v)
    trace = strain[0, 0] + strain[1, 1] + strain[2, 2]
    double = np.einsum("ij...,ij...", strain, virtual)
    return w.lame * trace * (virtual[0, 0] + virtual[1, 1] + virtual[2, 2]) + 2 * w.shear * double


@skfem.BilinearForm
def _orthotropic(u, v, w):
    stress = np.einsum("jk...,k...->j...", w.hooke, _voigt(sym_grad(u)))
    return np.einsum("j...,j...", _voigt(sym_grad(v)), stress)


def _voigt(strain):
    pairs = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
    return np.stack([strain[i, j] * (1 if i == j else 2) for i, j in pairs])


@pytest.fixture(scope="module")
def straight():
    """A wide toothed sector with straight edges: the one mesh that both programs describe alike."""
    mesh = stator_mesh(6)
    nodes = mesh.nodes.copy()
    for k, (a, b) in enumerate(_EDGES):
        nodes[mesh.elements[:, 8 + k]] = (nodes[mesh.elements[:, a]] + nodes[mesh.elements[:, b]]) / 2
    return HexMesh(nodes, mesh.elements, mesh.region, mesh.regions)


@pytest.fixture(scope="module")
def reference(straight):
    """scikit-fem's basis, and the matrix from our cylindrical components to its Cartesian ones."""
    corners = np.unique(straight.elements[:, :8])
    place = skfem.MeshHex.init_refdom().p.T
    ours = [int(np.abs(REFERENCE_NODES - p).sum(axis=1).argmin()) for p in place]
    cells = np.searchsorted(corners, straight.elements[:, ours])
    mesh = skfem.MeshHex(straight.nodes[corners].T, cells.T)
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementHexS2()), intorder=5)
    distance = np.linalg.norm(basis.doflocs.T[:, None] - straight.nodes[None], axis=2)
    node = distance.argmin(axis=1)
    assert distance.min(axis=1).max() < 1e-12
    component = np.zeros(basis.N, dtype=int)
    for c in range(3):
        component[basis.get_dofs(elements=True).all([f"u^{c + 1}"])] = c
    axes = cylinder_axes(np.arctan2(straight.nodes[:, 1], straight.nodes[:, 0]))
    turn = np.zeros((basis.N, 3 * len(straight.nodes)))
    for c in range(3):
        turn[np.arange(basis.N), 3 * node + c] = axes[node, component, c]
    return basis, turn


def _agree(ours, form, reference, **values):
    basis, turn = reference
    theirs = turn.T @ (form.assemble(basis, **values) @ turn)
    np.testing.assert_allclose(ours.toarray(), theirs, atol=1e-12 * np.abs(theirs).max())


def test_isotropic_stiffness_and_mass_are_scikit_fems(straight, reference):
    steel = Isotropic(187e9, 0.3)
    K, M = assemble_whole(straight, {"lamination": Material(steel.hooke(), _DENSITY)})
    _agree(K, _isotropic, reference, lame=steel.lame_pa, shear=steel.shear_modulus_pa)
    _agree(M, _mass, reference)


def test_cylindrically_orthotropic_stiffness_is_scikit_fems(straight, reference):
    K, _ = assemble_whole(straight, {"lamination": Material(ORTHOTROPIC.hooke(), _DENSITY)})
    x, y, _ = reference[0].global_coordinates()
    turned = rotate(ORTHOTROPIC.hooke().matrix, cylinder_axes(np.arctan2(y, x)))
    _agree(K, _orthotropic, reference, hooke=np.moveaxis(turned, (2, 3), (0, 1)))


def test_the_pattern_adds_every_block_where_it_belongs():
    rng = np.random.default_rng(3)
    elements = np.array([rng.permutation(30)[:20] for _ in range(4)])
    pattern = block_pattern(elements, 30)
    blocks = rng.standard_normal((4, 20, 20, 3, 3))
    dense = np.zeros((30, 30, 3, 3))
    for element, block in zip(elements, blocks, strict=True):
        np.add.at(dense, (element[:, None], element[None, :]), block)
    matrix = pattern.matrix(pattern.gather(blocks.reshape(-1, 3, 3)))
    np.testing.assert_allclose(matrix.toarray(), dense.transpose(0, 2, 1, 3).reshape(90, 90), atol=1e-13)
    assert len(pattern.indices) == np.count_nonzero(dense[..., 0, 0])


@pytest.mark.parametrize("places", [1, 7, 10_000])
def test_shared_blocks_add_up_whatever_the_size_of_a_portion(monkeypatch, places):
    monkeypatch.setattr(assembly, "PLACES", places)
    rng = np.random.default_rng(4)
    elements = np.array([rng.permutation(26)[:20] for _ in range(3)])
    pattern = block_pattern(elements, 26)
    blocks, owner = rng.standard_normal((2, 20, 20, 3, 3)), np.array([1, 0, 1])
    scale = np.array([0.5, 2.0, 3.0])
    own = blocks[owner] * scale[:, None, None, None, None]
    expected = pattern.gather(own.reshape(-1, 3, 3))
    np.testing.assert_allclose(pattern.gather_shared(blocks, owner, scale), expected, atol=1e-14)


def test_the_strain_of_a_uniform_deformation_is_that_deformation():
    mesh = ring_mesh(120.0, 60.0, 40.0, radial=1, axial=1, sectors=5)
    gradient = np.random.default_rng(4).standard_normal((3, 3))
    nodes = mesh.nodes[mesh.elements]
    g = element_geometry(nodes, gauss_table())
    axes = cylinder_axes(np.arctan2(nodes[..., 1], nodes[..., 0]))
    motion = np.einsum("eaji,ejk,eak->eai", axes, np.broadcast_to(gradient, (len(nodes), 3, 3)), nodes)
    strain = np.einsum("eqsd,ed->eqs", strain_matrix(g), motion.reshape(len(nodes), 60))
    position = np.einsum("qa,eai->eqi", gauss_table().values, nodes)
    local = cylinder_axes(np.arctan2(position[..., 1], position[..., 0]))
    tensor = np.swapaxes(local, -1, -2) @ ((gradient + gradient.T) / 2) @ local
    np.testing.assert_allclose(
        strain, np.moveaxis(_voigt(np.moveaxis(tensor, (2, 3), (0, 1))), 0, -1), atol=1e-12
    )


def test_turning_elements_about_the_axis_changes_no_number():
    mesh = stator_mesh(7)
    nodes = mesh.nodes[mesh.elements[:3]]
    still = list(stiffness_blocks(element_geometry(nodes, gauss_table())))
    for turn in (1.0, 2.5, -3.1):
        turned = stiffness_blocks(element_geometry(nodes @ cylinder_axes(turn).T, gauss_table()))
        for a, b in zip(still, turned, strict=True):
            np.testing.assert_allclose(b, a, atol=1e-12 * np.abs(a).max())


def test_volumes_do_not_depend_on_the_size_of_a_chunk():
    mesh = ring_mesh(120.0, 60.0, 40.0, radial=8, axial=12, tangential=4, sectors=6)
    assert len(mesh.elements) > CHUNK
    whole = region_volumes(mesh)["lamination"] * 12
    assert whole == pytest.approx(np.pi * (0.06**2 - 0.03**2) * 0.04, rel=1e-6)


def test_an_element_turned_inside_out_is_refused():
    nodes = REFERENCE_NODES * [1, 1, -1] + [2, 0, 0]
    with pytest.raises(SolverError, match="inside out; check the geometry"):
        element_geometry(nodes[None], gauss_table())
