from functools import cache

import numpy as np
import pytest
import scipy.sparse as sp
from small_stators import MATERIALS, stator_mesh
from whole_changes import (
    changed,
    graded_stiffness,
    partial_contact,
    scaled_mass,
    scaled_stiffness,
    whole_stator,
)
from whole_supports import WholeSurface, frequencies

from statorhom.errors import SolverError
from statorhom.model.affine import assemble, hooke_coefficients
from statorhom.model.broken.attachments import footed_lump, lump, point_springs, springs
from statorhom.model.broken.basis import symmetric_basis
from statorhom.model.broken.cells import Sectors, cells
from statorhom.model.broken.change import PieceChange
from statorhom.model.broken.interface import contact, split
from statorhom.model.broken.layers import radial_layers
from statorhom.model.broken.pieces import elements_in
from statorhom.model.broken.solve import solve_broken
from statorhom.model.broken.variations import arc, gradient, region_mass, region_stiffness, strip, wave
from statorhom.model.supported_modes import solve_supported
from statorhom.model.supports import support_on
from statorhom.model.surface import surface_points
from statorhom.study.supports import LineSupport

LAMINATION, WINDING = ("lamination",), ("winding",)
WOUND_PARTS = ("winding", "overhang")
CONTACT = 2e13, 4e12  # N/m³
ANGLE, HEIGHT = np.deg2rad(47.0), 0.06
KINDS = {
    "stack": (lambda: stator_mesh(6), 9000.0),
    "wound": (lambda: stator_mesh(5, ("stack", "wound")), 4000.0),
    "split": (lambda: split(stator_mesh(5, ("stack", "wound")), WOUND_PARTS), 3000.0),
}


@cache
def stator(kind):
    return whole_stator(KINDS[kind][0](), MATERIALS)


@cache
def basis_of(kind):
    half = stator(kind).half
    joint = contact(half, WOUND_PARTS, *CONTACT).matrix if kind == "split" else None
    return symmetric_basis(assemble(half), MATERIALS, KINDS[kind][1], contact=joint)


def surface(w):
    return WholeSurface(w.mesh, w.half.outer_radius)


def lumped(w):
    row = sp.csr_array(surface(w).at(ANGLE, HEIGHT))
    return [lump(w.half, ANGLE, HEIGHT, 0.1)], w.K, w.M + 0.1 * row.T @ row


def on_a_foot(w):
    change = footed_lump(w.half, ANGLE, HEIGHT, 0.15, foot=0.016, height=0.01)
    near = np.deg2rad(47.0) + 0.016 / w.half.outer_radius * np.array([-0.5, 0.0, 0.5])
    rows = np.vstack([surface(w).at(a, HEIGHT + dz) for dz in (-0.008, 0.0, 0.008) for a in near])
    rows = sp.csr_array(change.rows @ rows)
    return [change], w.K, w.M + rows.T @ sp.csr_array(change.mass) @ rows


def on_lines(w):
    keys = {"name": "l", "kind": "lines", "angles_deg": (40.0, 97.3), "declared": "elastic"}
    held = support_on(w.half, LineSupport(**keys, normal_stiffness_n_per_m2=1e10, tangential_ratio=0.5))
    lines = [surface(w).line_springs(np.deg2rad(a), 1e10, 5e9) for a in (40.0, 97.3)]
    return [springs(w.half, held.points)], w.K + sum(lines), w.M


def suspended(w):
    angles, z, k = np.array([ANGLE, 2.0]), np.array([HEIGHT, 0.01]), np.array([1e6, 2e5, 3e5])
    rows = [sp.csr_array(surface(w).at(a, h)) for a, h in zip(angles, z, strict=True)]
    return [point_springs(w.half, angles, z, k)], w.K + sum(r.T @ sp.diags_array(k) @ r for r in rows), w.M


def _core(w):
    return region_stiffness(w.half, MATERIALS, LAMINATION), {
        "lamination": hooke_coefficients(MATERIALS["lamination"].hooke)
    }


def on_a_strip(ratio):
    def make(w):
        _, hooke = _core(w)
        # one layer an element: its weights are those of the whole stator's elements
        layers = radial_layers(w.half, "lamination", hooke["lamination"], 1)
        change = strip(layers, 0.7, width=np.deg2rad(10.0), depth=0.003, ratio=ratio)
        return [change], w.K + scaled_stiffness(w, LAMINATION, hooke, change.weights), w.M

    return make


def waved(w):
    core, hooke = _core(w)
    change = wave(w.half, core, 0.3, harmonic=4, amplitude=0.1, inner=0.051)
    return [change], w.K + scaled_stiffness(w, LAMINATION, hooke, change.weights), w.M


def pressed(w):
    """G_rz falls towards the upper end."""
    steel = MATERIALS["lamination"]
    soft = changed(steel, c44=0.3 * steel.hooke.matrix[3, 3], c55=0.3 * steel.hooke.matrix[4, 4])
    surplus = hooke_coefficients(soft.hooke) - hooke_coefficients(steel.hooke)

    def share(z):
        return z / w.half.length

    change = gradient(radial_layers(w.half, "lamination", surplus, 1, by_height=True), share)
    return [change], w.K + graded_stiffness(w, "lamination", surplus, share), w.M


