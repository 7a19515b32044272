"""One harmonic's problem, against its own matrices."""

import pickle

import numpy as np
import pytest
from small_stators import cyclic_problems, stator_mesh

SHIFT = 1e7


@pytest.fixture(scope="module")
def problems():
    return cyclic_problems(stator_mesh(6), (0, 1, 3), SHIFT)


def test_it_multiplies_and_solves_as_its_matrices_do(problems):
    rng = np.random.default_rng(1)
    for problem, K, M in problems:
        y = rng.standard_normal((problem.space.size, 3))
        np.testing.assert_allclose(problem.K @ y, K @ y, atol=1e-9 * abs(K).max())
        np.testing.assert_allclose(problem.M @ y, M @ y, atol=1e-12 * abs(M).max())
        exact = np.linalg.solve((K + SHIFT * M).toarray(), y)
        np.testing.assert_allclose(problem.solve(y), exact, atol=1e-8 * np.abs(exact).max())


def test_samples_measure_a_residual(problems):
    rng = np.random.default_rng(2)
    for problem, K, M in problems[2:5]:
        residual = rng.standard_normal(problem.space.size)
        exact = residual @ np.linalg.solve((K + SHIFT * M).toarray(), residual)
        count = 4000
        drawn = problem.sampled(rng.standard_normal((problem.space.size, count)))
        assert abs(np.mean((residual @ drawn) ** 2) / exact - 1) < 4 * np.sqrt(2 / count)


def test_it_can_be_sent_to_another_process_after_it_has_solved(problems):
    problem, _, _ = problems[0]
    y = np.ones((problem.space.size, 1))
    here = problem.solve(y)
    sent = pickle.loads(pickle.dumps(problem))
    np.testing.assert_array_equal(sent.solve(y), here)
