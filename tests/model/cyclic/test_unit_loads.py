"""Answers to unit loads, against the problem's own matrices."""

import numpy as np
import pytest
from small_stators import cyclic_problems, stator_mesh

from statorhom.model.broken.sector import Sector, surface_dofs
from statorhom.model.cyclic.unit_loads import UnitLoads

SHIFT = 1e7


@pytest.fixture(scope="module")
def solved():
    """Answers of singlets and pairs with the matrices they are of, (problem, answers, K, M)."""
    mesh = stator_mesh(6)
    problems = cyclic_problems(mesh, (0, 1, 3), SHIFT)
    unit = {p.space.axial: UnitLoads(p.shifted, surface_dofs(mesh)) for p, _, _ in problems}
    sectors = [(Sector(p, unit[p.space.axial]), K, M) for p, K, M in problems]
    return [(s, s.answers, K.toarray(), M) for s, K, M in sectors]


def _exact(sector, K, M):
    loads = np.zeros((sector.space.size, len(sector.loaded)))
    loads[sector.loaded, np.arange(len(sector.loaded))] = 1.0
    return np.linalg.solve(K + SHIFT * M.toarray(), loads)


def test_there_are_loads_on_either_family_and_on_the_slots_plane(solved):
    pair = next(s for s, *_ in solved if s.space.parity == "pair")
    count_a, count_b, _ = pair.problem.shifted.pitch.sizes
    loaded = pair.problem.columns[pair.loaded]
    assert np.any(loaded < count_a)
    assert np.any((loaded >= count_a) & (loaded < count_a + count_b))
    assert np.any(loaded >= count_a + count_b)


def test_flexibility_and_inertia_are_those_of_the_responses(solved):
    for sector, answers, K, M in solved:
        R = _exact(sector, K, M)
        assert answers.flexibility.shape == (len(sector.loaded),) * 2
        np.testing.assert_allclose(answers.flexibility, R[sector.loaded], atol=1e-9 * np.abs(R).max())
        inertia = R.T @ (M @ R)
        np.testing.assert_allclose(answers.inertia, inertia, atol=1e-9 * np.abs(inertia).max())


def test_responses_and_work_on_them(solved):
    rng = np.random.default_rng(3)
    for sector, answers, K, M in solved:
        R = _exact(sector, K, M)
        np.testing.assert_allclose(answers.responses, R, atol=1e-9 * np.abs(R).max())
        forces = rng.standard_normal((sector.space.size, 4))
        work = forces.T @ R
        np.testing.assert_allclose(answers.against(forces), work, atol=1e-9 * np.abs(work).max())


def test_what_all_problems_share_is_solved_once(solved):
    families = {id(s.unit.families[0]) for s, *_ in solved}
    assert len(families) == len({s.space.axial for s, *_ in solved})
