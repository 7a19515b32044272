"""Whether an explanation is adequate."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import chi2

from statorhom.diagnose.fits.explanations import PAIR_GAIN, Explanation, explained
from statorhom.diagnose.fits.refit import Refit
from statorhom.physics.candidate import Candidate

TABLES = SimpleNamespace(stages=())
RECORDED = SimpleNamespace(stages=(SimpleNamespace(tests=(SimpleNamespace(recorded=True),)),))


def features(residuals: list[float]) -> list[SimpleNamespace]:
    return [SimpleNamespace(kind="frequency", residual=r) for r in residuals]


def explanation(constant: float, magnitude: float) -> Explanation:
    """Ten features that are met to 8 units of squared residual; a constant and an effect's magnitude."""
    rows = features([np.sqrt(0.8)] * 10)
    hypothesis = SimpleNamespace(
        study=TABLES, constants=1, prior_weights=np.ones(2), charge=lambda _: 3.0, features=lambda _: rows
    )
    objective = 8.0 + 3.0 + constant**2 + magnitude**2
    refit = Refit(hypothesis, np.array([constant, magnitude]), np.zeros((10, 2)), 8.0, objective)  # type: ignore[arg-type]
    return Explanation((), refit, 0.0)


def test_a_large_effect_is_no_misfit() -> None:
    assert explanation(0.0, 5.0).adequacy == pytest.approx(float(chi2.sf(8.0, 10)))


def test_loss_factors_hide_no_misfit() -> None:
    """Rows that scatter as they like neither count against an explanation nor for it."""
    plain, lossy = with_residuals([1.5] * 6), with_residuals([1.5] * 6, losses=[0.1] * 8)
    assert lossy.adequacy == pytest.approx(plain.adequacy)


def test_to_what_is_asked_of_all_losses_and_an_unusual_effect_are_one() -> None:
    lossy, large = with_residuals([0.5] * 6, losses=[4.0] * 4), explanation(0.0, 6.0)
    assert lossy.adequacy > 0.5 > 1e-6 > lossy.adequacy_of_all
    assert large.adequacy > 0.5 > 1e-6 > large.adequacy_of_all


def test_an_implausible_constant_is_one() -> None:
    assert explanation(6.0, 0.0).adequacy == pytest.approx(float(chi2.sf(44.0, 10)))


def with_residuals(residuals: list[float], losses: list[float] | None = None) -> Explanation:
    """No constants at all."""
    lossy = [SimpleNamespace(kind="loss", residual=r) for r in losses or []]
    r = np.array([*residuals, *(f.residual for f in lossy)])
    rows = features(residuals) + lossy
    hypothesis = SimpleNamespace(
        study=TABLES, constants=0, prior_weights=np.zeros(0), charge=lambda _: 0.0, features=lambda _: rows
    )
    misfit = float(r @ r)
    refit = Refit(hypothesis, np.zeros(0), np.zeros((len(r), 0)), misfit, misfit)  # type: ignore[arg-type]
    return Explanation((), refit, 0.0)


def test_one_gross_row_is_no_inadequacy_but_two_are() -> None:
    good = [0.5, -1.0, 1.2, 0.3, -0.8, 1.5, -0.2, 0.9, -1.1]
    one, two = with_residuals([*good, 11.0]), with_residuals([*good, 11.0, -9.0])
    assert one.adequacy < 1e-6 < 0.01 < one.adequacy_but_one
    assert two.adequacy_but_one < 0.01


def test_of_few_rows_none_is_set_aside() -> None:
    few = with_residuals([0.1, 0.2, 11.0])
    assert few.adequacy_but_one == few.adequacy < 1e-6


def test_the_rest_is_held_to_its_own_distribution() -> None:
    """Of pure noise the same share is inadequate with and without the worst row."""
    rng = np.random.default_rng(3)
    chances = [with_residuals(rng.standard_normal(12).tolist()).adequacy_but_one for _ in range(200)]
    assert np.mean(np.array(chances) < 0.1) == pytest.approx(0.1, abs=0.06)


def test_two_on_both_sides_have_to_gain_what_a_second_effect_has_to() -> None:
    def evidence(candidate: Candidate) -> float:
        best = SimpleNamespace(hypothesis=SimpleNamespace(candidates=(candidate,)), log_evidence=-3.0)
        return explained(best, {"lump": 2}).log_evidence  # type: ignore[arg-type]

    one, two = (evidence(Candidate("lump", "wing", (), both_sides=b)) for b in (False, True))
    assert one == pytest.approx(-3.0 - np.log(2.0))
    assert one - two == pytest.approx(PAIR_GAIN)


def linear(rng: np.random.Generator, constants: int, rows: int = 12) -> Explanation:
    """A right explanation at its optimum: rows are linear in constants, which are as their priors say."""
    J = np.random.default_rng(3).normal(size=(rows, constants)) * 5.0
    z = rng.standard_normal(constants)
    measured = J @ z + rng.standard_normal(rows)
    best = np.linalg.solve(J.T @ J + np.eye(constants), J.T @ measured)
    residuals = J @ best - measured
    hypothesis = SimpleNamespace(
        study=TABLES,
        constants=constants,
        prior_weights=np.ones(constants),
        charge=lambda _: 0.0,
        features=lambda _: features(residuals.tolist()),
    )
    misfit = float(residuals @ residuals)
    return Explanation((), Refit(hypothesis, best, J, misfit, misfit + float(best @ best)), 0.0)  # type: ignore[arg-type]


@pytest.mark.parametrize("constants", [1, 6])
def test_of_right_explanations_rows_are_left_by_chance(constants: int) -> None:
    """As the share of the rows that constants take up grows, less is left, and the chance stays what it is."""
    rng = np.random.default_rng(5)
    found = np.array([linear(rng, constants).chance_of_rows for _ in range(400)])
    assert np.mean(found) == pytest.approx(0.5, abs=0.05)
    assert np.mean(found < 0.1) == pytest.approx(0.1, abs=0.04)


def test_what_is_unusual_of_a_constant_says_nothing_of_the_rows() -> None:
    usual, unusual = explanation(0.0, 0.0), explanation(6.0, 0.0)
    assert unusual.adequacy < 1e-3 < usual.adequacy
    assert unusual.chance_of_rows == usual.chance_of_rows == pytest.approx(float(chi2.sf(8.0, 10)))


def test_loss_factors_are_no_rows_that_count() -> None:
    plain, lossy = with_residuals([1.5] * 6), with_residuals([1.5] * 6, losses=[4.0] * 8)
    assert lossy.chance_of_rows == pytest.approx(plain.chance_of_rows)
    assert with_residuals([], losses=[4.0] * 3).chance_of_rows == 1.0


def test_by_recordings_what_is_adequate_is_enough() -> None:
    table = linear(np.random.default_rng(0), 11)
    recorded = linear(np.random.default_rng(0), 11)
    recorded.refit.hypothesis.study = RECORDED  # type: ignore[misc]
    assert recorded.chance_of_rows == max(table.chance_of_rows, recorded.adequacy_but_one)
    assert recorded.adequacy_but_one > table.chance_of_rows
