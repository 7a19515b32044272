"""Which effects are tried beside the first, and what they must gain."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose import second_effects as module
from statorhom.diagnose.explanations import PAIR_GAIN, Explanation
from statorhom.diagnose.scan import Scan, Signature
from statorhom.diagnose.second_effects import SECONDS, may_be_added, second_effects


def signature(effect: str, gain: float, *, repeats: bool = False, place: str = "") -> Signature:
    candidate: Any = SimpleNamespace(effect=effect, label=f"{effect} {place}", repeats=repeats)
    return Signature(candidate, np.zeros(1), np.ones(1), 1.0, gain, np.ones(1))


def first(misfit: float) -> Explanation:
    lump: Any = SimpleNamespace(effect="attached_mass")
    refit: Any = SimpleNamespace(misfit=misfit, objective=misfit, jacobian=np.zeros((100, 1)))
    return Explanation((lump,), refit, -50.0)


def tried(
    monkeypatch: pytest.MonkeyPatch, one: Explanation, scan: Scan, gains: tuple[float, ...] = ()
) -> tuple[list[str], float, list[Explanation]]:
    """Labels of the favourites, the limit of their objective, and what is found."""
    seen: dict[str, Any] = {}

    def in_order(base: Any, found: Scan, favourites: tuple[Signature, ...]) -> None:
        assert base is one.refit
        assert all(f in found.signatures for f in favourites)
        seen["favourites"] = [s.candidate.label.strip() for s in favourites]

    def refits(base: Any, *trials: Any) -> list[Explanation]:
        seen["limit"] = trials[-1]
        return [Explanation(one.candidates, base, one.log_evidence + gain) for gain in gains]

    monkeypatch.setattr(module, "in_order", in_order)
    monkeypatch.setattr(module, "refits", refits)
    found = second_effects(one, may_be_added(one, scan), {})
    return seen["favourites"], seen["limit"], found


def test_the_same_effect_again_only_where_it_may_repeat(monkeypatch: pytest.MonkeyPatch) -> None:
    scan = Scan((signature("attached_mass", 90.0), signature("ovality", 50.0)), 0.0)
    assert tried(monkeypatch, first(200.0), scan)[0] == ["ovality"]
    again = Scan((signature("attached_mass", 90.0, repeats=True), signature("ovality", 50.0)), 0.0)
    assert tried(monkeypatch, first(200.0), again)[0] == ["attached_mass", "ovality"]


def test_few_are_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    many = Scan(tuple(signature("ovality", 50.0 - k, place=str(k)) for k in range(2 * SECONDS)), 0.0)
    assert tried(monkeypatch, first(200.0), many)[0] == [f"ovality {k}" for k in range(SECONDS)]


def test_what_gains_too_little_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    scan = Scan((signature("ovality", 50.0),), 0.0)
    assert tried(monkeypatch, first(200.0), scan)[1] == 200.0 - 2 * PAIR_GAIN


def test_a_second_effect_has_to_add_evidence(monkeypatch: pytest.MonkeyPatch) -> None:
    scan = Scan((signature("ovality", 50.0),), 0.0)
    found = tried(monkeypatch, first(200.0), scan, (PAIR_GAIN - 1, PAIR_GAIN + 1, PAIR_GAIN + 9))[2]
    assert [e.log_evidence for e in found] == [-50.0 + PAIR_GAIN + 9, -50.0 + PAIR_GAIN + 1]
