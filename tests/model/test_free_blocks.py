"""Free plates, beams and tubes against exact solutions, and the mirrored eighth against the whole body."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import pytest
from scipy.optimize import brentq

from statorhom.geometry.block import BlockGeometry
from statorhom.geometry.tube import tube_geometry
from statorhom.materials.isotropic import Isotropic
from statorhom.materials.orthotropic import Orthotropic
from statorhom.mesh.block import block_mesh
from statorhom.mesh.density import graded
from statorhom.mesh.extrude import mesh_step
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.affine import Material, assemble
from statorhom.model.frames import cartesian
from statorhom.model.free_modes import solve_free
from statorhom.model.general.general_model import general_model
from statorhom.model.mirror_names import mirror_kind
from statorhom.study.coupon_file import TubeKeys

STEEL = Material(Isotropic(2.1e11, 0.3).hooke(), 7850.0)
# shear factor of a rectangle, G. R. Cowper, J. Appl. Mech. 33 (1966), for ν = 0.3
COWPER = 10 * 1.3 / (12 + 11 * 0.3)
LAMINATE = Material(Orthotropic(42e9, 12e9, 10e9, 0.27, 0.3, 0.35, 4.6e9, 4.2e9, 3.8e9).hooke(), 1890.0)


def by_kind(
    block: BlockGeometry, material: Material, highest_hz: float, factor: float
) -> dict[str, list[float]]:
    mesh = block_mesh(block, factor)
    found: dict[str, list[float]] = {}
    for mode in solve_free(assemble(mesh), {block.region: material}, highest_hz).modes:
        assert mode.parities is not None and mode.order is None
        found.setdefault(mirror_kind(mesh, mode.parities), []).append(mode.frequency_hz)
    return found


def timoshenko(length: float, width: float, height: float, shear_factor: float, number: int) -> float:
    """Bending frequency of a free steel beam with shear and rotary inertia, exact for the beam theory.

    S. M. Han, H. Benaroya and T. Wei, J. Sound Vib. 225 (1999), section 7: frequency equation of the free-free beam,
    here as the determinant of the four boundary conditions of M = 0 and Q = 0.
    """
    E, rho, G = 2.1e11, 7850.0, 2.1e11 / 2.6
    area, inertia = width * height, width * height**3 / 12
    kGA = shear_factor * G * area

    def determinant(omega: float) -> float:
        # deflection e^{kx}, rotation r(k) e^{kx}: kGA (w'' - φ') + ρA ω² w = 0, EI φ'' + kGA (w' - φ) + ρI ω² φ = 0
        a = kGA * E * inertia
        b = E * inertia * rho * area * omega**2 + kGA * rho * inertia * omega**2
        c = rho * area * omega**2 * (rho * inertia * omega**2 - kGA)
        roots = np.sqrt(np.roots([a, b, c]).astype(complex))
        k = np.concatenate([roots, -roots])
        r = (kGA * k**2 + rho * area * omega**2) / (kGA * k)
        rows = []
        for x in (0.0, length):
            e = np.exp(k * x - np.maximum(k.real * length, 0.0))
            rows += [r * k * e, (k - r) * e]
        matrix = np.array(rows)
        value = np.linalg.det(matrix / np.abs(matrix).max(axis=1, keepdims=True))
        return float(value.real if abs(value.real) > abs(value.imag) else value.imag)

    euler = (number + 0.5) ** 2 * np.pi / (2 * length**2) * np.sqrt(E * inertia / (rho * area))
    trial = 2 * np.pi * np.linspace(0.4, 1.05, 400) * euler
    values = [determinant(w) for w in trial]
    signs = [i for i in range(len(trial) - 1) if values[i] * values[i + 1] < 0]
    return float(brentq(determinant, trial[signs[-1]], trial[signs[-1] + 1])) / (2 * np.pi)


def test_slender_beam_has_euler_bernoulli_frequencies_and_its_axial_ones() -> None:
    length, width, height = 1.0, 0.02, 0.01
    found = by_kind(BlockGeometry("beam", (length, width, height), "test"), STEEL, 2700.0, 1.0)
    for kind, depth in (("bending along z", height), ("bending along y", width)):
        wave = 4.7300407 / length
        euler = wave**2 / (2 * np.pi) * np.sqrt(2.1e11 * depth**2 / 12 / 7850.0)
        # shear and rotary inertia take (k h)² of it (S. Timoshenko 1921)
        assert 1.0 - 0.3 * (wave * depth) ** 2 < found[kind][0] / euler < 1.0
        across = width * height / depth
        exact = [timoshenko(length, across, depth, COWPER, n) for n in (1, 2, 3)]
        assert found[kind][:3] == pytest.approx(exact, rel=1.5e-3)
    assert found["axial"][0] == pytest.approx(np.sqrt(2.1e11 / 7850.0) / (2 * length), rel=2e-4)


def test_thick_beam_has_timoshenko_frequencies() -> None:
    length, width, height = 0.3, 0.02, 0.03
    found = by_kind(BlockGeometry("beam", (length, width, height), "test"), STEEL, 9000.0, 1.0)
    exact = [timoshenko(length, width, height, COWPER, n) for n in (1, 2, 3)]
    assert found["bending along z"][:3] == pytest.approx(exact, rel=2.5e-3)


def test_torsion_of_a_square_bar() -> None:
    length, side = 0.5, 0.02
    found = by_kind(BlockGeometry("beam", (length, side, side), "test"), STEEL, 3500.0, 1.0)
    # Saint-Venant: J = 0.140577 a⁴, polar moment a⁴/6
    exact = np.sqrt(0.1405770 * 6 * 2.1e11 / 2.6 / 7850.0) / (2 * length)
    assert found["torsion about x"][0] == pytest.approx(exact, rel=2e-3)


def test_thin_square_plate_has_leissas_frequencies() -> None:
    """λ² = ω a² √(ρh/D) of the completely free square plate, ν = 0.3.

    A. W. Leissa, J. Sound Vib. 31 (1973), printed 13.489, 19.789, 24.432, 35.024, 61.526: upper bounds from few terms
    of the Ritz method. More terms give 13.468, 19.596, 24.270, 34.801, 61.093 (L. E. Monterrubio and S. Ilanko,
    Comput. Struct. 147 (2015)).
    """
    side, thickness = 0.5, 0.002
    found = by_kind(BlockGeometry("plate", (side, side, thickness), "test"), STEEL, 135.0, 1.5)
    stiffness = 2.1e11 * thickness**3 / 12 / (1 - 0.3**2)
    scale = 2 * np.pi * side**2 * np.sqrt(7850.0 * thickness / stiffness)
    parameters = scale * np.array(found["bending"])
    assert parameters[:5] == pytest.approx([13.468, 19.596, 24.270, 34.801, 34.801], rel=2e-3)
    assert parameters[5] == pytest.approx(61.093, rel=5e-3)
    leissa = np.array([13.489, 19.789, 24.432, 35.024, 35.024, 61.526])
    assert np.all(parameters[:6] < leissa) and np.all(parameters[:6] > 0.985 * leissa)


class TwoPoints(MirrorMesh):
    """Integrated as a wing's plies are."""

    quadrature = 3


