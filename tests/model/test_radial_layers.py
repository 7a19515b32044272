"""Radial layers of elements against the whole elements and the layers' own volumes."""

import numpy as np
import pytest
from small_stators import MATERIALS, ring_mesh, stator_mesh

from statorhom.materials.isotropic import Isotropic
from statorhom.model.affine import hooke_coefficients
from statorhom.model.broken.layers import radial_layers
from statorhom.model.broken.pieces import stiffness_pieces

CORE = hooke_coefficients(MATERIALS["lamination"].hooke)


@pytest.mark.parametrize("count", [1, 3])
def test_layers_make_up_their_elements(count):
    mesh = stator_mesh(6)
    whole = stiffness_pieces(mesh, {"lamination": CORE})
    layers = radial_layers(mesh, "lamination", CORE, count)
    together = layers.pieces.matrices.reshape(len(whole), count, 60, 60).sum(axis=1)
    np.testing.assert_allclose(together, whole.matrices, rtol=0, atol=1e-4 * np.abs(whole.matrices).max())
    np.testing.assert_array_equal(layers.pieces.dofs[::count], whole.dofs)


def test_a_layer_stores_the_energy_of_its_own_volume():
    """Under a plane strain that is the same everywhere; of isotropic sheets, whose axes do not count."""
    mesh = ring_mesh(120.0, 90.0, 40.0, radial=2, axial=2)
    hooke = Isotropic(200e9, 0.3).hooke()
    layers = radial_layers(mesh, "lamination", hooke_coefficients(hooke), 4)
    x, y = mesh.nodes[:, 0], mesh.nodes[:, 1]
    stretch, shear = 1e-4, 4e-5
    ux, uy = stretch * x, shear * x
    angle = np.arctan2(y, x)
    u = np.stack([ux * np.cos(angle) + uy * np.sin(angle), uy * np.cos(angle) - ux * np.sin(angle), 0 * x], 1)
    u = u.ravel()[layers.pieces.dofs]
    energy = np.einsum("ei,eij,ej->e", u, layers.pieces.matrices, u)
    strain = np.array([stretch, 0, 0, 0, 0, shear])
    place = layers.place
    wedge = (
        0.5 * (place.angle[:, 1] - place.angle[:, 0]) * (place.radius[:, 1] ** 2 - place.radius[:, 0] ** 2)
    )
    volume = wedge * (place.z[:, 1] - place.z[:, 0])
    np.testing.assert_allclose(energy, strain @ hooke.matrix @ strain * volume, rtol=2e-3)


def test_elements_within_a_radius_are_left_out():
    mesh = stator_mesh(6)
    yoke = radial_layers(mesh, "lamination", CORE, 2, mesh.outer_radius - 0.004)
    assert 0 < len(yoke.pieces) < len(radial_layers(mesh, "lamination", CORE, 2).pieces)
    assert yoke.place.radius[:, 1].max() == pytest.approx(mesh.outer_radius)
