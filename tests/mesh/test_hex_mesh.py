import numpy as np
import pytest
from hexahedra import EDGES, faces, volumes
from scipy.spatial import cKDTree

from example_stators import EVERY_STEP, SLOTS, STEPS, stator
from statorhom.mesh import HexMesh, graded, mesh_step, uniform

# a third of the paper's slots, three times as wide
FEWER = {name: slots for name, slots in SLOTS.items() if slots["count"] < 36}
FEWER |= {
    name: {
        key: value // 3 if key == "count" else 3 * value if key.endswith("width_mm") else value
        for key, value in slots.items()
    }
    for name, slots in SLOTS.items()
    if slots["count"] == 36
}
COARSE = graded(1.0, core=1, radial=1, yoke=1, overhang=1, frame_end=1)


def full_mesh(name, kinds):
    half = mesh_step(stator(FEWER[name]).step(kinds), COARSE)
    return half, *half.full()


def test_the_coarsest_mesh_of_the_papers_stack_has_its_degrees_of_freedom():
    assert mesh_step(stator().step(("stack",)), uniform()).full_dof == 26568


@pytest.mark.parametrize(("name", "kinds"), EVERY_STEP)
def test_the_whole_mesh_is_conforming_and_closed(name, kinds):
    half, mesh, _, _ = full_mesh(name, kinds)
    assert 3 * len(mesh.nodes) == half.full_dof
    assert np.array_equal(np.unique(mesh.elements), np.arange(len(mesh.nodes)))
    # no two nodes at one place
    assert len(cKDTree(mesh.nodes).query_pairs(1e-7)) == 0
    every, count = np.unique(faces(mesh.elements), axis=0, return_counts=True)
    assert count.max() == 2
    # the boundary has no border: each of its edges belongs to an even number of its faces
    outer = every[count == 1]
    local = np.sort(mesh.elements[:, [(a, b) for a, b in EDGES]], axis=2).reshape(-1, 2)
    middle = mesh.elements[:, 8:].ravel()
    corners_of = dict(zip(middle.tolist(), map(tuple, local.tolist()), strict=True))
    edges, shared = np.unique(outer[np.isin(outer, middle)], return_counts=True)
    assert set(edges.tolist()) <= corners_of.keys()
    assert np.all(shared % 2 == 0)
    # no cell is missing or inside out
    assert volumes(mesh.nodes, mesh.elements).sum() == pytest.approx(
        2 * half.slots * volumes(half.nodes, half.elements).sum(), rel=1e-12
    )


@pytest.mark.parametrize(("name", "kinds"), EVERY_STEP)
def test_every_mid_side_node_belongs_to_one_edge(name, kinds):
    _, mesh, _, _ = full_mesh(name, kinds)
    ends = np.sort(mesh.elements[:, [(a, b) for a, b in EDGES]], axis=2).reshape(-1, 2)
    pairs = np.unique(np.column_stack([mesh.elements[:, 8:].ravel(), ends]), axis=0)
    assert len(np.unique(pairs[:, 0])) == len(pairs) == len(np.unique(pairs[:, 1:], axis=0))
    assert len(np.intersect1d(mesh.elements[:, 8:], mesh.elements[:, :8])) == 0


@pytest.mark.parametrize(("name", "kinds"), EVERY_STEP)
def test_the_whole_mesh_maps_onto_itself_under_every_symmetry(name, kinds):
    half, mesh, _, _ = full_mesh(name, kinds)
    tree, region = cKDTree(mesh.nodes), {}
    for element, number in zip(np.sort(mesh.elements, axis=1).tolist(), mesh.region.tolist(), strict=True):
        region[tuple(element)] = number
    angle = 2 * np.pi / half.slots
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    for symmetry in (turn, np.diag([1.0, -1.0, 1.0])):
        distance, image = tree.query(mesh.nodes @ symmetry.T)
        assert distance.max() < 1e-12
        assert np.array_equal(np.sort(image), np.arange(len(mesh.nodes)))
        moved = np.sort(image[mesh.elements], axis=1).tolist()
        assert [region.get(tuple(element)) for element in moved] == mesh.region.tolist()


@pytest.mark.parametrize("name", ["parallel_tooth", "few slots"])
def test_every_node_of_the_whole_knows_where_it_was_copied_from(name):
    half, mesh, source, copy = full_mesh(name, STEPS["machine"])
    x, y, z = half.nodes[source].T
    np.testing.assert_array_equal(mesh.nodes[:, 2], z)
    np.testing.assert_allclose(np.hypot(*mesh.nodes[:, :2].T), np.hypot(x, y), rtol=1e-14)
    angle = np.where(copy % 2 == 0, 1, -1) * np.arctan2(y, x) + 2 * np.pi / half.slots * (copy // 2)
    difference = np.arctan2(mesh.nodes[:, 1], mesh.nodes[:, 0]) - angle
    np.testing.assert_allclose(np.exp(1j * difference), 1.0, atol=1e-13)
    # the first half pitch comes first and as it was
    first = np.flatnonzero(copy == 0)
    np.testing.assert_allclose(mesh.nodes[first[np.argsort(source[first])]], half.nodes, atol=1e-15)


def test_copies_keep_their_orientation():
    _, mesh, _, _ = full_mesh("few slots", STEPS["wound"])
    assert volumes(mesh.nodes, mesh.elements).min() > 0


def test_neighbouring_regions_share_their_nodes():
    mesh = mesh_step(stator().step(STEPS["machine"]), COARSE)

    def shared(a, b):
        return len(np.intersect1d(mesh.elements_of(a), mesh.elements_of(b)))

    for a, b in (("lamination", "winding"), ("winding", "overhang"), ("lamination", "overhang")):
        assert shared(a, b) > 0
    assert shared("lamination", "frame") > 0 and shared("frame", "machine") > 0
    for a, b in (("lamination", "machine"), ("overhang", "machine"), ("overhang", "frame")):
        assert shared(a, b) == 0


def test_a_mesh_cannot_be_changed():
    mesh = mesh_step(stator().step(("stack",)), COARSE)
    full, _, _ = mesh.full()
    assert isinstance(full, HexMesh)
    for array in (mesh.nodes, mesh.elements, mesh.region, mesh.tooth_plane, mesh.slot_plane, full.nodes):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


def test_elements_move_to_a_region_and_back():
    mesh = mesh_step(stator().step(STEPS["wound"]), COARSE)
    some = np.array([0, 2])
    strip = mesh.with_region("strip", some)
    assert type(strip) is type(mesh)
    np.testing.assert_array_equal(strip.elements_of("strip"), mesh.elements[some])
    assert strip.regions == (*mesh.regions, "strip")
    back = strip.with_region("lamination", strip.region == strip.regions.index("strip"))
    np.testing.assert_array_equal(back.region[some], mesh.regions.index("lamination"))
    np.testing.assert_array_equal(np.delete(back.region, some), np.delete(mesh.region, some))
    assert len(back.elements_of("strip")) == 0
    assert "strip" not in mesh.regions
