"""Which refits are given up early: what has a place near an optimum, all that is dear beside a poor model."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.searches import single_effects as module
from statorhom.diagnose.searches.refit_starts import CHEAP, MIDDLING, Start
from statorhom.diagnose.searches.single_effects import NEAR, refits

LIMIT = 90.0


@dataclass(frozen=True)
class Chances:
    """Of what an explanation leaves, with and without its worst row."""

    refit: Any
    adequacy: float
    adequacy_but_one: float


def worths(
    monkeypatch: pytest.MonkeyPatch, misfit: float, *prices: int, place: str = "nowhere"
) -> list[float]:
    """Objectives above which the trials of these prices matter to nobody."""
    seen: list[float] = []

    def best_refit(_: Any, worth: float, far: bool, known: float) -> None:
        assert far == (misfit > 100.0) and known == misfit
        seen.append(worth)

    monkeypatch.setattr(module, "price", lambda trial: trial[1][0])
    monkeypatch.setattr(module, "_has_place", lambda _: place == "somewhere")
    monkeypatch.setattr(module, "_best_refit", best_refit)
    monkeypatch.setattr(module, "shared_by", lambda _: [])
    base: Any = SimpleNamespace(misfit=misfit, objective=misfit, jacobian=np.zeros((30, 1)))
    trials: Any = [(50.0, [price]) for price in prices]
    assert refits(base, trials, {}, LIMIT) == []
    return seen


def test_near_an_optimum_what_has_a_place_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    assert worths(monkeypatch, 60.0, CHEAP, MIDDLING, MIDDLING) == [np.inf] * 3
    assert worths(monkeypatch, 60.0, CHEAP, MIDDLING, place="somewhere") == [LIMIT, LIMIT]


@pytest.mark.parametrize(
    ("objective", "adequacy", "most"),
    # far off; near, where a name has to lead by 5 and rivals it by 3; and adequate, where it has to lead by 8
    [(1e3, 0.0, 1e3), (70.0, 0.0, 66.0), (70.0, 0.5, 60.0)],
)
def test_a_few_know_of_the_same_others_whatever_the_number_of_processes(
    monkeypatch: pytest.MonkeyPatch, objective: float, adequacy: float, most: float
) -> None:
    found = {"first": 50.0, "second": 20.0, "third": 30.0, "fourth": 9.0, "fifth": 9.0, "sixth": 9.0}
    seen: dict[str, float] = {}

    def best_refit(starts: Any, worth: float, **_: Any) -> Any:
        seen[starts[0]] = worth
        return SimpleNamespace(objective=found[starts[0]])

    monkeypatch.setattr(module, "price", lambda _: MIDDLING)
    monkeypatch.setattr(module, "_has_place", lambda _: True)
    monkeypatch.setattr(module, "_best_refit", best_refit)
    monkeypatch.setattr(module, "shared_by", lambda _: [])
    monkeypatch.setattr(module, "from_its_own_machine", lambda best, *_: best)
    monkeypatch.setattr(module, "explained", lambda best, _: Chances(best, 0.5, 0.5))
    monkeypatch.setattr(module, "nothing", lambda _: SimpleNamespace(adequacy=adequacy))
    base: Any = SimpleNamespace(misfit=objective, objective=objective, jacobian=np.zeros((30, 1)))
    trials: Any = [(50.0, [name]) for name in found]
    assert [e.refit.objective for e in refits(base, trials, {})] == list(found.values())
    # the first stands alone: it tells whether others are rivals
    first, *others = seen.values()
    assert first == np.inf
    assert others == [min(best + NEAR, most) for best in (50.0, 50.0, 50.0, 50.0, 9.0)]


def test_of_a_poor_model_cheap_effects_are_followed_through_other_valleys(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert worths(monkeypatch, 900.0, CHEAP, MIDDLING) == [np.inf, LIMIT]


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
    best: Any = module._best_refit([start], np.inf, far=far, known=known)
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
    monkeypatch.setattr(module, "_holds", lambda _: holds)
    monkeypatch.setattr(module, "narrowed_starts", lambda _: [far_away])
    monkeypatch.setattr(module, "_through", lambda _: SimpleNamespace(objective=near))
    monkeypatch.setattr(module, "_rival", lambda *_: SimpleNamespace(objective=near))
    monkeypatch.setattr(module, "_beside_later_steps", lambda _: [])
    objectives = {"near": near, "far away": 20.0}
    monkeypatch.setattr(module, "refitted", lambda name, _: SimpleNamespace(objective=objectives[name]))
    monkeypatch.setattr(module, "explained", lambda *_: SimpleNamespace(adequacy_but_one=0.5))
    start: Any = SimpleNamespace(hypothesis="near", z=None)
    known = {"worth": np.inf, "far": False, "known": 180.0} | named
    best: Any = module._best_refit([start], **known)
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


def test_a_gross_row_that_one_effect_leaves_is_no_limit_to_what_costs_little() -> None:
    refit = SimpleNamespace(objective=240.0)
    leaves: Any = Chances(refit, 1e-20, 0.3)
    explains: Any = Chances(refit, 0.3, 0.3)
    assert module._worth([leaves]) == module._worth([explains], whole=True) == 240.0 + module.NEAR
    assert module._worth([leaves], whole=True) == np.inf


@pytest.mark.parametrize(("misfit", "limited"), [(600.0, False), (4500.0, True)])
def test_the_one_row_that_is_left_of_thousands_is_an_error(
    monkeypatch: pytest.MonkeyPatch, misfit: float, limited: bool
) -> None:
    """Springs of a clamp left a row of 148 of 4500, and all over the prior nothing else left less than 2000."""
    monkeypatch.setattr(module, "price", lambda _: CHEAP)
    monkeypatch.setattr(module, "is_poor", lambda _: True)
    monkeypatch.setattr(module, "_has_place", lambda _: False)
    monkeypatch.setattr(module, "nothing", lambda _: SimpleNamespace(adequacy=0.0))
    leaves: Any = Chances(SimpleNamespace(objective=302.0), 1e-8, 0.96)
    base: Any = SimpleNamespace(objective=misfit)
    start: Any = None
    limit = module._limit(base, (5.0, [start]), [leaves], np.inf)
    assert limit == (302.0 + module.NEAR if limited else np.inf)


def test_one_row_of_ten_times_its_noise_is_left_though_all_others_are_met() -> None:
    """A tooth of 4.93 mm typed as 4.47: of the declared model (2, 1) of the stack was off by 11 deviations."""
    one_row: Any = Chances(None, 1.8e-17, 0.7)
    assert module._leaves_rows(one_row, one_row)
    met: Any = Chances(None, 0.3, 0.7)
    assert not module._leaves_rows(one_row, met)
    assert not module._leaves_rows(met)
