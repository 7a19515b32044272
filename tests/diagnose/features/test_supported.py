"""Which solutions of a supported test are used again."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from statorhom.diagnose.features import supported as module
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.model.kept import Kept
from statorhom.physics.action import Action
from statorhom.physics.effects.support_compliance import elastic
from statorhom.study.supports import LineSupport

RIGID = LineSupport(name="clamped", kind="lines", angles_deg=[158.0, 202.0], declared="rigid")
TEST = MeasuredTest(0, "stack-clamped", "clamped", ())


def test_what_a_support_dissipates_asks_for_no_other_solution(monkeypatch: pytest.MonkeyPatch) -> None:
    solved: list[Any] = []
    monkeypatch.setattr(module, "_solved", lambda *args: solved.append(args) or len(solved))
    files: Any = SimpleNamespace(study=SimpleNamespace(support=lambda _: RIGID))
    stage: Any = SimpleNamespace(name="stack", responses=Kept())

    def reference(stiffness: float, loss: float) -> object:
        values = {"normal_stiffness_n_per_m2": stiffness, "tangential_ratio": 0.7, "loss_factor": loss}
        action = Action(supports={"clamped": elastic(RIGID, values)}, support_losses={"clamped": loss})
        return module.supported_test(files, stage, TEST, [action], (("support", stiffness, loss),))

    assert reference(1e10, 0.03) == reference(1e10, 0.2) == 1
    assert reference(2e10, 0.03) == 2
    assert module.supported_test(files, stage, TEST, [], ()) == 3
    assert len(solved) == 3
