import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from small_stators import cylindrical, stator_mesh

from statorhom.errors import SupportError
from statorhom.mesh import graded
from statorhom.model.end_faces import EndFaces, face_stiffness, held_spaces
from statorhom.model.harmonic import harmonic_spaces
from statorhom.model.supports import support_on
from statorhom.model.surface import surface_points
from statorhom.model.surface_grid import sampling_grid, surface_grid
from statorhom.study.supports import FaceSupport, LineSupport

RADIUS, LENGTH = 0.06, 0.08


def lines(*angles_deg, **keys):
    keys = {"declared": "elastic" if keys else "rigid"} | keys
    return LineSupport.model_validate({"name": "prism", "kind": "lines", "angles_deg": angles_deg} | keys)


def arcs(*arcs_deg, **keys):
    keys = {"declared": "elastic" if keys else "rigid"} | keys
    return FaceSupport.model_validate({"name": "shoe", "kind": "faces", "arcs_deg": arcs_deg} | keys)


@pytest.fixture(scope="module")
def mesh():
    return stator_mesh(6, density=graded(1))


def energy(points, field):
    """Twice the springs' energy in a Cartesian field, a function of positions."""
    position = np.column_stack([RADIUS * np.cos(points.angles), RADIUS * np.sin(points.angles), points.z])
    motion = cylindrical(position, field(position))
    return motion @ (points.stiffness @ motion)


def radial(position):
    return position * [1.0, 1.0, 0.0] / RADIUS


def sideways(position):
    return np.broadcast_to([1.0, 0.0, 0.0], position.shape)


def upright(position):
    return np.broadcast_to([0.0, 1.0, 0.0], position.shape)


def axial(position):
    return np.broadcast_to([0.0, 0.0, 1.0], position.shape)


def stretched(position):
    return axial(position) * position[:, 2:] ** 2


def test_the_grid_holds_every_corner_of_the_whole_surface(mesh):
    grid = surface_grid(mesh)
    whole, _, _ = mesh.full()
    corners = whole.nodes[np.unique(whole.elements[:, :8])]
    corners = corners[np.abs(np.hypot(*corners[:, :2].T) - RADIUS) < 1e-9]
    angles = np.unique(np.round(np.mod(np.arctan2(corners[:, 1], corners[:, 0]) + 1e-9, 2 * np.pi), 8))
    np.testing.assert_allclose(grid.angles, angles, atol=2e-8)
    np.testing.assert_allclose(grid.levels, np.unique(np.round(corners[:, 2], 9)))
    assert grid.radius == pytest.approx(RADIUS)


def test_rigid_lines_hold_every_level_of_every_line(mesh):
    support = support_on(mesh, lines(158.0, 202.0))
    assert support.ends is None
    assert support.points.stiffness is None
    on = np.abs(np.hypot(*mesh.nodes[:, :2].T) - RADIUS) < 1e-9
    levels = np.unique(np.round(mesh.nodes[on, 2], 9))
    assert len(support.points) == 2 * len(levels)
    np.testing.assert_allclose(np.unique(support.points.angles), np.deg2rad([158.0, 202.0]))
    for angle in (158.0, 202.0):
        z = np.sort(support.points.z[np.isclose(support.points.angles, np.deg2rad(angle))])
        np.testing.assert_allclose(z, levels, atol=1e-9)


def test_lines_that_rounding_parts_are_one(mesh):
    assert len(support_on(mesh, lines(30.0, 390.0 + 1e-9)).points) == len(
        support_on(mesh, lines(30.0)).points
    )


def test_springs_along_lines_store_what_the_integral_says(mesh):
    keys = {"normal_stiffness_n_per_m2": 3e8, "tangential_ratio": 0.25}
    points = support_on(mesh, lines(0.0, 17.3, 90.0, **keys)).points
    angles = np.deg2rad([0.0, 17.3, 90.0])
    assert energy(points, radial) == pytest.approx(3 * 3e8 * LENGTH)
    assert energy(points, axial) == pytest.approx(3 * 0.25 * 3e8 * LENGTH)
    directions = np.cos(angles) ** 2 + 0.25 * np.sin(angles) ** 2
    assert energy(points, sideways) == pytest.approx(3e8 * LENGTH * directions.sum())
    # quadratic fields are integrated exactly
    assert energy(points, stretched) == pytest.approx(3 * 0.25 * 3e8 * LENGTH**5 / 5)


