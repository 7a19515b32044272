"""Which cheap effects are followed where the declared model is far off."""

from __future__ import annotations

from itertools import pairwise
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose import refit_starts
from statorhom.diagnose.searched_starts import SUPPORTS, _with_few_supports

BASE: Any = SimpleNamespace(hypothesis=SimpleNamespace(candidates=()), z=None)


def trial(rough: float | None) -> Any:
    found = None if rough is None else SimpleNamespace(objective=rough)
    return 1.0, [SimpleNamespace(rough=found)]


def promising(monkeypatch: pytest.MonkeyPatch, *roughs: float | None) -> list[float | None]:
    monkeypatch.setattr(refit_starts, "blank", lambda *_: None)
    monkeypatch.setattr(refit_starts, "widened", lambda *_: SimpleNamespace(objective=100.0))
    kept = refit_starts._promising(BASE, [trial(r) for r in roughs])
    return [None if one[1][0].rough is None else one[1][0].rough.objective for one in kept]


def test_the_first_few_are_followed_whatever_they_gain(monkeypatch: pytest.MonkeyPatch) -> None:
    assert promising(monkeypatch, 99.0, 10.0, 98.0, 97.0, 96.0, None) == [10.0, 96.0, 97.0, 98.0]


def test_others_are_followed_for_a_part_of_the_best_ones_gain(monkeypatch: pytest.MonkeyPatch) -> None:
    assert promising(monkeypatch, 10.0, 20.0, 30.0, 40.0, 81.0, 83.0) == [10.0, 20.0, 30.0, 40.0, 81.0]


def test_few_supports_go_with_all_the_constants() -> None:
    points = [np.r_[np.arange(3.0) + i, 10.0 * i, 20.0 * i] for i in range(50)]
    found = _with_few_supports(points, 3)
    assert all(np.array_equal(a[:3], b[:3]) for a, b in zip(found, points, strict=True))
    supports = [tuple(z[3:]) for z in found]
    assert 2 <= len(set(supports)) <= SUPPORTS
    # neighbours share theirs: it is solved once
    assert sum(a != b for a, b in pairwise(supports)) == len(set(supports)) - 1
