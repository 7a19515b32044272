import pickle
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
import scipy.sparse as sp
from small_stators import MATERIALS, assemble_whole, geometry, stator_mesh
from whole_supports import WholeSurface, constrained, face_nodes, face_springs, frequencies

from statorhom.materials.hooke import Hooke
from statorhom.mesh import MeshDensity, mesh_step, uniform
from statorhom.mesh.density import COARSEST
from statorhom.model.affine import AffineModel, Material, assemble
from statorhom.model.free_modes import solve_free, total_mass
from statorhom.model.supported_modes import HarmonicTask, solve_supported
from statorhom.model.supports import support_on
from statorhom.model.surface import surface_points, surface_radius
from statorhom.study.supports import FaceSupport, LineSupport

ALL = MATERIALS | {"frame": MATERIALS["lamination"]}


def _lopsided():
    """A frame that covers one end more than the other: no mirror symmetry about the core's middle."""
    frame = {"inner_diameter_mm": 120.0, "outer_diameter_mm": 130.0, "length_mm": 70.0, "offset_mm": -20.0}
    slots = {"shape": "parallel_tooth", "count": 4, "tooth_width_mm": 12.0}
    return mesh_step(geometry(slots, frame=frame).step(("stack", "framed")), uniform(1))


STATORS = {
    "stack": (lambda: stator_mesh(6), 9000.0),
    "wound": (lambda: stator_mesh(5, ("stack", "wound")), 3000.0),
    "wound, high": (lambda: stator_mesh(4, ("stack", "wound")), 9000.0),
    "graded": (lambda: stator_mesh(5, density=MeshDensity(COARSEST | {"slot": 2}, 4.0, 4.0)), 9000.0),
    "framed": (_lopsided, 9000.0),
}


@dataclass(frozen=True)
class Whole:
    model: AffineModel
    mesh: object
    K: sp.csr_array
    M: sp.csr_array
    surface: WholeSurface
    highest_hz: float


@cache
def whole(name):
    make, highest_hz = STATORS[name]
    half = make()
    mesh, _, _ = half.full()
    return Whole(
        assemble(half), mesh, *assemble_whole(mesh, ALL), WholeSurface(mesh, surface_radius(half)), highest_hz
    )


def lines(*angles_deg, stiffness=None, ratio=1.0):
    keys = {"name": "test", "kind": "lines", "angles_deg": angles_deg, "declared": "rigid"}
    if stiffness is not None:
        keys |= {"declared": "elastic", "normal_stiffness_n_per_m2": stiffness, "tangential_ratio": ratio}
    return LineSupport.model_validate(keys)


def faces(*ends, arcs=(), stiffness=None, ratio=1.0):
    keys = {"name": "test", "kind": "faces", "faces": ends, "arcs_deg": arcs, "declared": "rigid"}
    if stiffness is not None:
        keys |= {"declared": "elastic", "normal_stiffness_n_per_m3": stiffness, "tangential_ratio": ratio}
    return FaceSupport.model_validate(keys)


@cache
def solve(name, keys, **options):
    w = whole(name)
    return solve_supported(w.model, ALL, support_on(w.model.mesh, keys), w.highest_hz, **options)


@cache
def reference(name, keys):
    """Stiffness and mass of the whole stator on the support, and its springs."""
    w = whole(name)
    elastic = keys.declared == "elastic"
    if isinstance(keys, LineSupport):
        angles = np.deg2rad(keys.angles_deg)
        if not elastic:
            return constrained(w.K, w.M, np.vstack([w.surface.line(a) for a in angles]))
        k = keys.normal_stiffness_n_per_m2
        return w.K + sum(w.surface.line_springs(a, k, k * keys.tangential_ratio) for a in angles), w.M
    arcs = np.deg2rad(keys.arcs_deg).reshape(-1, 2)
    ends = [{"lower_end": 0.0, "upper_end": w.model.mesh.length}[face] for face in keys.faces]
    if not elastic:
        conditions = np.vstack([w.surface.arc(*arc) for arc in arcs]) if len(arcs) else None
        nodes = np.concatenate([face_nodes(w.mesh, z) for z in ends]) if ends else np.empty(0, dtype=int)
        return constrained(w.K, w.M, conditions, (3 * nodes[:, None] + np.arange(3)).ravel())
    k, t = keys.normal_stiffness_n_per_m3, keys.normal_stiffness_n_per_m3 * keys.tangential_ratio
    springs = [w.surface.arc_springs(*arc, k, t) for arc in arcs] + [
        face_springs(w.mesh, z, k, t) for z in ends
    ]
    return w.K + sum(springs), w.M


