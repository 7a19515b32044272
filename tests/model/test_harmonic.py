import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.spatial import cKDTree
from small_stators import (
    MATERIALS,
    assemble_whole,
    expand_whole,
    geometry,
    rigid_bodies,
    ring_mesh,
    stator_mesh,
)

from statorhom.mesh import mesh_step, uniform
from statorhom.model.affine import assemble
from statorhom.model.eigen import modes_below
from statorhom.model.harmonic import all_orders, harmonic_spaces

# soft windings have many modes: a shorter band holds enough of them
BANDS_HZ = {"stack": 12000.0, "wound": 5000.0, "framed": 10000.0}


def _lopsided(count):
    """A frame that covers one end more than the other: no mirror symmetry about the core's middle."""
    frame = {"inner_diameter_mm": 120.0, "outer_diameter_mm": 130.0, "length_mm": 70.0, "offset_mm": -20.0}
    slots = {"shape": "parallel_tooth", "count": count, "tooth_width_mm": 12.0}
    return mesh_step(geometry(slots, frame=frame).step(("stack", "framed")), uniform(1))


CASES = {
    "stack, even N": lambda: stator_mesh(4),
    "stack, odd N": lambda: stator_mesh(5),
    "wound, even N": lambda: stator_mesh(4, ("stack", "wound")),
    "wound, odd N": lambda: stator_mesh(5, ("stack", "wound")),
    "framed, even N": lambda: _lopsided(4),
}


class Solved:
    """All harmonics of a small stator below a frequency, and the whole stator as one eigenproblem."""

    def __init__(self, half, highest_hz):
        self.half, self.highest_hz = half, highest_hz
        materials = MATERIALS | {"frame": MATERIALS["lamination"]}
        model = assemble(half)
        K, M = model.stiffness_matrix(materials), model.mass_matrix(materials)
        self.parts = []
        for order in all_orders(half.slots):
            for space in harmonic_spaces(half, order):
                k, m = space.project(K), space.project(M)
                self.parts.append((space, m, *modes_below(k, m, highest_hz)))
        self.mesh, self.source, self.copy = half.full()
        self.K, self.M = assemble_whole(self.mesh, materials)


@pytest.fixture(scope="module", params=CASES)
def solved(request):
    return Solved(CASES[request.param](), BANDS_HZ[request.param.split(",")[0]])


def test_harmonics_have_the_whole_stators_eigenvalues_with_their_multiplicities(solved):
    top = (2 * np.pi * solved.highest_hz) ** 2
    cyclic = np.sort(np.concatenate([np.repeat(v, s.multiplicity) for s, _, v, _ in solved.parts]))
    whole, _ = modes_below(solved.K, solved.M, solved.highest_hz, len(cyclic) + 8)
    assert len(cyclic) == len(whole) > 20
    np.testing.assert_allclose(cyclic, whole, rtol=1e-8, atol=1e-9 * top)


def test_real_and_imaginary_part_of_a_shape_are_the_whole_stators_modes(solved):
    scale = abs(solved.K).sum(axis=1).max()
    for space, _, values, y in solved.parts:
        shapes = expand_whole(space, y, solved.source, solved.copy)
        for part in (shapes.real, shapes.imag):
            residual = solved.K @ part - values * (solved.M @ part)
            assert np.abs(residual).max(initial=0) <= 1e-9 * scale * np.abs(shapes).max(initial=0)
        if space.multiplicity == 2:
            # the two are the independent shapes of a doublet: of equal norm and orthogonal
            cosine, sine = shapes.real, shapes.imag
            norms = [
                np.sum(a * (solved.M @ b), axis=0)
                for a, b in ((cosine, cosine), (sine, sine), (cosine, sine))
            ]
            np.testing.assert_allclose(norms[0], norms[1], rtol=1e-8)
            assert np.all(np.abs(norms[2]) < 1e-8 * norms[0])


def test_copies_turn_the_halfs_norm_into_the_whole_stators_modal_mass(solved):
    for space, m, _, y in solved.parts:
        shapes = expand_whole(space, y, solved.source, solved.copy)
        small = np.sum(y * (m @ y), axis=0)
        parts = [shapes.real, shapes.imag] if space.multiplicity == 2 else [shapes.real + shapes.imag]
        for part in parts:
            np.testing.assert_allclose(
                np.sum(part * (solved.M @ part), axis=0), space.copies * small, rtol=1e-9
            )


