"""When what varies from end to end is sought beside usual constants, and from where."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.searches import leaning_fields as module
from statorhom.diagnose.searches.leaning_fields import PLACES, leaning_fields

SIZES = (-0.3, 1.1)
# a gradient's valley lies where the axial stiffness is as usual
RIGHT = 1.0


class Stack:
    """A stack with three constants, whose axial stiffness, the widest, has fled; and what is tried beside it."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.leans = [2.0, 3.0, 3.0]
        self.adequacy = 0.0
        self.lead = -150.0
        self.tried: list[np.ndarray] = []
        items = [SimpleNamespace(log=log, sd=sd) for log, sd in ((True, 0.1), (True, 1.7), (False, 9.0))]
        stages = [
            SimpleNamespace(name=name, tests=[SimpleNamespace(name=f"{name}-free")])
            for name in ("stack", "wound")
        ]
        self.study = SimpleNamespace(stages=stages, constants=SimpleNamespace(items=items))
        monkeypatch.setattr(module, "Hypothesis", SimpleNamespace)
        monkeypatch.setattr(
            module, "nothing", lambda base: SimpleNamespace(refit=base, adequacy=base.adequacy)
        )
        monkeypatch.setattr(module, "new_constants", lambda *_: [0, 1, 2])
        monkeypatch.setattr(module, "scan_starts", lambda *_: [np.array([u]) for u in SIZES])
        monkeypatch.setattr(module, "start_of", self.start)
        monkeypatch.setattr(module, "shared_by", lambda _: [])
        monkeypatch.setattr(module, "is_a_field", lambda hypothesis, _: hypothesis.candidate.field)
        monkeypatch.setattr(module, "in_its_own_model", lambda hypothesis, *_, **__: hypothesis)
        monkeypatch.setattr(module, "refitted", self.refitted)
        monkeypatch.setattr(module, "in_own_models", self.explained)

    def features(self, _: np.ndarray) -> list[Any]:
        leans = [("lean", r) for r in self.leans]
        return [
            SimpleNamespace(kind=kind, residual=r, lost=False, test="stack-free")
            for kind, r in (*leans, ("frequency", 9.0))
        ]

    def start(self, base: Any, candidate: Any, own: np.ndarray) -> Any:
        return SimpleNamespace(hypothesis=SimpleNamespace(candidate=candidate), z=np.r_[base.z, own])

    def refitted(self, hypothesis: Any, z: np.ndarray) -> Any:
        self.tried.append(z)
        return SimpleNamespace(
            hypothesis=hypothesis, objective=abs(z[1] - RIGHT) * 100 + 10 * (z[3] < 0), z=z
        )

    def explained(self, found: list[Any], _: Any) -> list[Any]:
        return [SimpleNamespace(log_evidence=-60.0 - r.objective, z=r.z) for r in found]

    def found(self) -> list[Any]:
        hypothesis = SimpleNamespace(study=self.study, features=self.features)
        base: Any = SimpleNamespace(
            hypothesis=hypothesis, z=np.array([0.4, -1.7, 0.2]), adequacy=self.adequacy
        )
        lead: Any = SimpleNamespace(refit=base, log_evidence=self.lead)
        candidates: Any = [
            SimpleNamespace(stage=stage, located=located, parameters=(1,), field=field)
            for stage, located, field in (
                ("stack", False, True),
                ("stack", False, False),
                ("stack", True, True),
                ("wound", False, True),
            )
        ]
        return leaning_fields(base, [lead], candidates, {})


@pytest.fixture
def stack(monkeypatch: pytest.MonkeyPatch) -> Stack:
    return Stack(monkeypatch)


def test_fields_are_tried_where_the_least_known_constant_is_usual(stack: Stack) -> None:
    best, *_ = stack.found()
    assert best.z == pytest.approx([0.4, RIGHT, 0.2, SIZES[1]])
    assert sorted((z[1], z[3]) for z in stack.tried) == sorted((p, u) for p in PLACES for u in SIZES)
    assert all(z[0] == 0.4 and z[2] == 0.2 for z in stack.tried)


def test_leans_that_chance_leaves_ask_for_nothing(stack: Stack) -> None:
    stack.leans = [1.0, -1.5, 1.0]
    assert not stack.found() and not stack.tried
    stack.leans = []
    assert not stack.found() and not stack.tried


def test_leans_are_enough_where_all_rows_together_may_be_chance(stack: Stack) -> None:
    """Frequencies of a stack with ends of 1 : 5.6 were met by an axial stiffness twenty times too small."""
    stack.adequacy = 0.8
    assert stack.found()


def test_what_is_no_better_than_the_lead_is_left(stack: Stack) -> None:
    stack.lead = -50.0
    assert not stack.found()
    assert stack.tried
