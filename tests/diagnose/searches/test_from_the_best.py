"""The other effects from the constants beside which the best one was found."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.searches import from_the_best as module
from statorhom.diagnose.searches.from_the_best import from_the_best
from statorhom.diagnose.searches.refit_starts import CHEAP, MIDDLING


def candidate(label: str) -> Any:
    return SimpleNamespace(effect=label, label=label, both_sides=False)


def explanation(label: str, z: list[float], evidence: float) -> Explanation:
    own = candidate(label)
    hypothesis = SimpleNamespace(candidates=(own,))
    refit: Any = SimpleNamespace(
        z=np.array(z), objective=-evidence, hypothesis=hypothesis, log_evidence=evidence
    )
    return Explanation((own,), refit, evidence)


def again(monkeypatch: pytest.MonkeyPatch, best_at: list[float], price: int) -> dict[str, float]:
    """Log evidences afterwards, where "other" stands at -50 and would gain 45 from the best one's constants."""
    # the last action is one that the study declares
    actions = [SimpleNamespace(dimensions={}), SimpleNamespace(dimensions={"bore": 1.0})]
    hypothesis: Any = SimpleNamespace(candidates=("other",), actions=lambda _: actions)

    def refitted(_: Any, z: np.ndarray, worth: float) -> Any:
        assert z[:2].tolist() == best_at[:2] and worth == 5.0 + module.RIVAL
        return explanation("other", z.tolist(), -5.0).refit

    monkeypatch.setattr(module, "blank", lambda *_: hypothesis)
    monkeypatch.setattr(module, "price", lambda _: price)
    monkeypatch.setattr(module, "nearest_first", lambda _, points: points)
    monkeypatch.setattr(module, "refitted", refitted)
    base: Any = SimpleNamespace(z=np.zeros(2), hypothesis=hypothesis)
    scan: Any = SimpleNamespace(
        signatures=[SimpleNamespace(candidate=candidate(n), start=np.zeros(1)) for n in ("best", "other")]
    )
    tried = [explanation("best", best_at, -5.0), explanation("other", [0.0, 0.0, 0.0], -50.0)]
    return {e.effects[0]: e.log_evidence for e in from_the_best(base, scan, tried, {})}


def test_what_stood_in_another_valley_follows_the_best_one(monkeypatch: pytest.MonkeyPatch) -> None:
    assert again(monkeypatch, [3.0, 0.0, 1.0], CHEAP) == {"best": -5.0, "other": -5.0}


def test_beside_the_declared_model_and_where_it_is_dear_nothing_is_sought_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert again(monkeypatch, [0.1, 0.0, 1.0], CHEAP) == {"best": -5.0, "other": -50.0}
    assert again(monkeypatch, [3.0, 0.0, 1.0], MIDDLING) == {"best": -5.0, "other": -50.0}


def test_without_explanations_there_is_no_best() -> None:
    base: Any = SimpleNamespace(z=np.zeros(2))
    scan: Any = SimpleNamespace(signatures=[])
    assert from_the_best(base, scan, [], {}) == []
