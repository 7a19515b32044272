"""Who wins when data are drawn anew, and the evidence that decides it."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from statorhom.diagnose.evidence.held_out_modes import WEIGHED
from statorhom.diagnose.evidence.resampling import resampled_evidence, stability, wins
from statorhom.diagnose.fits.refit import Refit, log_volume


def test_a_draw_without_detection_counts_for_nobody() -> None:
    assert wins([2.0, 0.0, 4.9]) is None


def test_a_rival_wins_only_by_a_lead_that_tells_the_two_apart() -> None:
    assert wins([20.0, 0.0, 15.0]) is True
    assert wins([20.0, 0.0, 22.0]) is True
    assert wins([20.0, 0.0, 24.0]) is False


def test_an_unseen_uniform_coordinate_gains_nothing() -> None:
    """The angle of a feature that only frequencies show: its range stays what it was."""
    seen, angle = np.diag([400.0]), np.diag([400.0, 0.0])
    without = log_volume(seen, np.array([1.0]))
    assert log_volume(angle, np.array([1.0, 0.0])) == pytest.approx(without)


def test_a_well_seen_uniform_coordinate_has_its_gaussian_volume() -> None:
    precision = 1e4
    volume = np.sqrt(2 * np.pi / precision) / np.sqrt(12)  # of the Gaussian over the range √12
    assert log_volume(np.diag([precision]), np.array([0.0])) == pytest.approx(np.log(volume), abs=1e-4)


def test_a_normal_coordinate_shrinks_from_prior_to_posterior() -> None:
    assert log_volume(np.diag([99.0]), np.array([1.0])) == pytest.approx(-0.5 * np.log(100.0))


def linear(highest: float = np.inf) -> SimpleNamespace:
    """Of two constants, the first with a limit, and eight modes."""
    return SimpleNamespace(
        prior_weights=np.ones(2),
        missed=0.0,
        charges=lambda _: np.zeros(8),
        limits=lambda: (np.full(2, -np.inf), np.array([highest, np.inf])),
    )


def test_a_linear_model_is_resampled_exactly() -> None:
    """At the optimum of a linear model: the evidence without rows is that of a fit without them."""
    rng = np.random.default_rng(2)
    J, data = rng.normal(size=(8, 2)), rng.normal(size=8)
    hypothesis = linear()

    def fitted(rows: np.ndarray) -> tuple[Refit, np.ndarray]:
        A, y = J[rows], data[rows]
        z = np.linalg.solve(A.T @ A + np.eye(2), A.T @ y)
        left = A @ z - y
        return Refit(hypothesis, z, A, float(left @ left), float(left @ left + z @ z)), left  # type: ignore[arg-type]

    rows = np.arange(8) > 1
    full, residuals = fitted(np.ones(8, dtype=bool))
    assert resampled_evidence(full, residuals, rows, 1.0, 1.0) == pytest.approx(fitted(rows)[0].log_evidence)


def test_what_stands_at_its_limit_stays_there_when_lines_are_left_out() -> None:
    """A declared model that would explain by an impossible winding won draws beyond its limit."""
    J = np.ones((8, 2)) * [3.0, 0.0] + np.arange(8)[:, None] * [0.0, 0.3]
    # the first constant would have to be 4; the second follows as it stays at 2
    z = np.array([2.0, 0.0])
    left = J @ (z - [4.0, 0.0])
    bounded = Refit(linear(2.0), z, J, float(left @ left), float(left @ left + z @ z))  # type: ignore[arg-type]
    rows = np.arange(8) > 1
    second, e = J[rows, 1], left[rows]
    moved = float(-(second @ e) / (second @ second + 1))
    there = e + second * moved
    objective = float(there @ there) + 4.0 + moved**2
    expected = -0.5 * objective + log_volume(J[rows].T @ J[rows], np.ones(2))
    assert resampled_evidence(bounded, left, rows, 1.0, 1.0) == pytest.approx(expected)
    free = Refit(linear(), z, J, bounded.misfit, bounded.objective)  # type: ignore[arg-type]
    assert resampled_evidence(free, left, rows, 1.0, 1.0) > expected + 10.0


def test_without_a_rival_the_winner_is_stable() -> None:
    one = SimpleNamespace()
    assert stability([one, one], 1) == 1.0  # type: ignore[list-item]


def explanation(log_evidence: float, residuals: list[float], doubt: float = 0.0) -> SimpleNamespace:
    """Of four modes and what densities can be, with one constant that none of them tells."""
    rows = [frozenset([("free", str(i))]) for i in range(4)] + [frozenset([WEIGHED])]
    hypothesis = SimpleNamespace(
        prior_weights=np.ones(1),
        missed=0.0,
        charges=lambda _: np.zeros(5),
        limits=lambda: (np.full(1, -np.inf), np.full(1, np.inf)),
        features=lambda _: [SimpleNamespace(observed=row, doubt=doubt) for row in rows],
        residuals=lambda _: np.array(residuals),
    )
    misfit = float(np.sum(np.square(residuals)))
    refit = Refit(hypothesis, np.zeros(1), np.zeros((5, 1)), misfit, misfit, 5 * doubt)  # type: ignore[arg-type]
    return SimpleNamespace(compared=None, refit=refit, log_evidence=log_evidence)


def test_a_rival_that_only_an_impossible_density_speaks_against_does_not_win() -> None:
    best, none = explanation(-4.0, [1.0, 1.0, 1.0, 1.0, 1.0]), explanation(-200.0, [10.0] * 4 + [0.0])
    rival = explanation(-50.0, [0.1, 0.1, 0.1, 0.1, 10.0])
    assert stability([best, none, rival], 1) == 1.0  # type: ignore[list-item]


def test_a_rival_that_is_sure_of_nothing_wins_no_draw() -> None:
    """It leaves less of every mode, for it knows each of them less well by far."""
    best, none = explanation(-2.5, [1.0] * 5), explanation(-200.0, [10.0] * 5)
    rival = explanation(-15.0, [0.1] * 5, doubt=3.0)
    assert stability([best, none, rival], 1) == 1.0  # type: ignore[list-item]
    sure = explanation(-0.05, [0.1] * 5)
    assert stability([best, none, sure], 1) < 0.8  # type: ignore[list-item]


def test_one_belief_that_changes_the_winner_does_not_make_a_name_unstable_and_more_do() -> None:
    """What an arc leads by shrinks to a fourth where every standard deviation is twice as wide."""
    none, rival = explanation(-500.0, [15.0] * 5), explanation(-22.5, [3.0] * 5)
    best = explanation(-12.5, [1.0] * 5)  # 10 of them for what it takes to be there
    assert stability([best, none, rival], 1) == pytest.approx(0.8)  # type: ignore[list-item]
    dear = explanation(-22.5, [1.0] * 5)
    assert stability([dear, none, rival], 1) < 0.8  # type: ignore[list-item]
