"""When wrong dimensions are sought once more from the machine that they lead to."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.searches import own_machine as module
from statorhom.diagnose.searches.own_machine import from_its_own_machine
from statorhom.errors import MaterialError

KNOWN = 500.0


class Followed:
    """Optima in models of their own, one after the other."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, objectives: list[float], *, far: bool = True) -> None:
        self.left = [optimum(o) for o in objectives]
        self.solved: list[float] = []
        monkeypatch.setattr(module, "is_far", lambda *_: far)
        monkeypatch.setattr(module, "in_its_own_model", self.solve)
        monkeypatch.setattr(module, "refitted", lambda *_: self.left.pop(0) if self.left else None)

    def solve(self, hypothesis: Any, z: Any) -> Any:
        self.solved.append(z)
        return hypothesis


def optimum(objective: float) -> Any:
    hypothesis = Hypothesis(SimpleNamespace(constants=(), stages=()))  # type: ignore[arg-type]
    return SimpleNamespace(hypothesis=hypothesis, z=objective, objective=objective)


def none(_: Any) -> list[Any]:
    return []


def test_its_own_machine_is_no_worse_for_leaving_more_than_a_cubic_promised(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    Followed(monkeypatch, [400.0, 60.0, 59.0])
    assert from_its_own_machine(optimum(300.0), KNOWN, none).objective == 60.0
    Followed(monkeypatch, [400.0, 399.5])
    assert from_its_own_machine(optimum(300.0), KNOWN, none).objective == 300.0


def test_what_its_own_machine_explains_worse_than_the_declared_model_is_not_followed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    followed = Followed(monkeypatch, [520.0, 60.0])
    assert from_its_own_machine(optimum(300.0), KNOWN, none).objective == 300.0
    assert followed.solved == [300.0]


def test_it_is_followed_while_that_gains(monkeypatch: pytest.MonkeyPatch) -> None:
    """Though next to nothing is left before: it may be by constants that are not its own machine's."""
    followed = Followed(monkeypatch, [200.0, 40.0, 30.0, 29.5])
    assert from_its_own_machine(optimum(300.0), KNOWN, none).objective == 30.0
    assert followed.solved == [300.0, 200.0, 40.0, 30.0]


def test_other_constants_are_tried_beside_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """The machine's own model leaves more at first: later steps' constants had made up for the old one's errors."""
    Followed(monkeypatch, [400.0, 45.0])
    other = optimum(150.0)
    assert (
        from_its_own_machine(optimum(300.0), KNOWN, lambda r: [other] if r.objective == 400 else []).objective
        == 45
    )


@pytest.mark.parametrize(
    ("objective", "far"),
    # near the machine that it is seen from; explaining next to nothing
    [(300.0, False), (480.0, True)],
)
def test_what_does_not_need_it_stays(monkeypatch: pytest.MonkeyPatch, objective: float, far: bool) -> None:
    followed = Followed(monkeypatch, [1.0], far=far)
    assert from_its_own_machine(optimum(objective), KNOWN, none).objective == objective
    assert followed.solved == []


def test_a_body_that_is_no_ring_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    Followed(monkeypatch, [1.0])
    found: Any = SimpleNamespace(hypothesis=SimpleNamespace(), z=None, objective=300.0)
    assert from_its_own_machine(found, KNOWN, none) is found


def test_where_no_stator_has_its_constants_it_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    Followed(monkeypatch, [1.0])

    def none_there(*_: Any) -> Any:
        raise MaterialError("no such body")

    monkeypatch.setattr(module, "in_its_own_model", none_there)
    assert from_its_own_machine(optimum(300.0), KNOWN, none).objective == 300.0
