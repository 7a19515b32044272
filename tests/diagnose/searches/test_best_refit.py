"""Which way a candidate's best optimum is sought, and where it is sought elsewhere."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.searches import best_refit as module
from statorhom.diagnose.searches.refit_starts import CHEAP, MIDDLING, Start


def tried(
    monkeypatch: pytest.MonkeyPatch,
    straight: float,
    known: float,
    *,
    far: bool = False,
    adequacy: float = 0.5,
) -> tuple[float, list[str]]:
    """Objective of the best refit, and the ways that were taken, where wide valleys lead to 30."""
    ways: list[str] = []

    def refit(way: str, objective: float) -> Any:
        ways.append(way)
        return SimpleNamespace(objective=objective)

    monkeypatch.setattr(module, "price", lambda _: MIDDLING)
    monkeypatch.setattr(module, "is_poor", lambda _: False)
    monkeypatch.setattr(module, "at_fitting_height", lambda best, _: best)
    monkeypatch.setattr(module, "at_fitting_angle", lambda best, _: best)
    monkeypatch.setattr(module, "_whole", lambda best, _: best)
    monkeypatch.setattr(module, "refitted", lambda *_: refit("straight", straight))
    monkeypatch.setattr(module, "_through", lambda _: refit("wide", 30.0))
    monkeypatch.setattr(module, "explained", lambda *_: SimpleNamespace(adequacy_but_one=adequacy))
    start: Any = SimpleNamespace(hypothesis=None, z=None)
    best: Any = module.best_refit([start], np.inf, far=far, known=known)
    return best.objective, ways


def test_what_leaves_more_than_the_declared_model_is_no_optimum(monkeypatch: pytest.MonkeyPatch) -> None:
    assert tried(monkeypatch, 450.0, known=180.0) == (30.0, ["straight", "wide"])
    assert tried(monkeypatch, 150.0, known=180.0) == (150.0, ["straight"])


def test_what_explains_most_of_a_poor_misfit_but_not_all_is_sought_both_ways(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A lump of a table stood at an evidence of -41 through wide valleys, and at -29 straight from its scan."""
    assert tried(monkeypatch, 14.0, known=274.0, far=True, adequacy=0.001) == (14.0, ["wide", "straight"])
    assert tried(monkeypatch, 14.0, known=274.0, far=True) == (30.0, ["wide"])
    assert tried(monkeypatch, 14.0, known=50.0, far=True, adequacy=0.001) == (30.0, ["wide"])


def sought(
    monkeypatch: pytest.MonkeyPatch, near: float, *, price: int = CHEAP, holds: bool = False, **named: Any
) -> float:
    """Objective of the best refit where the near optima leave `near`, and the one of a far valley 20."""
    far_away: Any = SimpleNamespace(hypothesis="far away", z=None)
    monkeypatch.setattr(module, "price", lambda _: price)
    monkeypatch.setattr(module, "is_poor", lambda _: False)
    monkeypatch.setattr(module, "at_fitting_height", lambda best, _: best)
    monkeypatch.setattr(module, "at_fitting_angle", lambda best, _: best)
    monkeypatch.setattr(module, "_whole", lambda best, _: best)
    monkeypatch.setattr(module, "shared_by", lambda _: [])
    monkeypatch.setattr(module, "_holds", lambda _: holds)
    monkeypatch.setattr(module, "narrowed_starts", lambda _: [far_away])
    monkeypatch.setattr(module, "_through", lambda _: SimpleNamespace(objective=near))
    monkeypatch.setattr(module, "_rival", lambda *_: SimpleNamespace(objective=near))
    monkeypatch.setattr(module, "beside_later_steps", lambda _: [])
    objectives = {"near": near, "far away": 20.0}
    monkeypatch.setattr(module, "refitted", lambda name, _: SimpleNamespace(objective=objectives[name]))
    monkeypatch.setattr(module, "explained", lambda *_: SimpleNamespace(adequacy_but_one=0.5))
    start: Any = SimpleNamespace(hypothesis="near", z=None)
    known = {"worth": np.inf, "far": False, "known": 180.0} | named
    best: Any = module.best_refit([start], **known)
    return float(best.objective)


