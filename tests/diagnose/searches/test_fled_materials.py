"""Materials that have fled: by being unusual, by leaving more than noise, by being sure of nothing."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.searches import fled_materials as module
from statorhom.diagnose.searches.fled_materials import typical_where_fled
from statorhom.study.study_file import FREE

LEAST = 5.0


class Fled:
    """A winding of two constants, and two lines of it."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.z = [0.0, 0.0]
        self.residual, self.doubt, self.typical_doubt = 0.5, 0.0, 0.0
        self.test, self.kind = "wound-free", "frequency"
        self.models = 0
        tests = tuple(SimpleNamespace(name=n, support=s) for n, s in (("wound-free", FREE), ("held", "held")))
        self.stage: Any = SimpleNamespace(name="wound", tests=tests, error="mesh")
        self.study = SimpleNamespace(stages=(self.stage,), constants=None)
        monkeypatch.setattr(module, "new_constants", lambda *_: [1, 2])
        monkeypatch.setattr(module, "with_typical_materials", self.typical)
        monkeypatch.setattr(module, "doubt_by", lambda *_: self.typical_doubt)

    def typical(self, of: Any, stage: str) -> Any:
        assert stage == "wound"
        self.models += 1
        return of

    def features(self, _: np.ndarray) -> list[Any]:
        one = SimpleNamespace(test=self.test, kind=self.kind, residual=self.residual, doubt=self.doubt)
        return [one, one]

    def found(self, gross: int = 0) -> bool:
        hypothesis = SimpleNamespace(study=self.study, prior_weights=np.ones(3), features=self.features)
        of: Any = SimpleNamespace(hypothesis=hypothesis, z=np.array([9.0, *self.z]))
        return typical_where_fled(of, self.stage, LEAST, gross) is not None


@pytest.fixture
def winding(monkeypatch: pytest.MonkeyPatch) -> Fled:
    return Fled(monkeypatch)


def test_usual_materials_that_leave_noise_have_not_fled_and_cost_no_model(winding: Fled) -> None:
    assert not winding.found()
    assert winding.models == 0


@pytest.mark.parametrize(
    "told",
    [
        {"z": [-3.0, 1.5]},
        {"residual": 3.0},
        {"doubt": 3.0},
        {"z": [-2.0, 0.0], "residual": 1.5, "doubt": 1.0},
    ],
    ids=["unusual", "off", "unsure", "some of each"],
)
def test_what_loses_more_than_typical_materials_have_to_gain_has_fled(
    winding: Fled, told: dict[str, Any]
) -> None:
    vars(winding).update(told)
    assert winding.found()


def test_a_gross_error_is_no_flight_and_two_are_one(winding: Fled) -> None:
    winding.residual = 5.0
    assert winding.found(gross=1)
    assert not winding.found(gross=2)
    winding.doubt = 3.0
    assert winding.found(gross=2)


def test_what_typical_materials_are_as_unsure_of_is_no_loss(winding: Fled) -> None:
    winding.doubt, winding.typical_doubt = 3.0, 2.0
    assert not winding.found()
    assert winding.models == 1


@pytest.mark.parametrize(("test", "kind"), [("held", "frequency"), ("wound-free", "loss")])
def test_free_frequencies_alone_tell(winding: Fled, test: str, kind: str) -> None:
    winding.residual, winding.test, winding.kind = 9.0, test, kind
    assert not winding.found()


def test_without_a_stator_of_typical_materials_nothing_is_said(
    winding: Fled, monkeypatch: pytest.MonkeyPatch
) -> None:
    winding.doubt = 3.0
    monkeypatch.setattr(module, "with_typical_materials", lambda *_: None)
    assert not winding.found()
