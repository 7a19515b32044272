"""Modes that were measured and that the declared model has nowhere near."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.measured.feature import LOST, LOST_UNNAMED, Feature
from statorhom.diagnose.searches.lacking_modes import lacks_modes


def refit(paired: int, named: int, unnamed: int) -> Any:
    features = [Feature("frequency", "t", (2, i, 0), 7.0, 7.0, 1e-3) for i in range(paired)]
    features += [Feature("split", "t", (2, i, 0), 0.0, LOST, 1.0, lost=True) for i in range(5)]
    features += [Feature("frequency", "t", None, LOST, 0.0, 1.0, lost=True)] * named
    features += [Feature("frequency", "t", None, LOST_UNNAMED, 0.0, 1.0, lost=True)] * unnamed
    return SimpleNamespace(hypothesis=SimpleNamespace(features=lambda _z: features), z=np.zeros(1))


@pytest.mark.parametrize(
    ("paired", "named", "unnamed", "lacking"),
    [(6, 5, 0, True), (6, 2, 0, False), (6, 0, 9, False), (30, 4, 0, False), (0, 3, 0, True)],
)
def test_as_many_named_modes_without_a_partner_as_no_accident_leaves(paired, named, unnamed, lacking) -> None:
    assert lacks_modes(refit(paired, named, unnamed)) is lacking


def test_a_test_of_few_modes_lacks_them_whatever_other_tests_have() -> None:
    """Four of thirteen of a wound stator had no partner, beside 34 of its stack that all had one."""
    wound, stack = refit(9, 4, 0), refit(34, 0, 0)
    features = [*wound.hypothesis.features(0), *(replace(f, test="s") for f in stack.hypothesis.features(0))]
    both: Any = SimpleNamespace(hypothesis=SimpleNamespace(features=lambda _: features), z=np.zeros(1))
    assert lacks_modes(both)
