"""Lanczos' iteration in lockstep, on problems whose eigenvalues are known."""

from dataclasses import dataclass

import numpy as np
import pytest

from statorhom.errors import SolverError
from statorhom.model.cyclic.lanczos import largest


@dataclass(frozen=True)
class Diagonal:
    """θ and masses of p problems, (n, p): the eigenvectors are the axes."""

    theta: np.ndarray
    masses: np.ndarray

    def take(self, chosen):
        return Diagonal(self.theta[:, chosen], self.masses[:, chosen])

    def solve(self, right):
        return self.theta * right / self.masses

    def mass(self, vectors):
        return self.masses * vectors


def _problems(seed, theta):
    rng = np.random.default_rng(seed)
    return Diagonal(theta, rng.uniform(1.0, 3.0, theta.shape)), rng.standard_normal(theta.shape)


def test_as_many_as_are_known_to_be_there_are_found_in_every_problem():
    rng = np.random.default_rng(1)
    theta = np.sort(rng.uniform(0.0, 1.0, (150, 4)) ** 3, axis=0)[::-1]
    problems, start = _problems(2, theta)
    counts = (theta > 0.5).sum(axis=0)
    for i, (values, vectors) in enumerate(largest(problems, start, counts, 0.5)):
        np.testing.assert_allclose(values, theta[: counts[i], i], rtol=1e-11)
        gram = vectors.T @ (problems.masses[:, i, None] * vectors)
        np.testing.assert_allclose(gram, np.eye(counts[i]), atol=1e-10)
        np.testing.assert_allclose(
            np.abs(vectors) * np.sqrt(problems.masses[:, i, None]), np.eye(150)[:, : counts[i]], atol=1e-8
        )


@pytest.mark.parametrize("copies", [2, 3, 4])
def test_multiple_eigenvalues_come_as_often_as_they_are(copies):
    theta = np.r_[np.full(copies, 2.0), 1.0, np.linspace(0.4, 0.01, 80)][:, None]
    problems, start = _problems(3, theta)
    ((values, vectors),) = largest(problems, start, np.array([copies + 1]), 0.9)
    np.testing.assert_allclose(values, theta[: copies + 1, 0], rtol=1e-10)
    assert np.linalg.matrix_rank(vectors) == copies + 1


def test_problems_without_any_take_no_part():
    problems, start = _problems(4, np.linspace(1.0, 0.01, 60)[:, None] * [1.0, 0.1])
    one, none = largest(problems, start, np.array([3, 0]), 0.95)
    np.testing.assert_allclose(one[0], problems.theta[:3, 0], rtol=1e-11)
    assert none[0].shape == (0,)
    assert none[1].shape == (60, 0)


@pytest.mark.parametrize("n", [1, 2, 5, 11])
def test_tiny_problems_are_solved_whole(n):
    problems, start = _problems(5, np.linspace(2.0, 1.0, n)[:, None])
    ((values, _),) = largest(problems, start, np.array([n]), 0.5)
    np.testing.assert_allclose(values, problems.theta[:, 0], rtol=1e-11)


def test_coordinates_that_a_problem_has_not_stay_at_rest():
    theta = np.linspace(2.0, 0.01, 70)[:, None]
    problems, start = _problems(6, theta)
    start[::2] = 0.0
    ((values, vectors),) = largest(problems, start, np.array([4]), theta[8, 0])
    np.testing.assert_allclose(values, theta[1:9:2, 0], rtol=1e-11)
    assert np.all(vectors[::2] == 0.0)


def test_more_than_there_are_is_an_error_not_an_answer():
    problems, start = _problems(7, np.linspace(1.0, 0.01, 30)[:, None])
    with pytest.raises(SolverError, match="does not converge"):
        largest(problems, start, np.array([6]), 0.9)
