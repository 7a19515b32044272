"""What a model of an explanation's own is made for."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.contacts.joint_solution import ROUGH
from statorhom.diagnose.contacts.joint_training import KnownArc
from statorhom.diagnose.fits import own_model
from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.fits.own_model import AROUND, ITSELF, _arcs
from statorhom.diagnose.searches import sharper as module
from statorhom.diagnose.searches.sharper import at_its_own_materials, sharpened
from statorhom.errors import MaterialError, SolverError
from statorhom.physics.action import Action, Joint

WOUND = ("winding", "overhang")


def joint(width: float | None, ratio: float = 1.0) -> Action:
    return Action(joint=Joint(WOUND, 1e14, 1e14, None if width is None else (2.0, width), ratio))


def test_lost_contacts_are_solved_on_either_side_of_the_found_one() -> None:
    narrow, wide = _arcs([Action(), joint(1.0, 1e-3)], AROUND)
    assert narrow[0] < 1.0 < wide[0]
    assert narrow[1] > 1e-3 > wide[1]
    assert np.sqrt(narrow[0] * wide[0]) == pytest.approx(1.0)
    assert np.sqrt(narrow[1] * wide[1]) == pytest.approx(1e-3)


def test_no_arc_is_wider_than_the_circle() -> None:
    assert max(arc.width_rad for arc in _arcs([joint(6.0, 0.1)], AROUND)) == pytest.approx(2 * np.pi)


def test_contacts_that_are_the_same_all_around_need_no_arcs() -> None:
    assert _arcs([Action(), joint(None)], AROUND) == ()


@pytest.mark.parametrize(
    ("moved", "symmetric", "everywhere", "objectives", "reported"),
    [
        (True, False, False, [40.0, 25.0, 24.5, 10.0], 24.5),  # what gains little is the end
        (True, False, False, [40.0, 44.0, 10.0], 40.0),  # and what is worse is not taken
        (True, False, False, [40.0, 30.0, 20.0, 10.0, 0.0], 10.0),  # no more than a few rounds
        (False, False, False, [40.0, 10.0, 9.9], 40.0),
        (False, False, True, [40.0, 10.0, 9.99, 0.0], 9.99),  # what is all over its region moves without them
        (True, True, True, [40.0, 10.0], 40.0),  # materials alone need no solution at them
    ],
)
def test_what_is_reported_is_solved_at_its_own_materials(
    monkeypatch: pytest.MonkeyPatch,
    moved: bool,
    symmetric: bool,
    everywhere: bool,
    objectives: list[float],
    reported: float,
) -> None:
    steps = [SimpleNamespace(refit=SimpleNamespace(objective=o, hypothesis=None, z=None)) for o in objectives]
    monkeypatch.setattr(module, "is_a_field", lambda *_: everywhere)
    monkeypatch.setattr(module, "_has_moved", lambda _: moved)
    monkeypatch.setattr(module, "keeps_symmetry", lambda _: symmetric)
    monkeypatch.setattr(module, "refines", lambda *_: False)
    monkeypatch.setattr(module, "_sharpened", lambda one: steps[steps.index(one) + 1])
    begin: Any = steps[0]
    assert at_its_own_materials(begin).refit.objective == reported


@pytest.mark.parametrize(
    ("now", "before", "cost", "taken"),
    [
        (True, False, 25.0, True),  # a coarse mesh may leave less for what it gets wrong
        (True, False, 31.0, False),  # but not that much
        (True, True, 25.0, False),
        (False, True, 15.0, False),
    ],
)
def test_what_a_finer_mesh_has_told_is_taken_though_it_leaves_more(
    now: bool, before: bool, cost: float, taken: bool
) -> None:
    def optimum(refined: bool, cost: float) -> Any:
        stages = (SimpleNamespace(refinement=None), SimpleNamespace(refinement="it" if refined else None))
        hypothesis = SimpleNamespace(study=SimpleNamespace(stages=stages))
        return SimpleNamespace(hypothesis=hypothesis, cost=cost)

    assert module.refines(optimum(now, cost), optimum(before, 20.0)) is taken


def test_an_arc_can_be_solved_as_it_is_alone() -> None:
    assert _arcs([joint(1.0, 1e-3)], (1.0,)) == (KnownArc(1.0, 1e-3),)


def test_other_coordinates_arcs_are_solved_with_the_materials_there() -> None:
    """Where no stator has them there is nothing to solve."""

    def materials(_: Any, z: np.ndarray) -> str:
        if z[0] < 0:
            raise MaterialError("no such body")
        return f"winding {z[0]:.0f}"

    hypothesis: Any = SimpleNamespace(materials=materials, actions=lambda z: [joint(z[1], 1e-3)])
    stage: Any = None
    found = own_model._arcs_elsewhere(
        hypothesis, stage, [np.array(z) for z in ((1, 0.5), (-1, 0.6), (2, 0.7))]
    )
    expected = [(0.5, "winding 1"), (0.7, "winding 2")]
    # they are many, and each of them takes as long as all else
    assert list(found) == [KnownArc(width, 1e-3, m, ROUGH) for width, m in expected]  # type: ignore[arg-type]


@pytest.mark.parametrize(("leads", "around"), [(True, AROUND), (False, ITSELF)])
def test_a_rival_s_arc_is_solved_as_it_is_alone(
    monkeypatch: pytest.MonkeyPatch, leads: bool, around: tuple[float, ...]
) -> None:
    """Each arc that is solved takes as long as all else."""
    asked: list[tuple[float, ...]] = []
    refit: Any = SimpleNamespace(
        hypothesis=SimpleNamespace(features=lambda _: []), z=None, objective=20.0, cost=20.0
    )

    def in_its_own_model(*_: Any, around: tuple[float, ...]) -> None:
        asked.append(around)

    monkeypatch.setattr(module, "in_its_own_model", in_its_own_model)
    monkeypatch.setattr(module, "refitted", lambda *_: refit)
    monkeypatch.setattr(module, "keeps_symmetry", lambda _: True)
    monkeypatch.setattr(Explanation, "adequacy_but_one", 0.5)
    assert sharpened(Explanation((), refit, -30.0), leads=leads).settled
    assert asked == [around]


def models_right_at_two_alone(monkeypatch: pytest.MonkeyPatch, lead: float) -> None:
    """Elsewhere each has its optimum `lead` times as far away, and fits the worse."""

    def refitted(model: Any, _: Any) -> Any:
        away = model.reference - 2.0
        left = 20.0 + 10.0 * abs(away)
        return SimpleNamespace(hypothesis=model, z=2.0 + lead * away, objective=left, cost=left)

    def there(model: Any, z: float) -> float:
        best = refitted(model, None)
        return float(best.objective + 40.0 * (z - best.z) ** 2)

    def in_its_own_model(_: Any, z: float, **__: Any) -> Any:
        return SimpleNamespace(reference=z)

    monkeypatch.setattr(module, "in_its_own_model", in_its_own_model)
    monkeypatch.setattr(module, "refitted", refitted)
    monkeypatch.setattr(module, "refit_objective", there)
    monkeypatch.setattr(module, "through_wide_valleys", lambda *_: None)
    monkeypatch.setattr(module, "keeps_symmetry", lambda _: False)


@pytest.mark.parametrize(
    ("lead", "objective", "found"),
    [
        (-1.0, 25.0, 2.0),  # either model leads past the right one
        (0.95, 25.0, 2.95),  # nearly where it stands: nothing lies between
        (-1.0, 40.0, 1.0),  # what gains is followed as it is
    ],
)
def test_what_two_models_lead_past_lies_between_them(
    monkeypatch: pytest.MonkeyPatch, lead: float, objective: float, found: float
) -> None:
    """A pressure of 0.15 was 0.12 at an E_z of 141 GPa, whose model said 0.17 at 123 GPa, and that one's the first."""
    models_right_at_two_alone(monkeypatch, lead)
    begun: Any = SimpleNamespace(hypothesis=None, z=3.0, objective=objective, cost=objective)
    assert module._sharpened(Explanation((), begun, 0.0)).refit.z == pytest.approx(found)


def test_between_two_models_may_lie_no_stator(monkeypatch: pytest.MonkeyPatch) -> None:
    models_right_at_two_alone(monkeypatch, -1.0)

    def only_there(_: Any, z: float, **__: Any) -> Any:
        if z == 2.0:
            raise SolverError("no stator has these constants")
        return SimpleNamespace(reference=z)

    monkeypatch.setattr(module, "in_its_own_model", only_there)
    begun: Any = SimpleNamespace(hypothesis=None, z=3.0, objective=25.0, cost=25.0)
    assert module._sharpened(Explanation((), begun, 0.0)).refit.z == 1.0
