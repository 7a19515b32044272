"""Which machines beside the typed one are drawn, and which of them are followed through all steps."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from template_hypothesis import LENGTH_MM, template_hypothesis

from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.predicted.prediction import predicted
from statorhom.diagnose.searches import other_machines as module
from statorhom.diagnose.searches.other_machines import FACTORS, on_other_machines
from statorhom.diagnose.searches.refit_starts import Start
from statorhom.diagnose.stages.stage_model import mesh_error
from statorhom.physics.library import all_candidates

DECLARED = 400.0
TABLE = "frequency_hz,order,axial\n1428,2,0\n1766,2,1\n3770,3,0\n"


class Machines:
    """What dimensions near parts of the typed ones leave of the first step, and of all once they are followed."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.first: dict[tuple[str, float], float] = {}
        self.whole: dict[str, float | None] = {}
        self.followed: list[tuple[str, float]] = []
        monkeypatch.setattr(module, "last_action", lambda start: start.rough.action)
        monkeypatch.setattr(module, "shared_by", lambda _: [])
        monkeypatch.setattr(module, "_alone", lambda hypothesis: hypothesis)
        monkeypatch.setattr(module, "blank", lambda hypothesis, _: hypothesis)
        monkeypatch.setattr(module, "refitted", lambda *_: SimpleNamespace(objective=DECLARED))
        monkeypatch.setattr(module, "_of_first_step", self.of_first_step)
        monkeypatch.setattr(module, "on_its_machine", self.follow)
        monkeypatch.setattr(
            module, "explained", lambda r, _: SimpleNamespace(adequacy=float(r.objective < 100.0))
        )

    def of_first_step(self, start: Start, factor: float) -> tuple[float, np.ndarray]:
        return self.first.get((name(start.hypothesis), factor), np.inf), np.array([factor])

    def follow(self, hypothesis: Any, z: np.ndarray, *_: Any) -> Any:
        self.followed.append((name(hypothesis), float(z[0])))
        left = self.whole.get(name(hypothesis))
        return None if left is None else SimpleNamespace(objective=left)


def name(hypothesis: Any) -> str:
    return str(hypothesis.candidates[-1].name)


class Predicting(Hypothesis):
    """With features as they are told, kinds and residuals."""

    told: tuple[tuple[str, float], ...] = (("frequency", 19.0), ("split", 3.0))

    def features(self, *_: Any, **__: Any) -> Any:
        return [SimpleNamespace(kind=kind, residual=residual) for kind, residual in self.told]


def hypothesis_of(*candidates: Any) -> Any:
    stages = (SimpleNamespace(name="stack"), SimpleNamespace(name="wound"))
    return Predicting(SimpleNamespace(stages=stages, constants=()), candidates)  # type: ignore[arg-type]


def start(called: str, stage: str = "stack", *, corrects: bool = True) -> Start:
    action = SimpleNamespace(dimensions={called: 1.0} if corrects else {})
    candidate = SimpleNamespace(name=called, stage=stage)
    return Start(hypothesis_of(candidate), np.zeros(1), SimpleNamespace(action=action))  # type: ignore[arg-type]


BASE: Any = SimpleNamespace(hypothesis=hypothesis_of(), z=np.zeros(1), objective=2 * DECLARED)
STARTS = [start("length"), start("yoke"), start("mass", corrects=False), start("overhang", "wound")]


@pytest.fixture
def machines(monkeypatch: pytest.MonkeyPatch) -> Machines:
    return Machines(monkeypatch)


def found() -> list[float]:
    return [r.objective for r in on_other_machines(BASE, STARTS, none)]


def none(_: Any) -> list[Any]:
    return []


def test_what_the_first_step_likes_best_is_followed_until_nothing_is_left(machines: Machines) -> None:
    machines.first = {("length", 1.08): 80.0, ("yoke", 0.92): 200.0, ("yoke", 1.08): 300.0}
    machines.whole = {"length": 450.0, "yoke": 110.0}
    assert found() == [450.0, 110.0]
    assert machines.followed == [("length", 1.08), ("yoke", 0.92)]
    machines.followed, machines.whole = [], {"length": 60.0}
    assert found() == [60.0]
    assert machines.followed == [("length", 1.08)]


