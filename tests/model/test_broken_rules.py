"""First-order rules of broken symmetry on a plain ring, whose doublets are cos rθ and sin rθ."""

from functools import cache

import numpy as np
import pytest
from small_stators import MATERIALS, ring_mesh

from statorhom.model.affine import assemble, hooke_coefficients
from statorhom.model.broken.attachments import lump, point_springs
from statorhom.model.broken.basis import symmetric_basis
from statorhom.model.broken.layers import radial_layers
from statorhom.model.broken.signature import projected
from statorhom.model.broken.solve import solve_broken
from statorhom.model.broken.variations import region_stiffness, strip, wave
from statorhom.model.stator_mode import RIGID_HZ
from statorhom.model.surface import surface_points

ORDERS = (2, 3, 4)
ANGLE, HEIGHT = 0.83, 0.013


@cache
def ring():
    return ring_mesh(120.0, 100.0, 40.0, radial=1, axial=2)


@cache
def basis():
    return symmetric_basis(assemble(ring()), MATERIALS, 14000.0)


def doublet(order):
    """Coordinates of the lowest cosine and sine mode of an order, and their eigenvalue."""
    found = []
    for problem, places in zip(basis().problems, basis().places, strict=True):
        space = problem.sector.space
        if space.order == order and space.axial == "even":
            column = int(np.flatnonzero(problem.values > (2 * np.pi * RIGID_HZ) ** 2)[0])
            found.append((problem.values[column], places[False].start + column, places[True].start + column))
    return min(found)


def dynamic(change, order):
    K, M = projected(basis(), change)
    return K - doublet(order)[0] * M


def split(change, order):
    """b_r, and the doublet's common shift."""
    _, c, s = doublet(order)
    z = dynamic(change, order)
    return z[c, c] - z[s, s] + 2j * z[c, s], (z[c, c] + z[s, s]) / 2


def layers():
    return radial_layers(ring(), "lamination", hooke_coefficients(MATERIALS["lamination"].hooke), 2)


def core():
    return region_stiffness(ring(), MATERIALS, ("lamination",))


FEATURES = {
    "lump": (lambda: lump(ring(), ANGLE, HEIGHT, 1e-3), np.pi),
    "spring": (
        lambda: point_springs(ring(), np.array([ANGLE]), np.array([HEIGHT]), np.array([1e5, 0, 0])),
        0.0,
    ),
    # between two elements: within one its place is not resolved
    "stiff strip": (lambda: strip(layers(), np.pi / 4, width=0.1, depth=0.01, ratio=1.2), 0.0),
}


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("feature", FEATURES)
def test_the_split_points_at_the_feature(feature, order):
    make, phase = FEATURES[feature]
    angle = np.pi / 4 if feature == "stiff strip" else ANGLE
    b, _ = split(make(), order)
    # a lump moves tangentially too, with the opposite sign and (1/r)² of the radial part
    assert np.angle(b * np.exp(-1j * (2 * order * angle + phase))) == pytest.approx(0.0, abs=0.02)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("harmonic", [4, 6, 8])
def test_a_wave_splits_the_order_of_half_its_harmonic_alone(order, harmonic):
    change = wave(ring(), core(), ANGLE, harmonic=harmonic, amplitude=0.01, inner=0.05)
    b, shift = split(change, order)
    value = doublet(order)[0]
    if harmonic == 2 * order:
        # bending strains vary as cos² rθ; shear, which a thick ring has more of the higher the order, as sin² rθ
        assert 0.65 < abs(b) / (0.01 * value) < 1.0
        assert np.angle(b * np.exp(-2j * order * ANGLE)) == pytest.approx(0.0, abs=1e-3)
    else:
        assert abs(b) < 1e-6 * value
    assert abs(shift) < 1e-6 * value


@pytest.mark.parametrize("harmonic", [1, 2, 5, 6, 7])
def test_a_wave_couples_orders_that_differ_or_add_up_to_its_harmonic(harmonic):
    z = dynamic(wave(ring(), core(), ANGLE, harmonic=harmonic, amplitude=0.01, inner=0.05), 2)
    scale = 0.01 * doublet(2)[0]
    for a in ORDERS:
        for b in ORDERS:
            strength = np.abs(z[np.ix_(doublet(a)[1:], doublet(b)[1:])]).max()
            if harmonic in (a + b, abs(a - b)):
                assert strength > 0.05 * scale
            else:
                assert strength < 1e-6 * scale


def test_a_lump_lies_at_an_antinode_of_the_lower_mode():
    modes = solve_broken(basis(), [lump(ring(), ANGLE, HEIGHT, 0.01)])
    at, beside = (
        surface_points(ring(), np.array([a]), np.array([HEIGHT])) for a in (ANGLE, ANGLE + np.pi / 4)
    )
    lower, upper = np.abs(modes.shapes.motion(at)[0, 0, :2])
    assert upper < 0.05 * lower
    there = np.abs(modes.shapes.motion(beside)[0, 0, :2])
    assert there[0] < 0.05 * there[1]


@pytest.mark.parametrize("order", ORDERS)
def test_first_order_is_the_limit_of_small_changes(order):
    mass = 1e-4
    change = lump(ring(), ANGLE, HEIGHT, mass)
    b, shift = split(change, order)
    value = doublet(order)[0]
    modes = solve_broken(basis(), [change], tolerance=None)
    nearest = np.sort(modes.eigenvalues[np.argsort(np.abs(modes.eigenvalues - value))[:2]])
    np.testing.assert_allclose(
        nearest - value, shift + np.array([-0.5, 0.5]) * abs(b), rtol=0.01, atol=1e-3 * abs(b)
    )


def test_odd_sidebands_tell_a_lump_from_one_on_the_other_side():
    one, other = (dynamic(lump(ring(), a, HEIGHT, 1e-3), 2) for a in (ANGLE, ANGLE + np.pi))
    (_, c2, s2), (_, c3, s3), (_, c4, s4) = (doublet(r) for r in ORDERS)
    scale = np.abs(one).max()
    np.testing.assert_allclose(
        one[np.ix_((c2, s2), (c4, s4))], other[np.ix_((c2, s2), (c4, s4))], atol=1e-7 * scale
    )
    np.testing.assert_allclose(
        one[np.ix_((c2, s2), (c3, s3))], -other[np.ix_((c2, s2), (c3, s3))], atol=1e-7 * scale
    )


def test_a_soft_strip_does_not_know_where_elements_end():
    """Parts of an element are compliant one after the other; as if side by side, its place told by a tenth."""
    element = np.pi / ring().slots
    shifts = []
    for part in (0.0, 0.2, 0.5, 0.8):
        soft = strip(layers(), np.pi / 4 + part * element, width=2.0 * element, depth=0.01, ratio=0.25)
        found = solve_broken(basis(), [soft], tolerance=1e-3).frequencies_hz[:2]
        shifts.append(np.log(found / np.sqrt(doublet(2)[0]) * 2 * np.pi).sum())
    np.testing.assert_allclose(shifts, shifts[0], rtol=0.04)