def loosened(ratio):
    def make(w):
        place = cells(w.half, elements_in(w.half, WINDING))
        change = arc(region_stiffness(w.half, MATERIALS, WINDING), place, 0.3, 0.3 + np.pi / 2, ratio)
        hooke = {"winding": hooke_coefficients(MATERIALS["winding"].hooke)}
        return [change], w.K + scaled_stiffness(w, WINDING, hooke, change.weights), w.M

    return make


def debonded(w):
    joint = contact(w.half, WOUND_PARTS, *CONTACT)
    # the ends of the arc lie where no face is cut
    start, end = np.pi / 5 * np.array([1.0, 5.0])
    change = arc(joint.pieces, Sectors(joint.angle, w.half.slots), start, end, 0.02)
    return [change], w.K + partial_contact(w, WOUND_PARTS, *CONTACT, start, end, 0.02), w.M


def light(w):
    """Part of the winding's mass does not move along."""
    mass = region_mass(w.half, MATERIALS, WINDING)
    weights = np.full((len(mass), 2 * w.half.slots), -0.6)
    change = PieceChange(None, mass, weights)
    return [change], w.K, w.M + scaled_mass(w, WINDING, MATERIALS, weights)


def loosened_with_lump(w):
    changes, K, _ = loosened(0.2)(w)
    more, _, M = lumped(w)
    return [*changes, *more], K, M


CASES = {
    "lump": ("stack", lumped),
    "lump on a foot": ("stack", on_a_foot),
    "two elastic lines": ("stack", on_lines),
    "suspension": ("stack", suspended),
    "stiff strip": ("stack", on_a_strip(6.0)),
    "soft strip": ("stack", on_a_strip(0.3)),
    "wave": ("stack", waved),
    "pressure gradient": ("stack", pressed),
    "loose arc": ("wound", loosened(0.1)),
    "debonded arc": ("split", debonded),
    "light winding": ("wound", light),
    "loose arc and lump": ("wound", loosened_with_lump),
}


@cache
def solved(case):
    kind, make = CASES[case]
    changes, K, M = make(stator(kind))
    return changes, solve_broken(basis_of(kind), changes), sp.csr_array(K), sp.csr_array(M)


# a band that ends amid a crowd of modes of loose windings takes many enrichments
SLOW = {"loose arc"}
MARKED = [pytest.param(case, marks=[pytest.mark.slow] if case in SLOW else []) for case in CASES]


@pytest.mark.parametrize("case", MARKED)
def test_frequencies_are_the_whole_stators(case):
    highest_hz = KINDS[CASES[case][0]][1]
    _, found, K, M = solved(case)
    exact = frequencies(K, M, 1.002 * highest_hz, len(found) + 8)
    assert len(found) >= 4
    assert np.count_nonzero(exact < highest_hz / 1.001) <= len(found) <= len(exact)
    error = found.frequencies_hz / exact[: len(found)] - 1
    assert np.all(error > -1e-7)  # upper bounds
    assert np.all(error < 1e-3)
    assert np.all(found.errors < 1e-3)
    assert np.all(error < 1.5 * found.errors + 1e-7)
    worst = np.argmax(found.errors)
    assert error[worst] > 0.01 * found.errors[worst] - 1e-7  # nor is the estimate idle


@pytest.mark.parametrize(
    "case", ["lump", "two elastic lines", "soft strip", "debonded arc", "loose arc and lump"]
)
def test_whole_shapes_are_orthonormal_and_store_their_eigenvalue(case):
    _, found, K, M = solved(case)
    half = found.basis.mesh
    shapes = np.array([found.shapes.full_shape(half, i).ravel() for i in range(len(found))]).T
    np.testing.assert_allclose(shapes.T @ (M @ shapes), np.eye(len(found)), atol=1e-7)
    np.testing.assert_allclose(
        shapes.T @ (K @ shapes), np.diag(found.eigenvalues), atol=1e-6 * found.eigenvalues[-1]
    )


@pytest.mark.parametrize("case", ["stiff strip", "pressure gradient", "debonded arc"])
def test_the_symmetric_modes_alone_are_known_to_be_too_few(case):
    changes, found, K, M = solved(case)
    plain = solve_broken(basis_of(CASES[case][0]), changes, tolerance=None)
    assert np.any(plain.errors > 1e-3)
    assert len(found.basis.values) > len(plain.basis.values)
    exact = frequencies(K, M, KINDS[CASES[case][0]][1], len(found) + 8)
    count = min(len(exact), len(plain))
    assert (plain.frequencies_hz[:count] / exact[:count] - 1).max() > 1e-3


def test_elastic_lines_are_those_of_supported_modes():
    changes, found, _, _ = solved("two elastic lines")
    assert len(changes) == 1
    keys = {"name": "l", "kind": "lines", "angles_deg": (40.0, 97.3), "declared": "elastic"}
    lines = LineSupport(**keys, normal_stiffness_n_per_m2=1e10, tangential_ratio=0.5)
    half = stator("stack").half
    other = solve_supported(assemble(half), MATERIALS, support_on(half, lines), KINDS["stack"][1])
    difference = found.frequencies_hz / other.frequencies_hz - 1
    assert np.all(np.abs(difference) < found.errors + other.errors)
    assert np.all(np.abs(difference[:15]) < 1e-4)


