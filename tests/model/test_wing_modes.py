"""Modes of a wing: a turned material, a box as a beam, and the flying wing's own (slow)."""

import math
from dataclasses import replace

import numpy as np
import pytest

from example_wings import FLYING_WING, box_wing
from statorhom.materials.isotropic import Isotropic
from statorhom.materials.orthotropic import Orthotropic
from statorhom.mesh.wing import wing_mesh
from statorhom.model.affine import Material, assemble
from statorhom.model.free_modes import solve_free

ALUMINIUM = Material(Isotropic(70e9, 0.33).hooke(), 2700.0)
CLOTH = Orthotropic(47.126e9, 47.126e9, 9e9, 0.04, 0.3, 0.3, 3.927e9, 3e9, 3e9)


def beam_hz(wing, E, density):
    """First free-free bending of a uniform box (Euler and Bernoulli), both halves together."""
    c, h, t = wing.plan.root_chord, wing.plan.root_chord * wing.plan.heights[0], wing.skin[0].thickness
    inner = (c - 2 * t) * (h - 2 * t) ** 3 / 12
    spars = 2 * wing.web * (h - 2 * t) ** 3 / 12
    inertia = c * h**3 / 12 - inner + spars
    mass = density * sum(wing.exact_volumes().values()) / (2 * wing.plan.half_span)
    return (4.730041 / (2 * wing.plan.half_span)) ** 2 * math.sqrt(E * inertia / mass) / (2 * math.pi)


@pytest.fixture(scope="module")
def slender():
    return box_wing(
        sweep_deg=0.0, tip_chord=0.4, heights=(0.1, 0.1, 0.1, 0.1), half_span=2.0, skin=4e-3, web=4e-3
    )


def test_an_isotropic_wing_does_not_notice_its_materials_axes(slender):
    mesh = wing_mesh(slender)
    turned = assemble(mesh).stiffness_matrix({"skin": ALUMINIUM, "web": ALUMINIUM})
    straight = assemble(replace(mesh, material_axes=np.broadcast_to(np.eye(3), mesh.material_axes.shape)))
    expected = straight.stiffness_matrix({"skin": ALUMINIUM, "web": ALUMINIUM})
    assert abs(turned - expected).max() < 1e-9 * abs(expected).max()


def test_a_slender_box_bends_as_a_beam(slender):
    model = assemble(wing_mesh(slender))
    expected = beam_hz(slender, 70e9, 2700.0)
    modes = solve_free(model, {"skin": ALUMINIUM, "web": ALUMINIUM}, 1.6 * expected, (0,)).modes
    # ribs add mass alone, shear and the plates' own bending take a few per cent
    assert modes[0].frequency_hz == pytest.approx(expected, rel=0.05)
    assert modes[0].visibility > 0.5


def test_cloth_is_turned_into_the_panel(slender):
    """At 45 degrees the cloth is soft along the span: E₄₅ = 4 / (1/E (2 − 2ν) + 1/G)."""
    E, nu, G = 47.126e9, 0.04, 3.927e9
    along = 4.0 / ((2.0 - 2.0 * nu) / E + 1.0 / G)
    found = []
    for angle in (0.0, math.radians(45.0)):
        layer = replace(slender.skin[0], angle=angle)
        wing = replace(slender, skin=(layer,))
        materials = {
            "skin": Material(CLOTH.hooke(), 1500.0),
            "web": Material(Isotropic(60e6, 0.3).hooke(), 80.0),
        }
        top = 1.3 * beam_hz(wing, E, 1500.0)
        found.append(solve_free(assemble(wing_mesh(wing)), materials, top, (0,)).modes[0].frequency_hz)
    assert found[1] / found[0] == pytest.approx(math.sqrt(along / E), rel=0.1)


@pytest.mark.slow
def test_the_flying_wing_s_modes_are_found_on_the_coarsest_mesh():
    materials = {
        "skin": Material(CLOTH.hooke(), 1510.0),
        "core": Material(Isotropic(60e6, 0.3).hooke(), 80.0),
        "glass": Material(Isotropic(10e9, 0.2).hooke(), 1270.0),
        "cage": ALUMINIUM,
    }
    series = [
        [m.frequency_hz for m in solve_free(assemble(wing_mesh(FLYING_WING, f)), materials, 150.0).modes[:2]]
        for f in (1.0, 1.5)
    ]
    coarse, fine = np.array(series)
    # twice as many cells an axis take another 0.06 % away
    assert np.all(fine < coarse) and np.all(fine > 0.996 * coarse)