CASES = {
    "rigid lines": ("stack", lines(40.0, 97.3)),
    "one rigid line at a node": ("stack", lines(30.0)),
    "lines of a wound stator": ("wound", lines(158.0, 202.0)),
    "lines of a lopsided frame": ("framed", lines(-20.0, 77.0)),
    "elastic lines of a graded mesh": ("graded", lines(51.0, 110.0, stiffness=2e10, ratio=0.4)),
    "elastic arc of a graded mesh": ("graded", faces(arcs=[(51.0, 110.0)], stiffness=2e11, ratio=0.4)),
    "soft lines": ("stack", lines(10.0, 100.0, 250.0, stiffness=1e7, ratio=0.3)),
    "medium lines": ("stack", lines(40.0, 97.3, stiffness=1e9, ratio=0.5)),
    "stiff lines": ("stack", lines(40.0, 97.3, stiffness=1e11)),
    "lines that resist radially only": ("stack", lines(40.0, 97.3, stiffness=1e10, ratio=0.0)),
    "rigid arc": ("stack", faces(arcs=[(-17.0, 33.0)])),
    "elastic arcs": ("stack", faces(arcs=[(100.0, 155.0), (340.0, 371.0)], stiffness=1e11, ratio=0.2)),
    "rigid lower end": ("stack", faces("lower_end")),
    "elastic upper end": ("stack", faces("upper_end", stiffness=3e10, ratio=0.5)),
    "both ends rigid": ("wound, high", faces("lower_end", "upper_end")),
    "rigid end and arc": ("stack", faces("lower_end", arcs=[(95.0, 155.0)])),
    "elastic end of a lopsided frame": ("framed", faces("lower_end", stiffness=1e10)),
}


@pytest.mark.parametrize("case", CASES)
def test_frequencies_are_the_whole_stators(case):
    name, keys = CASES[case]
    found = solve(name, keys)
    K, M = reference(name, keys)
    highest_hz = whole(name).highest_hz
    exact = frequencies(K, M, 1.002 * highest_hz, len(found) + 4)
    assert len(found) >= 4
    assert np.count_nonzero(exact < highest_hz / 1.001) <= len(found) <= len(exact)
    error = found.frequencies_hz / exact[: len(found)] - 1
    assert np.all(error > -1e-7)  # upper bounds
    assert np.all(error < 1e-3)
    assert np.all(error < found.errors + 1e-7)
    worst = np.argmax(found.errors)
    assert error[worst] > 0.02 * found.errors[worst] - 1e-7  # nor is the estimate idle


def shapes_of(found, half):
    return np.array([found.full_shape(half, i).ravel() for i in range(len(found))]).T


@pytest.mark.parametrize(
    "case", ["medium lines", "elastic arcs", "elastic upper end", "lines of a wound stator"]
)
def test_whole_shapes_are_orthonormal_and_store_their_eigenvalue(case):
    name, keys = CASES[case]
    w, found = whole(name), solve(name, keys)
    K = reference(name, keys)[0] if keys.declared == "elastic" else w.K
    shapes = shapes_of(found, w.model.mesh)
    np.testing.assert_allclose(shapes.T @ (w.M @ shapes), np.eye(len(found)), atol=1e-7)
    stored = shapes.T @ (K @ shapes)
    scale = (2 * np.pi * found.frequencies_hz) ** 2
    np.testing.assert_allclose(stored, np.diag(scale), atol=1e-6 * scale[-1])


@pytest.mark.parametrize(
    "case", ["rigid lines", "rigid arc", "rigid lower end", "both ends rigid", "rigid end and arc"]
)
def test_what_a_rigid_support_holds_does_not_move(case):
    name, keys = CASES[case]
    w, found = whole(name), solve(name, keys)
    shapes = shapes_of(found, w.model.mesh)
    rows = [np.zeros((0, w.K.shape[0]))]
    if isinstance(keys, LineSupport):
        rows += [w.surface.line(a) for a in np.deg2rad(keys.angles_deg)]
    else:
        rows += [w.surface.arc(*np.deg2rad(arc)) for arc in keys.arcs_deg]
        heights = {"lower_end": 0.0, "upper_end": w.model.mesh.length}
        for end in keys.faces:
            nodes = face_nodes(w.mesh, heights[end])
            rows.append(np.eye(w.K.shape[0])[(3 * nodes[:, None] + np.arange(3)).ravel()])
    held = np.vstack(rows) @ shapes
    assert np.abs(held).max() < 1e-7 * np.abs(shapes).max()


def test_motion_at_nodes_of_the_surface_is_the_whole_shapes():
    name, keys = CASES["rigid lines"]
    w, found = whole(name), solve(name, keys)
    nodes = np.unique(np.concatenate([face for face, *_ in w.surface.faces]))
    points = surface_points(w.model.mesh, w.surface.angle[nodes], w.surface.z[nodes])
    shapes = shapes_of(found, w.model.mesh).reshape(-1, 3, len(found))[nodes]
    np.testing.assert_allclose(found.motion(points), shapes, atol=1e-8 * np.abs(shapes).max())


