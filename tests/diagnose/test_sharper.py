"""What a model of an explanation's own is made for."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose import sharper as module
from statorhom.diagnose.explanations import Explanation
from statorhom.diagnose.sharper import AROUND, ITSELF, _arcs, at_its_own_materials, sharpened
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
    assert max(width for width, _ in _arcs([joint(6.0, 0.1)], AROUND)) == pytest.approx(2 * np.pi)


def test_contacts_that_are_the_same_all_around_need_no_arcs() -> None:
    assert _arcs([Action(), joint(None)], AROUND) == ()


@pytest.mark.parametrize(
    ("moved", "symmetric", "objectives", "reported"),
    [
        (True, False, [40.0, 25.0, 24.5, 10.0], 24.5),  # what gains little is the end
        (True, False, [40.0, 44.0, 10.0], 40.0),  # and what is worse is not taken
        (True, False, [40.0, 30.0, 20.0, 10.0, 0.0], 10.0),  # no more than a few rounds
        (False, False, [40.0, 10.0], 40.0),
        (True, True, [40.0, 10.0], 40.0),  # materials alone need no solution at them
    ],
)
def test_what_is_reported_is_solved_at_its_own_materials(
    monkeypatch: pytest.MonkeyPatch, moved: bool, symmetric: bool, objectives: list[float], reported: float
) -> None:
    steps = [SimpleNamespace(refit=SimpleNamespace(objective=o)) for o in objectives]
    monkeypatch.setattr(module, "_has_moved", lambda _: moved)
    monkeypatch.setattr(module, "_keeps_symmetry", lambda _: symmetric)
    monkeypatch.setattr(module, "_sharpened", lambda one: steps[steps.index(one) + 1])
    begin: Any = steps[0]
    assert at_its_own_materials(begin).refit.objective == reported


def test_an_arc_can_be_solved_as_it_is_alone() -> None:
    assert _arcs([joint(1.0, 1e-3)], (1.0,)) == ((1.0, 1e-3),)


@pytest.mark.parametrize(("leads", "around"), [(True, AROUND), (False, ITSELF)])
def test_a_rival_s_arc_is_solved_as_it_is_alone(
    monkeypatch: pytest.MonkeyPatch, leads: bool, around: tuple[float, ...]
) -> None:
    """Each arc that is solved takes as long as all else."""
    asked: list[tuple[float, ...]] = []
    refit: Any = SimpleNamespace(hypothesis=SimpleNamespace(features=lambda _: []), z=None, objective=20.0)

    def in_its_own_model(*_: Any, around: tuple[float, ...]) -> None:
        asked.append(around)

    monkeypatch.setattr(module, "in_its_own_model", in_its_own_model)
    monkeypatch.setattr(module, "refitted", lambda *_: refit)
    monkeypatch.setattr(module, "_keeps_symmetry", lambda _: True)
    monkeypatch.setattr(Explanation, "adequacy_but_one", 0.5)
    assert sharpened(Explanation((), refit, -30.0), leads=leads).settled
    assert asked == [around]
