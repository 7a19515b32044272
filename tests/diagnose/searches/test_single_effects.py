"""Which refits are given up early: what has a place near an optimum, all that is dear beside a poor model."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.searches import single_effects as module
from statorhom.diagnose.searches.refit_starts import CHEAP, MIDDLING
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
    monkeypatch.setattr(module, "best_refit", best_refit)
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
    monkeypatch.setattr(module, "best_refit", best_refit)
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


def test_what_costs_more_and_promises_nothing_waits_for_what_promises_something(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A pressure that rises along the stack took 45 s beside a winding that explained everything in three."""
    monkeypatch.setattr(module, "price", lambda trial: trial[1][0])

    def together(*trials: tuple[float, int]) -> int:
        waiting: Any = [(gain, [price]) for gain, price in trials]
        return module._together(waiting)

    assert together((112.0, CHEAP), (109.0, CHEAP), (1.0, MIDDLING), (1.0, CHEAP)) == 2
    assert together((112.0, CHEAP), (1.0, CHEAP), (90.0, MIDDLING)) == 3
    # nothing that could tell anything of them comes before
    assert together((1.0, MIDDLING), (1.0, MIDDLING), (0.0, CHEAP)) == 3
    assert together(*[(50.0, CHEAP)] * 9) == module.TOGETHER


def test_of_a_poor_model_cheap_effects_are_followed_through_other_valleys(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert worths(monkeypatch, 900.0, CHEAP, MIDDLING) == [np.inf, LIMIT]


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
