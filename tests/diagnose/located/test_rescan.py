"""Signatures seen from an explanation: what it took up already counts no more."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace

import numpy as np
import pytest

from statorhom.diagnose.evidence.decision import MAX_T_P
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.located import scan as module
from statorhom.diagnose.located.scan import Scan, _Constants, left_over
from statorhom.physics.candidate import Candidate

LUMP, STRIP = Candidate("lump", "stack", ()), Candidate("strip", "stack", ())


def refit(
    residuals: np.ndarray,
    jacobian: np.ndarray,
    weights: np.ndarray,
    test: str = "t",
    names: Sequence[int] | None = None,
) -> Refit:
    """At its optimum, so that residuals and coordinates are what they are; `names`: orders of its modes."""
    orders = range(len(residuals)) if names is None else names
    rows = [SimpleNamespace(kind="frequency", test=test, key=(r, 0, 0)) for r in orders]
    hypothesis = SimpleNamespace(
        prior_weights=weights, charge=lambda _: 0.0, residuals=lambda _: residuals, features=lambda _: rows
    )
    misfit = float(residuals @ residuals)
    return Refit(hypothesis, np.zeros(jacobian.shape[1]), jacobian, misfit, misfit)  # type: ignore[arg-type]


def test_a_second_effect_gains_what_the_first_one_left() -> None:
    lump, strip = np.array([1.0, 0.5, 0.0, 0.0]), np.array([0.0, 0.5, 1.0, 0.0])
    free = np.zeros((4, 1))
    base = refit(-8.0 * lump - 3.0 * strip, free, np.ones(1))
    away = _Constants(base)
    found = [s for c, g in ((LUMP, lump), (STRIP, strip)) if (s := away.signature(c, np.empty(0), g))]
    before = Scan(tuple(sorted(found, key=lambda s: -s.gain)), 0.001)
    assert before.signatures[0].candidate is LUMP
    first = refit(-3.0 * strip, np.column_stack([free, lump]), np.array([1.0, 0.0]))
    after = left_over(before, base, first, 0)
    assert [s.candidate for s in after.signatures] == [STRIP]  # the lump's own is taken up whole
    across = strip - lump * (lump @ strip) / (lump @ lump)
    assert after.signatures[0].gain == pytest.approx((3.0 * across @ strip) ** 2 / (across @ across))


def test_features_that_an_explanation_alone_has_are_left_out() -> None:
    """It has another partner for one mode of three: the signature stays on the two that both have."""
    g = np.array([1.0, 1.0, 5.0])
    free = np.zeros((3, 1))
    base = refit(-g, free, np.ones(1))
    signature = _Constants(base).signature(LUMP, np.empty(0), g)
    assert signature is not None
    first = refit(-np.array([1.0, 1.0, 0.0]), free, np.ones(1), names=(0, 1, 7))
    (after,) = left_over(Scan((signature,), 0.5), base, first, 0).signatures
    assert after.whole == pytest.approx([1.0, 1.0, 0.0])
    assert after.gain == pytest.approx(2.0)


def test_with_other_partners_the_scan_is_made_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    g = np.array([1.0, 0.0])
    base = refit(-g, np.zeros((2, 1)), np.ones(1))
    signature = _Constants(base).signature(LUMP, np.empty(0), g)
    assert signature is not None
    monkeypatch.setattr(module, "scan", lambda _, candidates, seed: (candidates, seed))
    other = refit(-g, np.zeros((2, 1)), np.ones(1), test="other")
    assert left_over(Scan((signature,), 0.5), base, other, 3) == ([LUMP], 3)


def test_what_an_explanation_leaves_has_a_chance_of_its_own() -> None:
    """Another effect is looked for beside an adequate one only where its trace is no accident."""
    lump, strip = np.eye(4)[0], np.eye(4)[1]
    free = np.zeros((4, 1))
    for left, traced in ((6.0, True), (0.5, False)):
        base = refit(-30.0 * lump - left * strip, free, np.ones(1))
        away = _Constants(base)
        found = [s for c, g in ((LUMP, lump), (STRIP, strip)) if (s := away.signature(c, np.empty(0), g))]
        first = refit(-left * strip, np.column_stack([free, lump]), np.array([1.0, 0.0]))
        after = left_over(Scan(tuple(found), 1e-4), base, first, 0)
        assert after.signatures[0].candidate is STRIP
        assert (after.p_value < MAX_T_P) == traced
