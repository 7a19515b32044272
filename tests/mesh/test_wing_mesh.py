"""Half a wing's 20-node bricks."""

import numpy as np
import pytest

from example_wings import FLYING_WING
from statorhom.mesh.wing import wing_mesh
from statorhom.model.assembly import element_geometry
from statorhom.model.element import gauss_table
from statorhom.model.frames import cartesian


@pytest.fixture(scope="module")
def mesh():
    return wing_mesh(FLYING_WING)


def test_no_brick_is_turned_inside_out_and_all_volume_is_there(mesh):
    geometry = element_geometry(mesh.nodes[mesh.elements], gauss_table(), cartesian)
    volumes = FLYING_WING.exact_volumes()
    for i, region in enumerate(mesh.regions):
        found = 2.0 * geometry.volume[mesh.region == i].sum()
        assert found == pytest.approx(volumes[region], rel=1e-4)


def test_every_node_is_used_once(mesh):
    assert np.array_equal(np.unique(mesh.elements), np.arange(len(mesh.nodes)))
    rounded = np.round(mesh.nodes, 9)
    assert len(np.unique(rounded, axis=0)) == len(rounded)


def test_the_middle_is_the_plane_of_symmetry(mesh):
    assert mesh.nodes[:, 1].min() == 0.0
    assert mesh.on_plane(0).sum() > 20
    whole, _, mirrored = mesh.full()
    assert whole.nodes[:, 1].min() == pytest.approx(-0.95)
    assert len(whole.elements) == 2 * len(mesh.elements)
    assert mirrored.any()


def test_accelerometers_are_on_the_upper_face(mesh):
    x, y, z = mesh.nodes[mesh.upper].T
    expected = FLYING_WING.plan.height(x, y) / 2
    np.testing.assert_allclose(z, expected, atol=1e-9)
    assert y.max() == pytest.approx(0.95)


def test_refining_changes_the_cells_along_chord_and_span_alone(mesh):
    fine = wing_mesh(FLYING_WING, 1.5)
    assert len(fine.elements) > 1.5 * len(mesh.elements)
    assert np.abs(fine.nodes).max(axis=0) == pytest.approx(np.abs(mesh.nodes).max(axis=0))