def test_energy_shares_are_the_whole_stators():
    name, keys = CASES["lines of a wound stator"]
    w, found = whole(name), solve(name, keys)
    shapes = shapes_of(found, w.model.mesh)
    nothing = Material(Hooke(1e-9 * MATERIALS["winding"].hooke.matrix), 1e-9)
    strain = found.strain_energy_shares(w.model, ALL)
    kinetic = found.kinetic_energy_shares(w.model, ALL)
    assert set(strain) == set(kinetic) == {"lamination", "winding", "overhang"}
    np.testing.assert_allclose(sum(strain.values()), 1.0)
    for region in ("lamination", "overhang"):
        K, M = assemble_whole(w.mesh, dict.fromkeys(ALL, nothing) | {region: ALL[region]})
        for shares, part, total in ((strain, K, w.K), (kinetic, M, w.M)):
            expected = np.sum(shapes * (part @ shapes), axis=0) / np.sum(shapes * (total @ shapes), axis=0)
            np.testing.assert_allclose(shares[region], expected, rtol=1e-6, atol=1e-8)


def test_stiff_springs_tend_to_the_rigid_support_from_below():
    rigid = solve("stack", lines(40.0, 97.3)).frequencies_hz[:8]
    last = np.zeros(8)
    for stiffness in (1e8, 1e11, 1e14):
        found = solve("stack", lines(40.0, 97.3, stiffness=stiffness)).frequencies_hz[:8]
        assert np.all(found > last * (1 - 1e-9))
        assert np.all(found < rigid * (1 + 1e-9))
        last = found
    np.testing.assert_allclose(last, rigid, rtol=1e-3)
    beyond = solve("stack", lines(40.0, 97.3, stiffness=1e20)).frequencies_hz[:8]
    np.testing.assert_allclose(beyond, rigid, rtol=1e-8)


def test_on_soft_springs_the_stator_is_a_rigid_mass():
    w = whole("stack")
    normal, ratio = 1e4, 0.25
    found = solve("stack", lines(0.0, 90.0, 180.0, 270.0, stiffness=normal, ratio=ratio)).frequencies_hz
    mass, springs = total_mass(w.model, ALL), 4 * normal * w.model.mesh.length
    lift = np.sqrt(ratio * springs / mass) / (2 * np.pi)
    sway = np.sqrt((1 + ratio) / 2 * springs / mass) / (2 * np.pi)
    assert np.min(np.abs(found / lift - 1)) < 1e-4
    assert np.count_nonzero(np.abs(found / sway - 1) < 1e-4) == 2
    free = [
        m.frequency_hz for m in solve_free(w.model, ALL, w.highest_hz).modes for _ in range(m.multiplicity)
    ]
    np.testing.assert_allclose(found[6:], np.sort(free), rtol=1e-4)


def test_lines_that_move_by_a_pitch_give_the_same_frequencies():
    first, second = (
        solve("stack", lines(*angles)).frequencies_hz for angles in ((7.0, 50.0), (127.0, 170.0))
    )
    np.testing.assert_allclose(first, second, rtol=1e-9)


def test_lines_mirrored_about_a_tooth_give_the_same_frequencies():
    first, second = (solve("stack", lines(*angles)).frequencies_hz for angles in ((7.0, 50.0), (-7.0, -50.0)))
    np.testing.assert_allclose(first, second, rtol=1e-9)


def test_a_wider_margin_lowers_the_frequencies_and_the_estimated_errors():
    narrow, wide = (solve("stack", lines(40.0, 97.3), margin=margin) for margin in (1.3, 2.5))
    assert len(narrow) == len(wide)
    assert np.all(wide.frequencies_hz <= narrow.frequencies_hz * (1 + 1e-9))
    assert np.all(wide.errors < narrow.errors)
    # the wide one stands for the truth
    assert np.all(narrow.frequencies_hz / wide.frequencies_hz - 1 < narrow.errors)


def test_a_low_band_has_the_first_modes_of_a_wide_one():
    w = whole("stack")
    support = support_on(w.model.mesh, lines(40.0, 97.3))
    wide = solve_supported(w.model, ALL, support, 9000.0).frequencies_hz
    low = solve_supported(w.model, ALL, support, 1.01 * wide[0])
    np.testing.assert_allclose(low.frequencies_hz, wide[:1], rtol=1e-3)
    assert len(solve_supported(w.model, ALL, support, 0.5 * wide[0])) == 0


def test_harmonics_can_be_solved_anywhere():
    keys = lines(40.0, 97.3)

    class Sent:
        """Every harmonic's task sent away, as to another process."""

        def __call__(self, task, orders):
            assert isinstance(task, HarmonicTask)
            with ThreadPoolExecutor(2) as pool:
                yield from pool.map(pickle.loads(pickle.dumps(task)), orders)

    sent, here = (solve("stack", keys, mapper=mapper).frequencies_hz for mapper in (Sent(), map))
    np.testing.assert_allclose(sent, here, rtol=1e-10)


def test_results_are_read_only():
    found = solve("stack", lines(40.0, 97.3))
    with pytest.raises(ValueError, match="read-only"):
        found.frequencies_hz[0] = 0.0
    with pytest.raises(AttributeError):
        found.errors = None