def test_a_basis_enriched_at_one_angle_serves_every_other_pitch():
    w, basis = stator("wound"), basis_of("wound")
    pieces = region_stiffness(w.half, MATERIALS, WINDING)
    place = cells(w.half, elements_in(w.half, WINDING))
    pitch = 2 * np.pi / w.half.slots
    first = solve_broken(basis, [arc(pieces, place, 0.3, 1.5, 0.1)])
    turned = solve_broken(first.basis, [arc(pieces, place, 0.3 + 2 * pitch, 1.5 + 2 * pitch, 0.1)])
    mirrored = solve_broken(first.basis, [arc(pieces, place, -1.5, -0.3, 0.1)])
    assert turned.basis is first.basis
    assert mirrored.basis is first.basis
    np.testing.assert_allclose(turned.frequencies_hz, first.frequencies_hz, rtol=1e-9)
    np.testing.assert_allclose(mirrored.frequencies_hz, first.frequencies_hz, rtol=1e-4)


def test_a_tighter_tolerance_is_met():
    changes, _, K, M = solved("stiff strip")
    found = solve_broken(basis_of("stack"), changes, tolerance=1e-5)
    exact = frequencies(K, M, KINDS["stack"][1], len(found) + 8)[: len(found)]
    assert np.all(found.errors < 1e-5)
    np.testing.assert_allclose(found.frequencies_hz, exact, rtol=1e-5)


def test_changes_that_are_nowhere_together_may_lose_more_than_there_is():
    """Two soft arcs, each as a change of its own, and as one change."""
    w, basis = stator("stack"), basis_of("stack")
    pieces = region_stiffness(w.half, MATERIALS, LAMINATION)
    place = cells(w.half, elements_in(w.half, LAMINATION))
    arcs = [arc(pieces, place, start, start + 0.6, 0.2) for start in (0.3, 3.0)]
    twin = PieceChange(region_stiffness(w.half, MATERIALS, LAMINATION), None, arcs[1].weights)
    together = PieceChange(pieces, None, arcs[0].weights + arcs[1].weights)
    apart = solve_broken(basis, [arcs[0], twin])
    one = solve_broken(basis, [together])
    np.testing.assert_allclose(apart.frequencies_hz, one.frequencies_hz, rtol=1e-3)


def test_surface_motion_is_the_whole_shapes():
    _, found, _, _ = solved("loose arc and lump")
    w = stator("wound")
    on = surface(w)
    nodes = np.unique(np.concatenate([face for face, *_ in on.faces]))
    points = surface_points(w.half, on.angle[nodes], on.z[nodes])
    shapes = np.array([found.shapes.full_shape(w.half, i)[nodes] for i in range(len(found))])
    motion = np.moveaxis(found.shapes.motion(points), 2, 0)
    np.testing.assert_allclose(motion, shapes, atol=1e-8 * np.abs(shapes).max())


def test_more_mass_taken_away_than_there_is_is_one_clear_error():
    w = stator("stack")
    with pytest.raises(SolverError, match="mass or a stiffness that is not positive"):
        solve_broken(basis_of("stack"), [lump(w.half, ANGLE, HEIGHT, -50.0)])


def test_results_are_read_only():
    _, found, _, _ = solved("lump")
    with pytest.raises(ValueError, match="read-only"):
        found.errors[0] = 0.0
    with pytest.raises(AttributeError):
        found.basis = None


def cartesian(w, modes, number):
    """Motion of a mode at the whole stator's nodes, as one column."""
    x, y = w.mesh.nodes[:, 0], w.mesh.nodes[:, 1]
    radius = np.hypot(x, y)
    u_r, u_t, u_z = modes.shapes.full_shape(w.half, number).T
    return np.column_stack([u_r * x - u_t * y, u_r * y + u_t * x, u_z * radius]).ravel() / np.repeat(
        radius, 3
    )


def test_a_mode_s_part_of_another_is_their_product_by_mass():
    """Static responses to a heavy lump's forces hold much of the low modes: coordinates alone tell another story."""
    w, basis = stator("stack"), basis_of("stack")
    free = solve_broken(basis, [], tolerance=None)
    heavy = footed_lump(w.half, ANGLE, HEIGHT, 1.0, foot=0.016, height=0.01)
    broken = solve_broken(basis, [heavy], tolerance=None)
    size = len(basis.values)
    chosen = range(min(6, len(free)))
    found = free.participation[:, chosen].T @ broken.participation
    expected = [
        [cartesian(w, free, i) @ (w.M @ cartesian(w, broken, j)) for j in range(len(broken))] for i in chosen
    ]
    np.testing.assert_allclose(found, expected, atol=2e-3)
    assert np.abs(found).max() < 1.0 + 1e-6
    coordinates = free.coordinates[:size, chosen].T @ broken.coordinates[:size]
    assert np.abs(coordinates - found).max() > 0.05
