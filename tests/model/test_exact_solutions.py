import numpy as np
import pytest
from exact_cylinders import (
    plane_ring_hz,
    ritz_cylinder_hz,
    thin_ring_bending_hz,
    thin_ring_extension_hz,
)
from small_stators import ORTHOTROPIC, ring_mesh

from statorhom.materials.isotropic import Isotropic
from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.model.affine import Material, assemble
from statorhom.model.eigen import frequency_hz, modes_below
from statorhom.model.harmonic import harmonic_spaces

DENSITY = 7810.5
STEEL = Isotropic(187e9, 0.3)
LAMINATED = TransverselyIsotropic(182e9, 60e9, 0.29, 0.25, 15e9)
# no strain along z under load in the plane: plane motion and axial motion then know nothing of each other
UNCOUPLED = TransverselyIsotropic(182e9, 60e9, 0.29, 0.0, 15e9)


class Free:
    """Elastic modes of a meshed free ring, one per doublet."""

    def __init__(self, mesh, material):
        self.mesh, model = mesh, assemble(mesh)
        stuff = {"lamination": Material(material.hooke(), DENSITY)}
        self.K, self.M = model.stiffness_matrix(stuff), model.mass_matrix(stuff)

    def modes(self, order, highest_hz):
        """Frequencies and each component's share of the kinetic energy (k, 3)."""
        hz, shares = [], []
        for space in harmonic_spaces(self.mesh, order):
            values, y = modes_below(space.project(self.K), space.project(self.M), highest_hz)
            shape = space.expand(y)
            energy = np.real(np.conj(shape) * (self.M @ shape)).reshape(len(shape) // 3, 3, -1).sum(axis=0)
            hz.append(frequency_hz(values))
            shares.append((energy / energy.sum(axis=0)).T)
        hz, shares = np.concatenate(hz), np.concatenate(shares)
        rank = np.argsort(hz)
        rank = rank[hz[rank] > 1.0]
        return hz[rank], shares[rank]


@pytest.mark.parametrize("material", [STEEL, LAMINATED, ORTHOTROPIC])
def test_torsion_of_a_free_cylinder(material):
    # u_θ = r cos(n π z/L) is exact for every hollow cylinder: f = n c/(2 L), c² = G_θz/ρ
    length = 0.12
    speed = np.sqrt(material.hooke().matrix[3, 3] / DENSITY)
    errors = []
    for cells in (6, 12):
        free = Free(ring_mesh(120.0, 70.0, 1e3 * length, radial=2, axial=cells), material)
        hz, shares = free.modes(0, 3.2 * speed / (2 * length))
        torsion = hz[shares[:, 1] > 0.999][:3]
        errors.append(torsion / (np.arange(1, 4) * speed / (2 * length)) - 1)
    assert np.all(errors[1] > -1e-9)
    # one-dimensional quadratic elements of size h, wave number k: (k h)⁴/1440
    np.testing.assert_allclose(errors[1], (np.arange(1, 4) * np.pi / 12) ** 4 / 1440, rtol=0.05)
    np.testing.assert_allclose(np.log2(errors[0] / errors[1]), 4, atol=0.2)


def test_axial_waves_of_a_material_without_poisson_effect():
    # u_z = cos(n π z/L): f = n/(2 L) √(E_z/ρ)
    length = 0.12
    free = Free(ring_mesh(120.0, 70.0, 1e3 * length, radial=2, axial=12), UNCOUPLED)
    speed = np.sqrt(UNCOUPLED.E_z_pa / DENSITY)
    exact = np.arange(1, 4) * speed / (2 * length)
    hz, shares = free.modes(0, 1.02 * exact[-1])
    axial = hz[shares[:, 2] > 0.999]
    np.testing.assert_allclose(axial, exact, rtol=3e-4)


@pytest.mark.parametrize("order", range(7))
def test_plane_vibration_of_a_thick_ring(order):
    inner, outer = 0.035, 0.06
    exact = plane_ring_hz(order, inner, outer, UNCOUPLED.E_p_pa, UNCOUPLED.nu_p, DENSITY, 50e3)
    assert len(exact) >= 1
    mesh = ring_mesh(2e3 * outer, 2e3 * inner, 2.0, radial=10, axial=1, sectors=24, tangential=2)
    hz, shares = Free(mesh, UNCOUPLED).modes(order, 1.001 * exact[-1])
    # a short ring has out-of-plane modes as well: they move along z
    plane = hz[shares[:, 2] < 1e-6]
    assert len(plane) == len(exact)
    np.testing.assert_allclose(plane, exact, rtol=1e-4)
    assert np.all(plane > exact * (1 - 1e-6))


@pytest.mark.parametrize("order", [2, 3, 4])
def test_bending_of_a_ring_tends_to_the_thin_rings_formula(order):
    errors = []
    for thickness in (0.04, 0.02):
        size = 1e3 * thickness
        mesh = ring_mesh(2000.0 + size, 2000.0 - size, size, radial=1, axial=1, sectors=48, tangential=4)
        exact = thin_ring_bending_hz(order, STEEL.E_pa, DENSITY, thickness, 1.0)
        hz, shares = Free(mesh, STEEL).modes(order, 1.2 * exact)
        (plane,) = hz[shares[:, 2] < 0.1]
        errors.append(plane / exact - 1)
    # shear and rotary inertia make a thick ring softer: by (thickness/radius)², so a quarter at half of it
    assert -3e-3 < errors[1] < 0
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)


