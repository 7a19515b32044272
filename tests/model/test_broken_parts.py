"""The parts that the broken symmetry is solved with, each against the whole stator or a plain formula."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad
from small_stators import MATERIALS, stator_mesh
from whole_changes import scaled_stiffness, whole_stator
from whole_supports import WholeSurface

from statorhom.errors import SolverError
from statorhom.model.affine import assemble, hooke_coefficients
from statorhom.model.broken.attachments import footed_lump, lump
from statorhom.model.broken.basis import symmetric_basis
from statorhom.model.broken.cells import Sectors, cells
from statorhom.model.broken.change import PieceChange
from statorhom.model.broken.dense_modes import lowest_coupled
from statorhom.model.broken.interface import contact, split
from statorhom.model.broken.layers import radial_layers
from statorhom.model.broken.pieces import elements_in
from statorhom.model.broken.signature import projected, slopes
from statorhom.model.broken.solve import solve_broken
from statorhom.model.broken.variations import region_stiffness, strip, wave
from statorhom.model.eigen import frequency_hz
from statorhom.model.harmonic import harmonic_spaces
from statorhom.model.ritz import lowest_pairs
from statorhom.model.supported_shapes import ShapePart, SupportedModes
from statorhom.model.surface import surface_points

HOOKE = {"lamination": hooke_coefficients(MATERIALS["lamination"].hooke)}


@cache
def stack():
    return whole_stator(stator_mesh(6), MATERIALS)


@cache
def basis():
    return symmetric_basis(assemble(stack().half), MATERIALS, 9000.0)


def whole_columns(of):
    """Every coordinate of a basis as a shape of the whole stator, (3 n, n)."""
    unit, parts = np.eye(len(of.values)), []
    for problem, places in zip(of.problems, of.places, strict=True):
        families = [None, None]
        for sine, place in places.items():
            families[int(sine)] = unit[place]
        parts.append(ShapePart(problem.sector.space, problem.vectors, *families))
    shapes = SupportedModes(np.zeros(len(unit)), np.zeros(len(unit)), tuple(parts))
    return np.array([shapes.full_shape(of.mesh, i).ravel() for i in range(len(unit))]).T


@cache
def layers():
    return radial_layers(stack().half, "lamination", HOOKE["lamination"], 2)


def core():
    return region_stiffness(stack().half, MATERIALS, ("lamination",))


def test_columns_of_the_basis_are_orthonormal_modes_of_the_whole_stator():
    w, columns = stack(), whole_columns(basis())
    np.testing.assert_allclose(columns.T @ (w.M @ columns), np.eye(columns.shape[1]), atol=1e-8)
    scale = basis().values.max()
    np.testing.assert_allclose(columns.T @ (w.K @ columns), np.diag(basis().values), atol=1e-8 * scale)


def test_waves_at_points_and_in_copies_are_the_whole_shapes():
    w, columns = stack(), whole_columns(basis())
    on = WholeSurface(w.mesh, w.half.outer_radius)
    nodes = np.unique(np.concatenate([face for face, *_ in on.faces]))
    rows = basis().waves.at_points(surface_points(w.half, on.angle[nodes], on.z[nodes]))
    dofs = (3 * nodes[:, None] + np.arange(3)).ravel()
    np.testing.assert_allclose(rows, columns[dofs], atol=1e-9 * np.abs(columns).max())
    _, source, copy = w.half.full()
    some = np.random.default_rng(0).standard_normal((len(basis().values), 2))
    motion = basis().waves.in_copies(np.arange(3 * len(w.half.nodes)), some)
    motion = motion.reshape(2 * w.half.slots, -1, 3, 2)[copy, source]
    # mirrored halves have mirrored axes
    motion[copy % 2 == 1, 1] *= -1
    np.testing.assert_allclose(
        motion.reshape(-1, 2), columns @ some, atol=1e-8 * np.abs(columns @ some).max()
    )


@pytest.mark.parametrize("seed", range(3))
def test_pieces_between_waves_are_those_of_the_whole_stator(seed):
    w, pieces = stack(), core()
    weights = np.random.default_rng(seed).standard_normal((len(pieces), 2 * w.half.slots))
    weights[:: seed + 2] = 0.0
    found, mass = projected(basis(), PieceChange(pieces, None, weights))
    columns = whole_columns(basis())
    expected = columns.T @ (scaled_stiffness(w, ("lamination",), HOOKE, weights) @ columns)
    np.testing.assert_allclose(found, expected, atol=1e-9 * np.abs(expected).max())
    assert not np.any(mass)


def test_large_problems_have_the_same_modes_as_small_ones():
    generator = np.random.default_rng(1)
    values = np.sort(np.concatenate([np.repeat([1.0, 2.0, 3.0], 3), np.linspace(5.0, 1e4, 591)]))
    turn = np.linalg.qr(generator.standard_normal((600, 600)))[0]
    K = (turn * values) @ turn.T
    K = (K + K.T) / 2
    M = np.eye(600) + 0.1 * np.outer(turn[:, 5], turn[:, 5])
    exact, _ = lowest_pairs(K, M, 60.0)
    found, x = lowest_coupled(K, M, 60.0, 1.0, 14)
    np.testing.assert_allclose(found, exact, rtol=1e-8)
    np.testing.assert_allclose(x.T @ M @ x, np.eye(len(found)), atol=1e-8)


def test_shares_of_an_arc_add_up_to_its_angle():
    place = cells(stack().half, elements_in(stack().half, ("lamination",)))
    width = np.diff(place.angles, axis=-1)[..., 0]
    start, end = 0.777, 0.777 + np.deg2rad(90.0)
    covered = place.share_of_arc(start, end) * width
    outer = place.radius[:, 1] > stack().half.outer_radius * (1 - 1e-9)
    rows = np.unique(place.z[outer][:, 0].round(9), return_inverse=True)[1]
    for row in np.unique(rows):
        assert covered[outer][rows == row].sum() == pytest.approx(end - start, rel=1e-6)
    np.testing.assert_allclose(
        place.share_of_arc(start + 2 * np.pi, end + 2 * np.pi), place.share_of_arc(start, end), atol=1e-9
    )


def test_a_foot_follows_rigid_motion_exactly():
    half, foot = stack().half, 0.016
    change = footed_lump(half, 0.4, 0.05, 0.2, foot=foot, height=0.01)
    turn = 0.4 + foot / half.outer_radius * np.tile([-0.5, 0.0, 0.5], 3)
    z = 0.05 + foot * np.repeat([-0.5, 0.0, 0.5], 3)
    place = np.column_stack([half.outer_radius * np.cos(turn), half.outer_radius * np.sin(turn), z])
    centre = np.array([half.outer_radius * np.cos(0.4), half.outer_radius * np.sin(0.4), 0.05])
    axes = np.array([[np.cos(0.4), np.sin(0.4), 0.0], [-np.sin(0.4), np.cos(0.4), 0.0], [0.0, 0.0, 1.0]])
    shift, spin = np.array([0.3, -0.2, 0.5]), np.array([0.1, 0.7, -0.4])
    field = shift + np.cross(spin, place - centre)
    cos, sin = np.cos(turn), np.sin(turn)
    local = np.column_stack(
        [cos * field[:, 0] + sin * field[:, 1], cos * field[:, 1] - sin * field[:, 0], field[:, 2]]
    )
    np.testing.assert_allclose(change.rows @ local.ravel(), np.r_[axes @ shift, axes @ spin], atol=1e-12)
    # the kinetic energy of a cube of 0.2 kg whose centre lies 10 mm above the foot
    q = np.r_[axes @ shift, axes @ spin]
    velocity = shift + np.cross(spin, 0.01 * axes[0])
    expected = 0.2 * velocity @ velocity + 0.2 * foot**2 / 6 * spin @ spin
    assert q @ change.mass @ q == pytest.approx(expected)


def test_contact_has_the_area_of_slots_and_tooth_ends():
    slots, tooth, bore, bottom, length = 5, 0.012, 0.035, 0.051, 0.08
    half = split(stator_mesh(slots, ("stack", "wound")), ("winding", "overhang"))
    springs = contact(half, ("winding", "overhang"), 1.0, 1.0)
    lift = np.zeros(3 * len(half.nodes))
    inside = np.unique(half.elements[half.region != half.regions.index("lamination")])
    lift[3 * inside + 2] = 1.0
    flanks = 2 * length * (np.sqrt(bottom**2 - tooth**2 / 4) - np.sqrt(bore**2 - tooth**2 / 4))
    ground = length * bottom * (2 * np.pi / slots - 2 * np.arcsin(tooth / 2 / bottom))
    ends = 2 * quad(lambda r: 2 * r * np.arcsin(tooth / 2 / r), bore, bottom)[0]
    area = slots * (flanks + ground + ends)
    assert 2 * slots * (lift @ (springs.matrix @ lift)) == pytest.approx(area, rel=2e-4)
    # tangential springs alone are idle where the tooth's end is pressed
    tangential = contact(half, ("winding", "overhang"), 0.0, 1.0)
    assert 2 * slots * (lift @ (tangential.matrix @ lift)) == pytest.approx(area - slots * ends, rel=2e-4)


def test_a_split_stator_keeps_its_symmetries_and_a_stiff_contact_bonds_it():
    bonded = stator_mesh(5, ("stack", "wound"))
    half = split(bonded, ("winding", "overhang"))
    assert half.full_dof > bonded.full_dof
    assert [s.axial for s in harmonic_spaces(half, 1)] == ["even", "odd"]
    modes = []
    for stiffness in (1e13, 1e15, 1e17):
        joint = contact(half, ("winding", "overhang"), stiffness, stiffness).matrix
        modes.append(np.sort(symmetric_basis(assemble(half), MATERIALS, 2000.0, contact=joint).values)[6:14])
    exact = np.sort(symmetric_basis(assemble(bonded), MATERIALS, 2000.0).values)[6:14]
    assert np.all(modes[0] < modes[1])
    np.testing.assert_allclose(modes[2], exact, rtol=1e-4)


def test_no_contact_is_one_clear_error():
    with pytest.raises(SolverError, match="split the mesh"):
        contact(stator_mesh(5, ("stack", "wound")), ("winding",), 1.0, 1.0)


def changes(kind, strength):
    half = stack().half
    if kind == "lump":
        return lump(half, 0.9, 0.03, strength)
    if kind == "strip":
        return strip(layers(), 0.9, width=0.2, depth=0.004, ratio=1.0 + strength)
    return wave(half, core(), 0.9, harmonic=3, amplitude=strength, inner=0.05)


def rate(kind, at, step):
    """What a change grows by; a strip's is not linear where it covers pieces in part."""
    if kind != "strip":
        return changes(kind, 1.0)
    low, high = (changes(kind, s) for s in (at - step, at + step))
    return replace(high, weights=(high.weights - low.weights) / (2 * step))