def test_a_thin_plate_of_few_cells_does_not_lock_at_two_points_an_axis() -> None:
    """Four cells an eighth, five hundred times as wide as they are thick; the same plate's exact parameters."""
    side, thickness = 1.0, 0.001
    mesh = block_mesh(BlockGeometry("plate", (side, side, thickness), "test"), 0.15)
    stiffness = 2.1e11 * thickness**3 / 12 / (1 - 0.3**2)
    scale = 2 * np.pi * side**2 * np.sqrt(7850.0 * thickness / stiffness)
    error = []
    for each in (mesh, TwoPoints(**{f.name: getattr(mesh, f.name) for f in fields(mesh)})):
        modes = solve_free(assemble(each), {"plate": STEEL}, 11.0).modes[:5]
        found = scale * np.array([mode.frequency_hz for mode in modes])
        error.append(np.abs(found / [13.468, 19.596, 24.270, 34.801, 34.801] - 1).max())
    assert error[1] < 0.011 < 0.05 < error[0]


def test_the_eighth_has_the_modes_of_the_whole_body() -> None:
    """Another way to the same numbers: the general path knows of no symmetry."""
    block = BlockGeometry("beam", (0.12, 0.05, 0.02), "test")
    mesh = block_mesh(block)
    part = solve_free(assemble(mesh), {"beam": LAMINATE}, 20000.0)
    whole = general_model(mesh.full()[0], cartesian).solve(20000.0, {"beam": LAMINATE})
    elastic = whole.frequencies_hz[6:]
    assert len(elastic) == len(part.modes) >= 8
    assert [mode.frequency_hz for mode in part.modes] == pytest.approx(list(elastic), rel=1e-6)


def test_mirrored_shapes_are_those_of_the_whole_body() -> None:
    block = BlockGeometry("beam", (0.12, 0.05, 0.02), "test")
    mesh = block_mesh(block)
    part = solve_free(assemble(mesh), {"beam": LAMINATE}, 9000.0)
    full, source, mirrored = mesh.full()
    model = general_model(full, cartesian)
    K, M = model.stiffness_matrix({"beam": LAMINATE}), model.mass_matrix({"beam": LAMINATE})
    for mode in part.modes:
        shape = part.shape(mode).reshape(-1, 3)[source]
        for i, sign in enumerate(mesh.signs(mode.parities or 0)):
            shape[mirrored[:, i]] *= sign
        u = shape.ravel()
        assert u @ (M @ u) == pytest.approx(1.0, rel=1e-9)
        assert np.linalg.norm(K @ u - (2 * np.pi * mode.frequency_hz) ** 2 * (M @ u)) < 1e-6 * np.linalg.norm(
            K @ u
        )


def test_thin_tube_has_ring_modes_and_a_torsion() -> None:
    """Inextensional ring modes of a short thin tube bend as rings do (Rayleigh: no axial variation)."""
    keys = TubeKeys(outer_diameter_mm=202.0, inner_diameter_mm=198.0, length_mm=30.0)
    step = tube_geometry(keys, "test").step(("coupon",))
    assert step.exact_volumes()["tube"] == pytest.approx(np.pi * (0.101**2 - 0.099**2) * 0.03, rel=1e-12)
    model = assemble(mesh_step(step, graded(yoke=2)))
    modes = solve_free(model, {"tube": STEEL}, 1300.0, (2, 3)).modes
    named = {(m.order, m.axial): m.frequency_hz for m in modes if m.order is not None}
    radius, thickness = 0.1, 0.002
    for r in (2, 3):
        # between the ring's (plane stress) and the long tube's (plane strain) bending stiffness
        ring = r * (r**2 - 1) / np.sqrt(r**2 + 1) / (2 * np.pi * radius**2)
        low = ring * np.sqrt(2.1e11 * thickness**2 / 12 / 7850.0)
        assert low * 0.998 < named[r, 0] < low / np.sqrt(1 - 0.3**2) * 1.002