def test_an_effect_that_leaves_more_than_its_absence_is_sought_all_over_the_prior(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert sought(monkeypatch, 450.0) == 20.0
    assert sought(monkeypatch, 150.0) == 150.0
    # what explains the misfit already may have a rival there
    assert sought(monkeypatch, 450.0, worth=90.0) == 20.0
    # a solution is dear, or the strongest are sought everywhere in any case
    assert sought(monkeypatch, 450.0, price=MIDDLING) == 450.0
    assert sought(monkeypatch, 450.0, far=True) == 450.0
    # a rigid support is none of the elastic ones: these may well leave more
    assert sought(monkeypatch, 450.0, holds=True) == 450.0


@dataclass(frozen=True)
class Trained:
    """A hypothesis whose effect asks for local fields."""

    candidates: tuple[Any, ...]
    trained: bool = True

    def actions(self, _: object) -> list[Any]:
        return [SimpleNamespace(training="fields", dimensions={})]


def trained_start(z: object, *, located: bool) -> Start:
    return Start(Trained((SimpleNamespace(located=located),)), z)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("quick", "located", "found"), [(150.0, True, 20.0), (170.0, True, 170.0), (240.0, False, 20.0)]
)
def test_a_rival_that_explains_much_or_is_all_over_its_region_is_tried_with_local_fields(
    monkeypatch: pytest.MonkeyPatch, quick: float, located: bool, found: float
) -> None:
    """Of two graded stacks one left 150 without them beside 84 of a wrong name, and 15 with them, one 243 and 31."""

    def refit(hypothesis: Trained, *_: object) -> Any:
        return SimpleNamespace(objective=20.0 if hypothesis.trained else quick, z=None)

    monkeypatch.setattr(module, "refitted", refit)
    monkeypatch.setattr(module, "explained", lambda *_: SimpleNamespace(adequacy=0.5))
    best: Any = module._rival(trained_start(np.zeros(1), located=located), 90.0, 270.0)
    assert best.objective == found


@pytest.mark.parametrize(("adequacy", "objective"), [(0.5, 54.0), (0.01, 18.0)])
def test_a_rival_that_leaves_something_is_refitted_straight_from_its_start_too(
    monkeypatch: pytest.MonkeyPatch, adequacy: float, objective: float
) -> None:
    """Without local fields a strip of half the yoke went through all of it, and a lump got its name."""

    def refit(hypothesis: Trained, z: float, _: float) -> Any:
        left = {(False, 0.0): 74.0, (True, 1.0): 54.0, (True, 0.0): 18.0}
        return SimpleNamespace(objective=left[hypothesis.trained, z], z=1.0)

    monkeypatch.setattr(module, "refitted", refit)
    monkeypatch.setattr(module, "explained", lambda *_: SimpleNamespace(adequacy=adequacy))
    best: Any = module._rival(trained_start(0.0, located=True), 84.0, 260.0)
    assert best.objective == objective


def test_beside_a_poor_model_cheap_effects_are_followed_both_ways_from_all_starts(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The first optimum that is adequate does not end it: in another valley one may leave less."""
    monkeypatch.setattr(module, "shared_by", lambda _: [])
    monkeypatch.setattr(module, "_through", lambda start: SimpleNamespace(objective=start.z))
    monkeypatch.setattr(module, "refitted", lambda _, z: SimpleNamespace(objective=2 * z) if z > 4 else None)
    starts: Any = [SimpleNamespace(hypothesis=None, z=z) for z in (9.0, 3.0)]
    found: Any = module._both_ways(starts)
    assert [r.objective for r in found] == [9.0, 18.0, 3.0]