@pytest.mark.parametrize(
    ("kind", "at", "step"), [("lump", 0.1, 1e-4), ("strip", -0.2, 1e-4), ("wave", 0.1, 1e-4)]
)
def test_slopes_are_finite_differences(kind, at, step):
    if kind == "strip":
        # softer pieces bring probes of their own with them
        start = solve_broken(basis(), [changes(kind, -0.5)], tolerance=1e-6).basis
    else:
        start = solve_broken(basis(), [changes(kind, at)], tolerance=1e-6).basis
    low, here, high = (
        solve_broken(start, [changes(kind, s)], tolerance=None) for s in (at - step, at, at + step)
    )
    found = slopes(here, rate(kind, at, step))
    expected = (high.eigenvalues - low.eigenvalues) / (2 * step)
    # a static response to a lump is in the basis whatever its mass
    np.testing.assert_allclose(found[:12], expected[:12], rtol=1e-4, atol=1e-5 * np.abs(expected[:12]).max())


def test_a_truncated_basis_has_the_same_signatures():
    small = basis().truncated(9000.0)
    assert np.all(frequency_hz(small.values) <= 9000.0)
    change = changes("strip", 1.0)
    whole, part = projected(basis(), change)[0], projected(small, change)[0]
    keep = basis().values <= (2 * np.pi * 9000.0) ** 2
    np.testing.assert_allclose(part, whole[np.ix_(keep, keep)], atol=1e-9 * np.abs(whole).max())


def test_sectors_without_width_are_in_or_out():
    thin = Sectors(np.array([[0.1, 0.1]]), 6)
    share = thin.share_of_arc(0.0, 0.2)
    assert share[0, 0] == 1.0
    assert share.sum() == 1.0