def test_the_harmonics_share_all_degrees_of_freedom_out(solved):
    total = sum(space.multiplicity * space.size for space, *_ in solved.parts)
    assert total == solved.half.full_dof == solved.K.shape[0]


def test_every_coordinate_moves_something_and_none_is_redundant(solved):
    for space, m, _, _ in solved.parts:
        assert np.linalg.eigvalsh(m.toarray())[0] > 0
        assert space.size == space.real.shape[1] == space.imaginary.shape[1]


def test_rigid_bodies_are_where_a_free_stator_has_them(solved):
    found = {}
    for space, _, values, y in solved.parts:
        rigid = values < 1e-8 * (2 * np.pi * solved.highest_hz) ** 2
        if rigid.any():
            shapes = expand_whole(space, y[:, rigid], solved.source, solved.copy)
            found.setdefault(space.order, []).append(np.hstack([shapes.real, shapes.imag]))
    # turning about and moving along the axis in h = 0, the other four in h = 1
    assert sorted(found) == [0, 1]
    shapes = np.hstack([s for group in found.values() for s in group])
    bodies = rigid_bodies(solved.mesh.nodes - [0, 0, solved.half.length / 2]).T
    outside = bodies - shapes @ np.linalg.lstsq(shapes, bodies)[0]
    assert np.abs(outside).max() < 1e-6 * np.abs(bodies).max()
    assert np.linalg.matrix_rank(shapes, tol=1e-6 * np.linalg.norm(shapes)) == 6


@pytest.mark.parametrize("order", [0, 1, 2])
def test_a_harmonic_moves_pitch_by_pitch_with_its_phase(solved, order):
    rng = np.random.default_rng(order)
    pitch = 2 * np.pi / solved.half.slots
    for space in harmonic_spaces(solved.half, min(order, solved.half.slots // 2)):
        shape = expand_whole(space, rng.standard_normal(space.size), solved.source, solved.copy).reshape(
            -1, 3
        )
        position = solved.mesh.nodes
        turn = np.array([[np.cos(pitch), -np.sin(pitch), 0], [np.sin(pitch), np.cos(pitch), 0], [0, 0, 1]])
        distance, follower = cKDTree(position).query(position @ turn.T)
        assert distance.max() < 1e-12
        np.testing.assert_allclose(shape[follower], shape * np.exp(1j * space.order * pitch), atol=1e-12)


def test_projection_keeps_what_the_expanded_shape_stores():
    half = stator_mesh(5)
    model = assemble(half)
    K = model.stiffness_matrix(MATERIALS)
    rng = np.random.default_rng(8)
    for order in all_orders(5):
        for space in harmonic_spaces(half, order):
            y = rng.standard_normal(space.size)
            shape = space.expand(y)
            energy = np.vdot(shape, K @ shape)
            assert energy.imag == pytest.approx(0, abs=1e-10 * energy.real)
            assert y @ (space.project(K) @ y) == pytest.approx(energy.real, rel=1e-11)


@pytest.mark.parametrize("sectors", [4, 5])
def test_the_harmonics_dense_spectra_are_the_whole_one(sectors):
    half = ring_mesh(120.0, 80.0, 60.0, radial=1, axial=2, sectors=sectors)
    model = assemble(half)
    K, M = model.stiffness_matrix(MATERIALS), model.mass_matrix(MATERIALS)
    spectrum = []
    for order in all_orders(sectors):
        for space in harmonic_spaces(half, order):
            values = eigh(space.project(K).toarray(), space.project(M).toarray(), eigvals_only=True)
            spectrum.append(np.repeat(values, space.multiplicity))
    mesh, _, _ = half.full()
    whole_K, whole_M = assemble_whole(mesh, MATERIALS)
    whole = eigh(whole_K.toarray(), whole_M.toarray(), eigvals_only=True)
    # the whole spectrum, from the rigid bodies to the mesh's last and meaningless mode
    np.testing.assert_allclose(np.sort(np.concatenate(spectrum)), whole, rtol=1e-9, atol=1e-10 * whole[-1])


def test_all_orders_end_at_half_the_number_of_slots():
    assert list(all_orders(36)) == list(range(19))
    assert list(all_orders(5)) == [0, 1, 2]