def test_what_hardly_helps_the_first_step_is_not_followed(machines: Machines) -> None:
    machines.first = {("length", 0.92): 0.95 * DECLARED}
    assert found() == []
    assert machines.followed == []


def test_what_no_stator_has_is_left_out(machines: Machines) -> None:
    machines.first = {("yoke", 0.92): 200.0}
    machines.whole = {"yoke": None}
    assert found() == []


@pytest.mark.usefixtures("machines")
def test_only_dimensions_of_the_first_step_are_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    tried: list[tuple[str, float]] = []

    def of_first_step(one: Start, factor: float) -> tuple[float, np.ndarray]:
        tried.append((name(one.hypothesis), factor))
        return np.inf, np.zeros(1)

    monkeypatch.setattr(module, "_of_first_step", of_first_step)
    assert found() == []
    assert tried == [(n, f) for n in ("length", "yoke") for f in FACTORS]


@pytest.mark.parametrize("better", [0, 1])
def test_a_machine_has_typical_constants_or_those_of_the_typed_one(
    monkeypatch: pytest.MonkeyPatch, better: int
) -> None:
    begun: list[list[float]] = []

    def followed(_: Any, z: np.ndarray) -> Any:
        begun.append(z.tolist())
        return SimpleNamespace(objective=float(len(begun) - 1 != better), z=z)

    monkeypatch.setattr(module, "_alone", lambda hypothesis: hypothesis)
    monkeypatch.setattr(module, "on_its_own_machine", lambda hypothesis, _: hypothesis)
    monkeypatch.setattr(module, "through_wide_valleys", followed)
    yoke = SimpleNamespace(parameters=(SimpleNamespace(absent=10.0, internal=lambda value: value),))
    one: Any = SimpleNamespace(hypothesis=hypothesis_of(yoke), z=np.array([0.7, -0.2, 0.1]))
    left, there = module._of_first_step(one, 0.9)
    assert begun == [[0.0, 0.0, 9.0], [0.7, -0.2, 9.0]]
    assert (left, there.tolist()) == (0.0, begun[better])


@pytest.mark.parametrize(("kind", "tried"), [("frequency", True), ("density", True), ("split", False)])
def test_what_parts_doublets_is_no_dimension(
    machines: Machines, monkeypatch: pytest.MonkeyPatch, kind: str, tried: bool
) -> None:
    monkeypatch.setattr(Predicting, "told", ((kind, 19.0), ("frequency", 5.0), ("split", 8.0)))
    machines.first, machines.whole = {("yoke", 0.92): 200.0}, {"yoke": 50.0}
    assert bool(found()) == tried


def test_bodies_that_are_no_rings_have_none() -> None:
    base: Any = SimpleNamespace(hypothesis=SimpleNamespace(), z=None)
    assert on_other_machines(base, STARTS, none) == []


def test_a_wrong_length_is_found_by_the_first_step(tmp_path: Path) -> None:
    """From typical constants, on a machine that is near enough."""
    true = template_hypothesis(tmp_path / "true", {"stack-free.csv": TABLE})
    (stage,) = true.study.stages
    modes = predicted(true.study, stage, true.study.constants.values(np.zeros(len(true))), ())
    error = mesh_error(stage, stage.reference)
    lines = [
        f"{np.exp(m.log_f) * error.factor((r, n, rank)):.3f},{r},{n}\n"
        for (r, n, rank), m in modes.items()
        if rank == 0 and r in (2, 3)
    ]
    measured = {"stack-free.csv": "frequency_hz,order,axial\n" + "".join(lines)}
    typed = template_hypothesis(tmp_path / "typed", measured, length_mm=1.1 * LENGTH_MM)
    (length,) = (c for c in all_candidates(typed.study.files) if c.chosen.get("input") == "length_mm")
    longer = Start(typed.of_others((length,)), np.zeros(len(typed) + 1))
    for factor in FACTORS:
        left, there = module._of_first_step(longer, factor)
        assert length.parameters[0].value(there[-1]) == pytest.approx(LENGTH_MM, rel=0.02)
        assert left < 5.0
