"""All harmonics solved together, against each harmonic's own matrices solved whole."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.linalg import eigh
from small_stators import MATERIALS, stator_mesh

from statorhom.errors import SolverError
from statorhom.model.affine import assemble
from statorhom.model.cyclic.condensed import condensed, counted, eliminated, modes_under, multiplied
from statorhom.model.cyclic.half_pitch import columns, half_pitch, half_pitches, phases
from statorhom.model.cyclic.modes import modes_of
from statorhom.model.harmonic import all_orders, spaces_of
from statorhom.model.pitch_parts import pitch_parts

TOP_HZ = 7000.0


class Stator:
    """All harmonics of a small stator, each with its own matrices and their dense eigenvalues."""

    def __init__(self, slots, uneven):
        mesh = stator_mesh(slots)
        if uneven:  # one element of another material: the two ends differ
            region = mesh.region.copy()
            region[0] = 1
            mesh = replace(mesh, region=region, regions=("lamination", "winding"))
        model = assemble(mesh)
        self.K, self.M = model.stiffness_matrix(MATERIALS), model.mass_matrix(MATERIALS)
        self.parts = pitch_parts(mesh)
        self.pitches = half_pitches(self.parts, self.K, self.M)
        self.spaces = [s for order in all_orders(slots) for s in spaces_of(self.parts, order)]
        self.pairs = [(s.project(self.K), s.project(self.M)) for s in self.spaces]
        self.values = [eigh(K.toarray(), M.toarray(), eigvals_only=True) for K, M in self.pairs]


@pytest.fixture(
    scope="module", params=[(6, False), (7, False), (6, True)], ids=["even", "odd", "uneven ends"]
)
def stator(request):
    return Stator(*request.param)


def _top(hz):
    return (2 * np.pi * hz) ** 2


def test_every_mode_of_the_band_is_found_in_its_harmonics_own_coordinates(stator):
    found = modes_of(stator.pitches, stator.spaces, TOP_HZ)
    scale = _top(TOP_HZ)
    for (values, y), (K, M), exact in zip(found, stator.pairs, stator.values, strict=True):
        inside = exact[exact <= scale]
        np.testing.assert_allclose(values, inside, rtol=1e-9, atol=1e-10 * scale)
        np.testing.assert_allclose(y.T @ (M @ y), np.eye(len(inside)), atol=1e-10)
        np.testing.assert_allclose(y.T @ (K @ y), np.diag(values), atol=1e-9 * scale)
        residual = K @ y - (M @ y) * values
        np.testing.assert_allclose(np.abs(residual).max(initial=0.0), 0.0, atol=1e-7 * np.abs(K).max())


def test_rigid_bodies_that_coincide_in_one_problem_are_both_found():
    # where the ends differ, moving across and tilting are one problem's two modes at rest
    stator = Stator(6, True)
    number = next(i for i, s in enumerate(stator.spaces) if s.order == 1)
    ((values, y),) = modes_of(stator.pitches, [stator.spaces[number]], 1000.0)
    assert len(values) == 2
    assert np.abs(values).max() < 1e-8 * _top(1000.0)
    assert np.linalg.matrix_rank(y) == 2


@pytest.mark.parametrize("hz", [500.0, 2500.0, 6000.0, 20000.0])
def test_the_number_of_modes_is_known_before_they_are(stator, hz):
    for part in stator.parts:
        pitch = half_pitch(part, stator.K, stator.M)
        mine = [i for i, s in enumerate(stator.spaces) if s.axial == part.axial]
        shifted = [(family, eliminated(pitch, family, -_top(hz)).order) for family in (pitch.a, pitch.b)]
        a, b = (counted(pitch, family, order, _top(hz)) for family, order in shifted)
        counts = modes_under(phases(pitch, tuple(stator.spaces[i] for i in mine)), a, b)
        np.testing.assert_array_equal(counts, [np.sum(stator.values[i] < _top(hz)) for i in mine])


def test_what_one_factorization_leaves_on_the_slots_plane_is_what_solving_for_it_leaves(stator):
    value = -0.1 * _top(TOP_HZ)
    for part in stator.parts:
        pitch = half_pitch(part, stator.K, stator.M)
        for family in (pitch.a, pitch.b):
            solved = eliminated(pitch, family, value)
            left = counted(pitch, family, solved.order, value)
            np.testing.assert_allclose(left.schur, solved.schur, atol=1e-12 * np.abs(solved.schur).max())
            assert left.negative == 0


def test_the_condensed_problems_multiply_and_solve_as_their_own_matrices_do(stator):
    rng = np.random.default_rng(3)
    shift = -0.1 * _top(TOP_HZ)
    for part in stator.parts:
        pitch = half_pitch(part, stator.K, stator.M)
        mine = [i for i, s in enumerate(stator.spaces) if s.axial == part.axial]
        problems = phases(pitch, tuple(stator.spaces[i] for i in mine))
        a, b = (eliminated(pitch, family, shift) for family in (pitch.a, pitch.b))
        right = rng.standard_normal(problems.present.shape) * problems.present
        solved = condensed(pitch, problems, a, b).solve(right)
        image = multiplied(pitch, problems, pitch.K, right)
        for i, x, z, r in zip(mine, solved.T, image.T, right.T, strict=True):
            K, M = stator.pairs[i]
            place = columns(pitch, stator.spaces[i])
            own = r[place]
            np.testing.assert_allclose(z[place], K @ own, atol=1e-9 * abs(K).max())
            exact = sp.linalg.spsolve(sp.csc_matrix(K - shift * M), own)
            difference = x[place] - exact
            assert np.abs(difference).max() < 1e-8 * np.abs(exact).max()


def test_a_few_lowest_modes_are_those_of_the_whole_band(stator):
    # of so high a band that its end is lowered several times
    few = modes_of(stator.pitches, stator.spaces, 60000.0, most=3)
    for (values, y), exact in zip(few, stator.values, strict=True):
        np.testing.assert_allclose(values, exact[:3], rtol=1e-9, atol=1e-8 * _top(TOP_HZ))
        assert y.shape[1] == 3


def test_threads_and_company_change_nothing(stator):
    alone = modes_of(stator.pitches, stator.spaces[2:3], TOP_HZ)
    together = modes_of(stator.pitches, stator.spaces, TOP_HZ)
    threads = modes_of(stator.pitches, stator.spaces, TOP_HZ, jobs=3)
    np.testing.assert_allclose(alone[0][0], together[2][0], rtol=1e-9, atol=1e-9 * _top(TOP_HZ))
    for one, other in zip(together, threads, strict=True):
        np.testing.assert_array_equal(one[0], other[0])
        np.testing.assert_array_equal(one[1], other[1])


def test_a_problem_without_modes_in_the_band_returns_none(stator):
    number = next(i for i, s in enumerate(stator.spaces) if s.order == 3)
    ((values, y),) = modes_of(stator.pitches, [stator.spaces[number]], 10.0)
    assert values.shape == (0,)
    assert y.shape == (stator.spaces[number].size, 0)


def test_a_stiffness_that_is_not_definite_is_one_line_with_a_remedy(stator):
    with pytest.raises(SolverError, match="check the materials") as caught:
        modes_of(half_pitches(stator.parts, -stator.K, stator.M), stator.spaces, TOP_HZ)
    assert "\n" not in str(caught.value)


def test_entries_that_are_not_numbers_are_one_line_with_a_remedy(stator):
    broken = stator.K.copy()
    broken.data[::7] = np.nan
    with pytest.raises(SolverError, match="check the materials"):
        modes_of(half_pitches(stator.parts, broken, stator.M), stator.spaces, TOP_HZ)