@pytest.mark.parametrize("arc", [(10.0, 80.0), (-35.0, 20.0), (340.0, 395.0), (100.0, 101.0), (0.0, 360.0)])
def test_springs_on_an_arc_store_what_the_integral_says(mesh, arc):
    keys = {"normal_stiffness_n_per_m3": 2e10, "tangential_ratio": 0.3}
    points = support_on(mesh, arcs(arc, **keys)).points
    start, end = np.deg2rad(arc)
    assert energy(points, axial) == pytest.approx(0.3 * 2e10 * RADIUS * LENGTH * (end - start))
    # a uniform radial motion is not exactly the elements'
    assert energy(points, radial) == pytest.approx(2e10 * RADIUS * LENGTH * (end - start), rel=1e-4)
    cosine_squared = (end - start) / 2 + (np.sin(2 * end) - np.sin(2 * start)) / 4
    expected = 2e10 * RADIUS * LENGTH * (0.7 * cosine_squared + 0.3 * (end - start))
    assert energy(points, sideways) == pytest.approx(expected, rel=1e-6)
    assert energy(points, stretched) == pytest.approx(0.3 * 2e10 * RADIUS * (end - start) * LENGTH**5 / 5)


@settings(deadline=None, max_examples=30)
@given(start=st.floats(-400, 400), width=st.floats(0.5, 360))
def test_springs_on_any_arc_are_those_of_its_area(start, width):
    mesh = _SMALL
    keys = {"normal_stiffness_n_per_m3": 1e10}
    points = support_on(mesh, arcs((start, start + width), **keys)).points
    area = RADIUS * LENGTH * np.deg2rad(width)
    assert energy(points, sideways) + energy(points, upright) == pytest.approx(2e10 * area, rel=1e-6)
    assert energy(points, axial) == pytest.approx(1e10 * area, rel=1e-6)
    difference = points.stiffness - points.stiffness.T
    assert abs(difference).max() < 1e-9 * abs(points.stiffness).max()


_SMALL = stator_mesh(4)


def test_arcs_that_overlap_add_their_springs(mesh):
    keys = {"normal_stiffness_n_per_m3": 1e10}
    points = support_on(mesh, arcs((0.0, 40.0), (30.0, 70.0), **keys)).points
    assert energy(points, axial) == pytest.approx(1e10 * RADIUS * LENGTH * np.deg2rad(80.0))


def test_a_rigid_arc_holds_the_nodes_within_and_its_ends(mesh):
    points = support_on(mesh, arcs((-17.0, 33.0))).points
    whole, _, _ = mesh.full()
    angle = np.rad2deg(np.arctan2(whole.nodes[:, 1], whole.nodes[:, 0]))
    on = np.abs(np.hypot(*whole.nodes[:, :2].T) - RADIUS) < 1e-9
    inside = on & (angle > -17.0) & (angle < 33.0)
    held = np.mod(np.rad2deg(points.angles) + 180.0, 360.0) - 180.0
    ends = np.isclose(held, -17.0) | np.isclose(held, 33.0)
    assert ends.sum() == 2 * len(surface_grid(mesh).node_levels)
    ours = np.column_stack([held, points.z])[~ends]
    theirs = np.column_stack([angle, whole.nodes[:, 2]])[inside]
    assert len(ours) == len(theirs)
    for one, other in zip(_sorted(ours), _sorted(theirs), strict=True):
        np.testing.assert_allclose(one, other, atol=1e-5)


def _sorted(table):
    table = np.round(table, 6) + 0.0
    return table[np.lexsort(table.T)]


def test_an_arc_within_one_cell_still_holds_its_ends(mesh):
    points = support_on(mesh, arcs((1.0, 1.5))).points
    np.testing.assert_allclose(np.unique(points.angles), np.deg2rad([1.0, 1.5]))


