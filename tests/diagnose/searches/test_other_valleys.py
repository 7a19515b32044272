"""What varies all over its region, beside the constants of other valleys."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.searches import other_valleys as module
from statorhom.errors import SolverError

# what a refit from a magnitude beside a valley's constants leaves, in wide valleys and at last
WIDE = {(1.0, 0.5): 95.0, (1.0, 1.8): 92.0, (2.0, 0.5): 110.0, (2.0, 1.8): 112.0}
LEFT = {(1.0, 0.5): 240.0, (1.0, 1.8): 127.0, (2.0, 0.5): 168.0, (2.0, 1.8): 50.0}


def refit(objective: float, z: Any = ()) -> Any:
    hypothesis = SimpleNamespace(candidates=("gradient",), study=None, shared=())
    return SimpleNamespace(objective=objective, cost=objective, z=z, hypothesis=hypothesis)


@pytest.fixture
def tried(monkeypatch: pytest.MonkeyPatch) -> list[tuple[float, ...]]:
    """Points that were followed: a model of its own takes 100 off what is left."""
    followed: list[tuple[float, ...]] = []

    def followed_from(_: Any, z: np.ndarray, rough: Any) -> Any:
        assert rough.z is z
        followed.append(tuple(z.tolist()))
        return refit(LEFT[followed[-1]], z)

    def own(_: Any, z: np.ndarray) -> Any:
        if z[0] == 3.0:
            raise SolverError("no stator has these constants")

    monkeypatch.setattr(module, "blank", lambda hypothesis, _: hypothesis)
    monkeypatch.setattr(module, "is_poor", lambda free: free.misfit > 100.0)
    monkeypatch.setattr(module, "is_a_field", lambda *_: True)
    monkeypatch.setattr(module, "starts", lambda *_: [np.array([0.5]), np.array([1.8])])
    monkeypatch.setattr(module, "in_its_own_model", own)
    monkeypatch.setattr(module, "widened", lambda _, z: refit(WIDE[tuple(z.tolist())], z))
    monkeypatch.setattr(module, "through_wide_valleys", followed_from)
    monkeypatch.setattr(module, "explained", lambda r, _: Explanation((), r, -0.5 * r.objective))
    monkeypatch.setattr(module, "sharpened", lambda e: Explanation((), refit(e.refit.objective - 100.0), 0.0))
    return followed


def sought(leading: float, *valleys: float, misfit: float = 400.0) -> list[float]:
    base: Any = SimpleNamespace(
        free=SimpleNamespace(misfit=misfit), valleys=tuple(np.array([v]) for v in valleys)
    )
    found = [Explanation((), refit(o), -0.5 * o) for o in (leading, leading + 10.0)]
    return [e.refit.objective for e in module.in_other_valleys(base, found, {})]


def test_the_valley_that_leaves_least_is_taken(tried: list[tuple[float, ...]]) -> None:
    """A gradient of 0.15 was 1.8 at 116, beside an E_z of a thousandth; beside the true one it leaves 27."""
    assert sought(116.0, 1.0, 2.0) == [27.0, 126.0]
    assert tried == [(1.0, 1.8), (2.0, 0.5)]  # from the better magnitude of each valley


def test_what_leaves_less_in_narrow_valleys_than_this_in_wide_ones_stays(
    tried: list[tuple[float, ...]],
) -> None:
    """A gradient beside a clamp that gives way left 740 in wide valleys, and the clamp 484 in narrow ones."""
    assert sought(91.0, 1.0, 2.0) == [91.0, 101.0]
    assert not tried
    assert sought(93.0, 1.0, 2.0) == [27.0, 103.0]
    assert tried == [(1.0, 1.8)]


def test_what_no_model_of_its_own_brings_before_the_lead_gets_none(
    monkeypatch: pytest.MonkeyPatch, tried: list[tuple[float, ...]]
) -> None:
    """A gradient was 222 behind a lump, and 120 after minutes in models of its own."""
    monkeypatch.setitem(LEFT, (1.0, 1.8), 320.0)
    own: list[float] = []

    def sharpened(e: Explanation) -> Explanation:
        own.append(e.refit.objective)
        return e

    monkeypatch.setattr(module, "sharpened", sharpened)
    sought(98.0, 1.0)
    assert tried == [(1.0, 1.8)]
    assert own == []
    monkeypatch.setitem(LEFT, (1.0, 1.8), 190.0)
    sought(98.0, 1.0)
    assert own == [190.0]


def test_constants_that_no_stator_has_are_left_out(tried: list[tuple[float, ...]]) -> None:
    assert sought(116.0, 3.0) == [116.0, 126.0]
    assert not tried


def test_a_good_declared_model_has_no_other_valley(tried: list[tuple[float, ...]]) -> None:
    assert sought(116.0, 1.0, misfit=50.0) == [116.0, 126.0]
    assert not tried


def test_what_is_somewhere_is_left_to_its_own_search(
    monkeypatch: pytest.MonkeyPatch, tried: list[tuple[float, ...]]
) -> None:
    monkeypatch.setattr(module, "is_a_field", lambda *_: False)
    assert sought(116.0, 1.0) == [116.0, 126.0]
    assert not tried


@pytest.mark.parametrize(
    ("adequacy", "steps", "left"),
    [
        (0.0, 1, [27.0, 116.0]),
        (0.5, 1, [116.0, 148.0]),
        (0.0, 2, [116.0, 148.0]),  # of a wound stator this takes minutes
    ],
)
def test_it_is_sought_too_where_another_effect_explains_more_but_not_enough(
    monkeypatch: pytest.MonkeyPatch,
    tried: list[tuple[float, ...]],
    adequacy: float,
    steps: int,
    left: list[float],
) -> None:
    """A gradient of 0.15 was behind a wrong length, which left far too much."""
    monkeypatch.setattr(module, "is_a_field", lambda hypothesis, _: hypothesis.candidates == ("gradient",))
    length: Any = refit(116.0)
    length.hypothesis.candidates = ("length",)
    wrong: Any = SimpleNamespace(refit=length, log_evidence=-58.0, adequacy=adequacy, adequacy_but_one=1.0)
    study = SimpleNamespace(stages=("stack", "wound")[:steps])
    free = SimpleNamespace(misfit=400.0, hypothesis=SimpleNamespace(study=study))
    base: Any = SimpleNamespace(free=free, valleys=(np.array([1.0]), np.array([2.0])))
    found = module.in_other_valleys(base, [wrong, Explanation((), refit(148.0), -74.0)], {})
    assert [e.refit.objective for e in found] == left
    assert bool(tried) == (left[0] == 27.0)
