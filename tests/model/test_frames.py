import numpy as np
import pytest
from boxes import box_mesh
from small_stators import cylindrical as components

from statorhom.materials.isotropic import Isotropic
from statorhom.model.assembly import elastic_blocks, element_geometry, mass_blocks
from statorhom.model.element import gauss_table
from statorhom.model.frames import cartesian, cylindrical


def test_along_the_x_axis_both_frames_are_the_same():
    x = np.array([[1.0, 0.0, 2.0], [3.0, 0.0, -1.0]])
    np.testing.assert_array_equal(cartesian(x), cylindrical(x))
    assert cylindrical(np.array([0.0, 2.0, 5.0])) == pytest.approx(np.pi / 2)
    assert cartesian(np.ones((4, 5, 3))).shape == (4, 5)


def test_an_isotropic_element_stores_the_same_energy_in_both_frames():
    mesh = box_mesh((0.03, 0.02, 0.01), (1, 1, 1))
    nodes = (mesh.nodes + np.array([0.01, -0.02, 0.3]))[mesh.elements]
    table, hooke = gauss_table(), Isotropic(187e9, 0.3).hooke().matrix
    motion = np.random.default_rng(9).standard_normal((20, 3))
    cart, cyl = (element_geometry(nodes, table, frame) for frame in (cartesian, cylindrical))
    x, y = motion.ravel(), components(nodes[0], motion)
    assert not np.allclose(x, y)
    for matrices in (lambda g: elastic_blocks(g, hooke)[0], lambda g: mass_blocks(g, table.values)[0]):
        assert y @ matrices(cyl) @ y == pytest.approx(x @ matrices(cart) @ x, rel=1e-12)
