import numpy as np
import pytest
from small_stators import MATERIALS, cylindrical, expand_whole, geometry, ring_mesh, stator_mesh

from statorhom.errors import SupportError
from statorhom.mesh import graded, mesh_step, uniform
from statorhom.model.affine import assemble
from statorhom.model.eigen import modes_below
from statorhom.model.harmonic import all_orders, harmonic_spaces
from statorhom.model.surface import surface_levels, surface_points, surface_radius


def _framed():
    slots = {"shape": "parallel_tooth", "count": 8, "tooth_width_mm": 8.0}
    frame = {"inner_diameter_mm": 120.0, "outer_diameter_mm": 132.0, "length_mm": 100.0, "offset_mm": -15.0}
    return mesh_step(geometry(slots, frame=frame).step(("stack", "framed")), uniform(1))


MESHES = {
    "stack": lambda: stator_mesh(6),
    "graded": lambda: stator_mesh(5, density=graded(1)),
    "framed": _framed,
}


@pytest.fixture(scope="module", params=MESHES)
def mesh(request):
    return MESHES[request.param]()


def test_at_nodes_of_the_whole_surface_the_interpolation_is_the_nodal_value(mesh):
    whole, source, copy = mesh.full()
    x, y, z = whole.nodes.T
    # mid-side nodes inside a straight chord lie beside the surface, which is meant to be round
    on = np.flatnonzero(np.abs(np.hypot(x, y) - surface_radius(mesh)) < 1e-9)
    assert len(on) > 50
    points = surface_points(mesh, np.arctan2(y, x)[on], z[on])
    assert len(points) == len(on)
    rng = np.random.default_rng(1)
    for order in all_orders(mesh.slots):
        for space in harmonic_spaces(mesh, order):
            coordinates = rng.standard_normal((space.real.shape[1], 2))
            nodal = expand_whole(space, coordinates, source, copy).reshape(-1, 3, 2)[on]
            np.testing.assert_allclose(points.evaluate(space, space.expand(coordinates)), nodal, atol=1e-7)


def test_between_nodes_translations_are_exact(mesh):
    rng = np.random.default_rng(2)
    angles = rng.uniform(0, np.pi / mesh.slots, 40)
    low, high = surface_levels(mesh)[[0, -1]]
    matrix = surface_points(mesh, angles, rng.uniform(low, high, 40)).matrix
    position = np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    for axis in np.eye(3):
        there = cylindrical(position, np.broadcast_to(axis, (40, 3)))
        everywhere = cylindrical(mesh.nodes, np.broadcast_to(axis, mesh.nodes.shape))
        np.testing.assert_allclose(matrix @ everywhere, there, atol=1e-12)


def test_between_nodes_the_error_falls_with_the_cube_of_the_element():
    angles = np.linspace(0.01, np.pi / 6 - 0.01, 60)
    errors = []
    for cells in (2, 4, 8):
        ring = ring_mesh(120.0, 90.0, 40.0, radial=1, axial=1, sectors=6, tangential=cells)
        field = np.column_stack([np.sin(40 * ring.nodes[:, 0]), ring.nodes[:, 1] ** 2, ring.nodes[:, 0]])
        x, y = 0.06 * np.cos(angles), 0.06 * np.sin(angles)
        exact = cylindrical(np.column_stack([x, y, 0 * x]), np.column_stack([np.sin(40 * x), y**2, x]))
        values = surface_points(ring, angles, np.full(60, 0.017)).matrix @ cylindrical(ring.nodes, field)
        errors.append(np.abs(values - exact).max())
    rates = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(rates > 2.7)


def test_points_a_turn_apart_are_the_same_point(mesh):
    angles, z = np.linspace(-3, 3, 17), 0.013
    first = surface_points(mesh, angles, z)
    again = surface_points(mesh, angles + 4 * np.pi, z)
    np.testing.assert_array_equal(first.pitch, again.pitch)
    np.testing.assert_array_equal(first.mirrored, again.mirrored)
    assert abs(first.matrix - again.matrix).max() < 1e-9


def test_a_single_shape_evaluates_like_a_column(mesh):
    space = harmonic_spaces(mesh, 1)[0]
    shapes = space.expand(np.random.default_rng(3).standard_normal((space.real.shape[1], 3)))
    points = surface_points(mesh, np.array([0.1, -2.0]), np.array([0.01, 0.03]))
    block = points.evaluate(space, shapes)
    assert block.shape == (2, 3, 3)
    np.testing.assert_allclose(points.evaluate(space, shapes[:, 1]), block[:, :, 1])


def test_a_known_mode_is_seen_as_its_order():
    ring = ring_mesh(120.0, 105.0, 20.0, radial=1, axial=1, sectors=12)
    model = assemble(ring)
    K, M = model.stiffness_matrix(MATERIALS), model.mass_matrix(MATERIALS)
    angles = 2 * np.pi * np.arange(24) / 24
    points = surface_points(ring, angles, 0.01)
    for order in (2, 3):
        space = harmonic_spaces(ring, order)[0]
        values, y = modes_below(space.project(K), space.project(M), 20000.0)
        first = y[:, values > 1e6][:, 0]
        radial = points.evaluate(space, space.expand(first))[:, 0].real
        spectrum = np.abs(np.fft.rfft(radial)) ** 2
        assert spectrum[order] > 0.9999 * spectrum.sum()


@pytest.mark.parametrize("z", [-0.001, 0.0801])
def test_a_point_beside_the_core_is_refused(z):
    with pytest.raises(SupportError, match=r"z = 0 … 80 mm; check the support or the measurement grid"):
        surface_points(stator_mesh(6), np.array([0.0]), np.array([z]))


def test_radius_and_levels_are_the_outermost_parts():
    stack, framed = stator_mesh(6), _framed()
    assert surface_radius(stack) == 0.06
    assert surface_radius(framed) == pytest.approx(0.066)
    np.testing.assert_allclose(surface_levels(stack), np.linspace(0, 0.08, 4))
    levels = surface_levels(framed)
    assert levels[[0, -1]] == pytest.approx([-0.015, 0.085])
    assert np.all(np.diff(levels) > 0)
