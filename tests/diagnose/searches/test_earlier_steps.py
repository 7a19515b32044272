"""What the steps before an effect's own leave of the declared model."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.searches import earlier_steps as module
from statorhom.diagnose.searches.earlier_steps import left_before


@dataclass(frozen=True)
class Study:
    stages: tuple[Any, ...]
    files: Any


@dataclass(frozen=True)
class Declared:
    study: Study
    candidates: tuple[Any, ...] = ()

    def with_stages(self, stages: tuple[Any, ...]) -> Declared:
        return Declared(Study(stages, self.study.files))


@pytest.fixture
def base(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Of a stack and a winding, without a test of what was done between them; one start is no body's."""

    def refitted(hypothesis: Declared, z: np.ndarray) -> Any:
        left = float(z[0]) * len(hypothesis.study.stages)
        return None if left < 0 else SimpleNamespace(objective=left)

    monkeypatch.setattr(module, "refitted", refitted)
    monkeypatch.setattr(module, "blank", lambda hypothesis, _: hypothesis)
    names = [SimpleNamespace(name=n) for n in ("stack", "dried", "wound")]
    files = SimpleNamespace(study=SimpleNamespace(stages=names))
    study = Study((names[0], names[2]), files)
    return SimpleNamespace(hypothesis=Declared(study), z=np.array([70.0]))


def test_the_best_of_several_starts_without_the_step_counts(base: Any) -> None:
    assert left_before(base, "wound", []) == 70.0
    assert left_before(base, "wound", [np.array([-1.0]), np.array([60.0]), np.array([90.0])]) == 60.0


def test_before_the_first_step_nothing_is_left(base: Any) -> None:
    assert left_before(base, "stack", []) == 0.0


def test_where_no_stator_has_the_constants_nothing_is_said(base: Any) -> None:
    base.z = np.array([-1.0])
    assert left_before(base, "wound", []) == 0.0