@pytest.mark.parametrize("order", [0, 1, 2])
def test_extension_of_a_thin_ring(order):
    mesh = ring_mesh(2005.0, 1995.0, 5.0, radial=1, axial=1, sectors=48)
    exact = thin_ring_extension_hz(order, STEEL.E_pa, DENSITY, 1.0)
    hz, shares = Free(mesh, STEEL).modes(order, 1.01 * exact)
    near = hz[(np.abs(hz / exact - 1) < 0.01) & (shares[:, 2] < 0.1)]
    assert near == pytest.approx([exact], rel=5e-5)


@pytest.mark.parametrize("order", [0, 1, 2, 5])
@pytest.mark.parametrize("material", [STEEL, LAMINATED, ORTHOTROPIC])
def test_free_hollow_cylinder_in_three_dimensions(material, order):
    inner, outer, length = 0.04, 0.06, 0.08
    exact = ritz_cylinder_hz(order, inner, outer, length, material.hooke(), DENSITY, 4)
    found = []
    for cells in (3, 6):
        mesh = ring_mesh(
            2e3 * outer, 2e3 * inner, 1e3 * length, radial=cells, axial=2 * cells, tangential=cells // 3
        )
        found.append(Free(mesh, material).modes(order, 1.01 * exact[-1])[0][:4])
    coarse, fine = np.array(found) / exact - 1
    # conforming elements err upwards, close to h⁴ where edge layers are resolved
    assert np.all(fine > 0)
    assert np.all(fine < 5e-4 if material is LAMINATED else fine < 3e-4)
    assert np.all(coarse / fine > 2**2.6)


def test_the_ritz_reference_is_converged_and_meets_the_closed_forms():
    inner, outer, length = 0.04, 0.06, 0.08
    for material in (STEEL, LAMINATED, ORTHOTROPIC):
        args = (inner, outer, length, material.hooke(), DENSITY, 5)
        for order in (0, 5):
            coarse = ritz_cylinder_hz(order, *args)
            np.testing.assert_allclose(coarse, ritz_cylinder_hz(order, *args, degree=(10, 16)), rtol=5e-6)
    torsion = np.sqrt(STEEL.shear_modulus_pa / DENSITY) / (2 * length)
    lowest = ritz_cylinder_hz(0, inner, outer, length, STEEL.hooke(), DENSITY, 12)
    assert np.abs(lowest / torsion - 1).min() < 1e-9
    for order in (0, 2, 4):
        plane = plane_ring_hz(order, inner, outer, UNCOUPLED.E_p_pa, UNCOUPLED.nu_p, DENSITY, 12e3)
        every = ritz_cylinder_hz(order, inner, outer, length, UNCOUPLED.hooke(), DENSITY, 60)
        for hz in plane:
            assert np.abs(every / hz - 1).min() < 1e-8
