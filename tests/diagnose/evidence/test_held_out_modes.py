"""What modes that were not seen are predicted to be."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.evidence.held_out_modes import GROSS, Error, _without_gross, lacked, left_out_errors
from statorhom.diagnose.measured.feature import LOST, LOST_UNNAMED, Feature


def test_pole_shifts_are_no_part_of_a_frequency_s_noise() -> None:
    key = (2, 1, 0)
    features = [Feature("frequency", "stack-free", key, 7.001, 7.0, 2e-3)]
    features += [Feature("shift", "stack-free", key, m, 0.0, 2e-5) for m in (5e-4, -5e-4)]
    hypothesis: Any = SimpleNamespace(features=lambda _, left_out: features if left_out else [])
    found = left_out_errors(hypothesis, np.empty(0))
    group = ("stack-free", key)
    assert found[group, "mode"] == pytest.approx((0.1, 0.2))
    assert found[group, "shift"] == pytest.approx((0.05 * np.sqrt(2), 0.002 * np.sqrt(2)))


def test_a_split_is_no_part_of_its_mode_s_frequency() -> None:
    # the wave that parts two lines by 0.4 % of λ moves their mean by less than the mesh leaves open
    key = (3, 0, 0)
    features = [Feature("frequency", "stack-free", key, 7.001, 7.0, 1e-3)]
    features += [Feature("split", "stack-free", key, m, 0.0, 4e-4) for m in (4e-3, 0.0)]
    hypothesis: Any = SimpleNamespace(features=lambda _, left_out: features if left_out else [])
    found = left_out_errors(hypothesis, np.empty(0))
    group = ("stack-free", key)
    assert found[group, "mode"] == pytest.approx((0.1, 0.1))
    assert found[group, "split"] == pytest.approx((0.1, 0.01 * np.sqrt(2)))


def fit_of(*features: Feature) -> Any:
    return SimpleNamespace(hypothesis=SimpleNamespace(features=lambda _: list(features)), z=None)


def test_a_named_mode_that_only_one_model_has_is_lacked_by_the_other() -> None:
    key = (2, 1, 0)
    found = Feature("frequency", "free", key, 7.0, 7.0, 1e-3, rows=("3", "4"))
    lost = [Feature("frequency", "free", None, LOST, 0.0, 1.0, lost=True, rows=(row,)) for row in ("3", "4")]
    assert lacked(fit_of(*lost), fit_of(found)) == {("free", key)}
    assert not lacked(fit_of(found), fit_of(*lost))
    # one of its lines alone, or a row without a name, may be any other mode's
    assert not lacked(fit_of(lost[0]), fit_of(found))
    unnamed = [
        Feature("frequency", "free", None, LOST_UNNAMED, 0.0, 1.0, lost=True, rows=f.rows) for f in lost
    ]
    assert not lacked(fit_of(*unnamed), fit_of(found))


def errors_of(**rows: tuple[float, float]) -> dict[Any, tuple[Error, Error]]:
    """By test, of the declared model and of an explanation, in units of their noise."""
    return {((test, None), "mode"): (Error(b, 1.0, 0.0), Error(a, 1.0, 0.0)) for test, (b, a) in rows.items()}


def test_one_mode_that_neither_model_has_near_tells_nothing() -> None:
    """A pole by FRFs that was none: both missed it by so much that all other modes counted for nothing."""
    told = errors_of(first=(5.0, 0.3), second=(4.0, 0.5))
    gross = errors_of(spurious=(60.0, 70.0))
    assert _without_gross(told | gross) == told
    # two such modes are missing physics, and what one of the models has near is none
    assert len(_without_gross(told | gross | errors_of(other=(20.0, 30.0)))) == 4
    for both in ((60.0, 0.9 * GROSS), (0.9 * GROSS, 70.0)):
        assert len(_without_gross(told | errors_of(spurious=both))) == 3


def test_a_gross_mode_alone_is_kept() -> None:
    gross = errors_of(spurious=(60.0, 70.0))
    assert _without_gross(gross) == gross
