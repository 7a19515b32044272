"""What modes that were not seen are predicted to be."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.evidence.held_out_modes import lacked, left_out_errors
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
