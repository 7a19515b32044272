"""Cuboids in Cartesian components against exact solutions."""

import numpy as np
import pytest
from boxes import box_mesh, turned
from small_stators import ORTHOTROPIC

from statorhom.materials.isotropic import Isotropic
from statorhom.materials.orthotropic import Orthotropic
from statorhom.materials.rotation import cylinder_axes
from statorhom.model.affine import Material
from statorhom.model.frames import cartesian, cylindrical
from statorhom.model.general.general_model import general_model

DENSITY = 7810.5
STEEL = Material(Isotropic(187e9, 0.3).hooke(), DENSITY)
# no contraction along y and z under load along x
UNCOUPLED = Orthotropic(190e9, 170e9, 90e9, 0.0, 0.0, 0.31, 66e9, 21e9, 28e9)
SIZE = (0.12, 0.05, 0.02)


def _modes(size, cells, material, top_hz, frame=cartesian):
    model = general_model(box_mesh(size, cells), frame)
    return model, model.solve(top_hz, {"box": material})


def _shares(model, modes, material):
    """Each component's share of the kinetic energy, (k, 3)."""
    v = modes.vectors
    return (v * (model.mass_matrix({"box": material}) @ v)).reshape(-1, 3, v.shape[1]).sum(axis=0).T


def test_the_inertia_of_a_cuboid():
    mesh = box_mesh(SIZE, (2, 1, 1))
    M = general_model(mesh, cartesian).mass_matrix({"box": STEEL})
    a, b, c = SIZE
    mass = DENSITY * a * b * c
    arm = mesh.nodes - np.array(SIZE) / 2
    fields = [np.broadcast_to(axis, arm.shape) for axis in np.eye(3)]
    fields += [np.cross(axis, arm) for axis in np.eye(3)]
    rigid = np.array([field.ravel() for field in fields])
    expected = mass * np.array([1, 1, 1, (b**2 + c**2) / 12, (a**2 + c**2) / 12, (a**2 + b**2) / 12])
    np.testing.assert_allclose(rigid @ (M @ rigid.T), np.diag(expected), atol=1e-12 * mass)


def test_lame_modes_of_a_square_plate_of_any_thickness():
    # u = cos kx sin ky, v = -sin kx cos ky with k = n π/a leave every face of a free isotropic cuboid of square
    # plan without stress, and change no volume: f = n c/(√2 a), c² = G/ρ (Lamé 1852)
    side, thickness = 0.05, 0.013
    speed = np.sqrt(Isotropic(187e9, 0.3).shear_modulus_pa / DENSITY)
    exact = speed / (np.sqrt(2) * side)
    errors = []
    for cells in (2, 4):
        model, modes = _modes((side, side, thickness), (cells, cells, 1), STEEL, 1.05 * exact)
        x, y, _ = model.mesh.nodes.T * np.pi / side
        lame = np.column_stack([np.cos(x) * np.sin(y), -np.sin(x) * np.cos(y), 0 * x]).ravel()
        M = model.mass_matrix({"box": STEEL})
        similar = (modes.vectors.T @ (M @ lame)) ** 2 / (lame @ (M @ lame))
        assert similar.max() > 0.99
        errors.append(modes.frequencies_hz[similar.argmax()] / exact - 1)
    assert 0 < errors[1] < 6e-4
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4, abs=0.4)


def test_longitudinal_waves_of_a_material_without_poisson_effect():
    # u_x = cos(n π x/L) is exact: f = n/(2 L) √(E_x/ρ); quadratic elements of size h err by (k h)⁴/1440
    material = Material(UNCOUPLED.hooke(), DENSITY)
    exact = np.arange(1, 3) / (2 * SIZE[0]) * np.sqrt(UNCOUPLED.E_r_pa / DENSITY)
    model, modes = _modes(SIZE, (8, 1, 1), material, 1.02 * exact[-1])
    along = modes.frequencies_hz[_shares(model, modes, material)[:, 0] > 1 - 1e-6]
    along = along[along > 1.0]
    np.testing.assert_allclose(along / exact - 1, (np.arange(1, 3) * np.pi / 8) ** 4 / 1440, rtol=0.05)


def test_bending_of_a_long_beam_tends_to_eulers_formula():
    # free-free: cos βL cosh βL = 1, β₁L = 4.73004; Hooke's matrix of a laminated bar
    material, length = Material(ORTHOTROPIC.hooke(), DENSITY), 0.4
    errors = []
    for height in (0.016, 0.008):
        radius = height / np.sqrt(12)
        exact = 4.730041**2 / (2 * np.pi * length**2) * np.sqrt(ORTHOTROPIC.E_r_pa / DENSITY) * radius
        model, modes = _modes((length, 2 * height, height), (20, 1, 1), material, 1.1 * exact)
        flat = _shares(model, modes, material)[:, 2] > 0.9
        (bending,) = modes.frequencies_hz[flat & (modes.frequencies_hz > 1.0)]
        errors.append(bending / exact - 1)
    # shear and rotary inertia soften by (height/length)²: a quarter at half of it
    assert -3e-3 < errors[1] < 0
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)


@pytest.mark.parametrize("angle", [0.4, -2.0])
def test_a_turned_body_with_turned_material_has_the_same_modes(angle):
    # turned about z, an orthotropic material couples shear and extension in x and y: C16, C26, C36, C45
    model, still = _modes(SIZE, (3, 2, 1), Material(ORTHOTROPIC.hooke(), DENSITY), 4e4)
    hooke = ORTHOTROPIC.hooke().rotated(cylinder_axes(angle))
    assert abs(hooke.matrix[0, 5]) > 1e9
    moved = general_model(turned(model.mesh, angle), cartesian).solve(4e4, {"box": Material(hooke, DENSITY)})
    assert len(still.frequencies_hz) > 12
    np.testing.assert_allclose(moved.frequencies_hz[6:], still.frequencies_hz[6:], rtol=1e-9)


def test_isotropic_bodies_do_not_know_their_frame():
    _, cart = _modes(SIZE, (3, 2, 1), STEEL, 4e4)
    # the z axis passes through a corner of the cuboid
    _, cyl = _modes(SIZE, (3, 2, 1), STEEL, 4e4, cylindrical)
    assert len(cart.frequencies_hz) > 12
    np.testing.assert_allclose(cyl.frequencies_hz[6:], cart.frequencies_hz[6:], rtol=1e-9)
