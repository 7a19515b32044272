"""All modes of a free stator, on the full model."""

import numpy as np
import pytest
from small_stators import MATERIALS, STACK, WINDING, stator_mesh
from threadpoolctl import threadpool_info

from statorhom.model.affine import Material, assemble
from statorhom.model.free_modes import solve_free, strain_energy_shares, total_mass

TOP_HZ = 6000.0


@pytest.fixture(scope="module")
def model():
    return assemble(stator_mesh(6, ("stack", "wound")))


@pytest.fixture(scope="module")
def free(model):
    return solve_free(model, MATERIALS, TOP_HZ)


def test_modes_are_sorted_and_rigid_bodies_left_out(free):
    frequencies = [mode.frequency_hz for mode in free.modes]
    assert frequencies == sorted(frequencies)
    assert frequencies[0] > 100.0
    assert frequencies[-1] <= TOP_HZ
    orders = {free.harmonics[mode.problem].order for mode in free.modes}
    assert orders == {0, 1, 2, 3}


def test_the_first_visible_mode_is_the_ovalling_one(free):
    first = next(mode for mode in free.modes if mode.visibility > 0.1)
    assert first.order == 2
    assert first.multiplicity == 2


def test_some_orders_alone(model, free):
    only = solve_free(model, MATERIALS, TOP_HZ, (2,))
    expected = [m.frequency_hz for m in free.modes if free.harmonics[m.problem].order == 2]
    np.testing.assert_allclose([m.frequency_hz for m in only.modes], expected, rtol=1e-10)


def test_threads_change_nothing(model, free):
    several = solve_free(model, MATERIALS, TOP_HZ, jobs=3)
    assert [m.problem for m in several.modes] == [m.problem for m in free.modes]
    assert [m.frequency_hz for m in several.modes] == [m.frequency_hz for m in free.modes]
    for a, b in zip(several.shapes, free.shapes, strict=True):
        np.testing.assert_array_equal(a, b)


def test_blas_threads_are_what_they_were_afterwards(model):
    before = [library["num_threads"] for library in threadpool_info()]
    solve_free(model, MATERIALS, 2000.0, (2, 3), jobs=2)
    assert [library["num_threads"] for library in threadpool_info()] == before


def test_shapes_have_unit_modal_mass_in_the_whole_stator(model, free):
    M = model.mass_matrix(MATERIALS)
    for mode in free.modes:
        shape = free.shape(mode)
        # the half pitch repeats 2 N times; a doublet's two shapes share the complex one
        copies = 2 * model.mesh.slots / mode.multiplicity
        assert copies * np.real(np.vdot(shape, M @ shape)) == pytest.approx(1.0, rel=1e-9)


def test_strain_energy_shares_are_parts_of_the_eigenvalue(model, free):
    for mode in free.modes[:5]:
        shares = strain_energy_shares(model, MATERIALS, free.shape(mode))
        assert sum(shares.values()) == pytest.approx(1.0)
        assert min(shares.values()) >= 0.0
        # a share is twice the relative change of the frequency with that region's stiffness
        stiffer = {
            r: Material(type(m.hooke)(m.hooke.matrix * 1.001), m.density) for r, m in MATERIALS.items()
        }
        changed = {**MATERIALS, "lamination": stiffer["lamination"]}
        order = free.harmonics[mode.problem].order
        above = solve_free(model, changed, TOP_HZ * 1.01, (order,)).modes
        near = min(
            above, key=lambda m: abs(m.frequency_hz - mode.frequency_hz * (1 + 0.0005 * shares["lamination"]))
        )
        slope = np.log(near.frequency_hz / mode.frequency_hz) / np.log(1.001)
        assert 2 * slope == pytest.approx(shares["lamination"], abs=2e-3)


def test_mass_is_that_of_the_volumes(model):
    assert total_mass(model, MATERIALS) == pytest.approx(
        model.volumes["lamination"] * STACK.density
        + (model.volumes["winding"] + model.volumes["overhang"]) * WINDING.density
    )