def test_a_whole_turn_has_every_node_once(mesh):
    points = support_on(mesh, arcs((0.0, 360.0))).points
    whole, _, _ = mesh.full()
    on = np.abs(np.hypot(*whole.nodes[:, :2].T) - RADIUS) < 1e-9
    assert len(points) == on.sum()


@pytest.mark.parametrize(
    ("keys", "name"),
    [
        (lines(10.0, declared="elastic"), "normal_stiffness_n_per_m2"),
        (arcs((10.0, 20.0), declared="elastic"), "normal_stiffness_n_per_m3"),
    ],
)
def test_elastic_without_stiffness_names_the_support_and_the_key(mesh, keys, name):
    with pytest.raises(SupportError) as caught:
        support_on(mesh, keys)
    message = str(caught.value)
    assert keys.name in message
    assert name in message
    assert "\n" not in message


def test_springs_on_the_ends_store_what_the_integral_says(mesh):
    both = EndFaces(True, True, np.array([2e10, 1e10, 1e10]))
    lower = EndFaces(True, False, both.stiffness)
    area = _core_area(mesh)
    for ends, count in ((both, 2), (lower, 1)):
        K = face_stiffness(mesh, ends)
        for direction, stiffness in ((axial, 2e10), (sideways, 1e10)):
            motion = cylindrical(mesh.nodes, direction(mesh.nodes))
            assert motion @ (K @ motion) == pytest.approx(count * stiffness * area)
    assert face_stiffness(mesh, EndFaces(True, True, None)).nnz == 0


def _core_area(mesh):
    """Area of the half pitch's lamination by the divergence theorem on its own elements' faces."""
    quads = mesh.elements_of("lamination")
    bottom = quads[np.abs(mesh.nodes[quads[:, :4], 2]).max(axis=1) < 1e-12]
    area = 0.0
    x, w = np.polynomial.legendre.leggauss(4)
    for nodes in bottom:
        for a, m, b in ((0, 8, 1), (1, 9, 2), (2, 10, 3), (3, 11, 0)):
            first, middle, last = mesh.nodes[nodes[[a, m, b]], :2]
            for s, weight in zip(x, w, strict=True):
                point = first * s * (s - 1) / 2 + middle * (1 - s * s) + last * s * (s + 1) / 2
                tangent = first * (s - 0.5) - middle * 2 * s + last * (s + 0.5)
                area += weight * (point[0] * tangent[1] - point[1] * tangent[0]) / 2
    return area


@pytest.mark.parametrize("order", [0, 1, 3])
@pytest.mark.parametrize("sides", [(True, False), (False, True), (True, True)])
def test_held_ends_leave_every_other_degree_of_freedom(mesh, order, sides):
    free = sum(space.size for space in harmonic_spaces(mesh, order))
    held = held_spaces(mesh, order, EndFaces(*sides, None))
    quads = mesh.elements_of("lamination")
    for side, height in zip(sides, (0.0, LENGTH), strict=True):
        nodes = np.unique(quads[np.abs(mesh.nodes[quads, 2] - height) < 1e-12])
        for space in held:
            moved = space.expand(np.random.default_rng(0).standard_normal(space.size)).reshape(-1, 3)[nodes]
            assert (np.abs(moved).max() < 1e-14) == side
        whole = np.isin(nodes, np.concatenate([mesh.tooth_plane, mesh.slot_plane]))
        pair = 0 < 2 * order < mesh.slots
        # inner nodes carry a real and an imaginary part in a pair; over both singlets that is the same number
        free -= side * (3 * (2 * (~whole).sum() + whole.sum()) if pair or order in (0, 3) else 0)
    assert sum(space.size for space in held) == free
    assert {space.axial for space in held} == ({None} if sum(sides) == 1 else {"even", "odd"})


def test_accelerometers_lie_on_the_core(mesh):
    grid = sampling_grid(mesh, angles=36, planes=5)
    assert len(grid.points) == 180
    assert grid.planes[0] == pytest.approx(0.02 * LENGTH)
    assert grid.planes[-1] == pytest.approx(0.98 * LENGTH)
    again = surface_points(mesh, np.tile(grid.angles, 5), np.repeat(grid.planes, 36))
    assert abs(again.matrix - grid.points.matrix).max() == 0.0
