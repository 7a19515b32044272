"""The search for arcs beside any winding: what is tried, followed, turned and judged."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.fits import valleys as valleys_of
from statorhom.diagnose.fits.explanations import NARROWING
from statorhom.diagnose.fits.own_model import ITSELF
from statorhom.diagnose.fits.valleys import FAR_BEHIND
from statorhom.diagnose.searches import arc_search as module
from statorhom.diagnose.searches.arc_search import ANYWHERE, NEARBY, best_arc
from statorhom.diagnose.searches.refit_starts import Start
from statorhom.physics.candidate import Candidate
from statorhom.physics.effects.interface_debond import ARC, LOSS, RATIO
from statorhom.physics.parameter import angle

ARCS = Candidate("interface_debond", "wound", (ARC, RATIO, LOSS, angle()), "winding")
TRUE = {"arc_deg": 90.0, "contact_ratio": 3e-4}
PLACE = 3.0
WINDING = (1, 2)
PLACES = [*WINDING, 3, 4]  # with the width and the ratio of the arc


class Hypothesis:
    """Of a stack's constant, two of a winding, and an arc."""

    candidates = (ARCS,)
    shared: tuple[object, ...] = ()

    def __init__(self, name: str = "start", discrepancy: float = 0.0) -> None:
        self.name, self.discrepancy = name, discrepancy

    def within(self, changes: dict[str, Any]) -> Hypothesis:
        return Hypothesis(self.name, changes.get("discrepancy", self.discrepancy))

    def __len__(self) -> int:
        return 3 + len(ARCS.parameters)

    def limits(self) -> tuple[np.ndarray, np.ndarray]:
        return np.full(len(self), -6.0), np.full(len(self), 8.0)


def effect(z: np.ndarray) -> dict[str, float]:
    return {p.name: p.value(float(u)) for p, u in zip(ARCS.parameters, z[3:], strict=True)}


class Search:
    """Every point is its own optimum; the objective is the distance from one winding and arc."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.followed: dict[float, list[np.ndarray]] = {}  # by the width of the valleys
        self.known: list[Sequence[np.ndarray]] = []  # by bases that were made in turn
        self.quick: list[bool] = []  # and whether mesh factors stayed what they were
        self.least = 0.0  # objective below which nothing is left to explain
        monkeypatch.setattr(module, "replace", lambda h, **changes: h.within(changes))
        monkeypatch.setattr(module, "in_few_vectors", lambda *_: Hypothesis("few"))
        monkeypatch.setattr(module, "by_degrees", self.by_degrees)
        monkeypatch.setattr(module, "refitted", self.refitted)
        monkeypatch.setattr(module, "in_valleys", self.in_valleys)
        monkeypatch.setattr(module, "narrowed", self.narrowed)
        monkeypatch.setattr(module, "in_its_own_model", self.knowing)
        monkeypatch.setattr(module, "with_neighbours", lambda _, points, __: points)
        monkeypatch.setattr(module, "in_few_vectors_near", self.near)
        monkeypatch.setattr(module, "_leaves_nothing", lambda found: found.objective < self.least)
        monkeypatch.setattr(valleys_of, "refit_objective", self.objective)

    def knowing(
        self, hypothesis: Hypothesis, z: np.ndarray, *, elsewhere: Any, around: Any, quick: bool = False
    ) -> Hypothesis:
        assert around == ITSELF
        self.known.append([z, *elsewhere])
        self.quick.append(quick)
        return hypothesis

    @staticmethod
    def near(hypothesis: Hypothesis, _: np.ndarray, places: Sequence[int]) -> Hypothesis:
        # the winding, and the width and the ratio of the arc
        assert list(places) == [1, 2, 3, 4] and hypothesis.name == "own"
        return hypothesis

    @staticmethod
    def objective(_: Hypothesis, z: np.ndarray) -> float:
        found = effect(z)
        away = sum(np.log(found[name] / value) ** 2 for name, value in TRUE.items())
        turned = 0.1 * (1 - np.cos(found["angle_rad"] - PLACE))
        return float(away + turned + np.sum((z[list(WINDING)] - [0.5, -1.0]) ** 2))

    def by_degrees(self, hypothesis: Hypothesis, z: np.ndarray) -> Any:
        assert hypothesis.name == "own"
        return self.refitted(hypothesis, z)

    def refitted(self, hypothesis: Hypothesis, z: np.ndarray) -> Any:
        if hypothesis.name != "own":
            self.followed.setdefault(hypothesis.discrepancy, []).append(z)
        return SimpleNamespace(hypothesis=hypothesis, z=z, objective=self.objective(hypothesis, z))

    def in_valleys(self, hypothesis: Hypothesis, z: np.ndarray, discrepancy: float) -> Any:
        return self.refitted(hypothesis.within({"discrepancy": discrepancy}), z)

    def narrowed(self, rough: Any, steps: Sequence[float]) -> Any:
        assert tuple(steps) == NARROWING[1:]
        return self.refitted(Hypothesis(rough.hypothesis.name, steps[-1]), rough.z)


@pytest.fixture
def search(monkeypatch: pytest.MonkeyPatch) -> Search:
    return Search(monkeypatch)


def start() -> Start:
    usual = [p.internal(v) for p, v in zip(ARCS.parameters, (60.0, 1e-3, 0.03, 0.0), strict=True)]
    return Start(Hypothesis(), np.r_[0.4, 0.0, 0.0, usual])  # type: ignore[arg-type]


def test_the_best_winding_and_arc_of_all_that_are_tried_is_found(search: Search) -> None:
    z = best_arc(start(), WINDING, 100.0, ANYWHERE)
    assert z is not None
    found = effect(z)
    # the stack stays where it was; the arc is turned to its best place
    assert z[0] == 0.4
    assert found["angle_rad"] == pytest.approx(PLACE, abs=np.pi / module.PLACES)
    assert search.objective(Hypothesis(), z) < 0.5
    # as far as valleys are wider than what the bases miss, and fewer and fewer all the way in bases that know them
    (most,), again = ANYWHERE.followed, sum(ANYWHERE.again)
    counts = [len(search.followed[discrepancy]) for discrepancy in (*NARROWING, 0.0)]
    assert counts == [most + again, again, 2 * again]
    # first windings and arcs that lie far apart, then what these led to
    first, *rest = search.known
    assert len(first) == 1 + ANYWHERE.known and [len(known) for known in rest] == list(ANYWHERE.again)
    assert np.ptp(np.array(first)[:, PLACES], axis=0).min() > 1.5  # of prior standard deviations
    # a start has mesh factors of its own; then they are those of what leads
    assert search.quick == [True, False, False]
    assert {z.tobytes() for z in rest[0]} <= {z.tobytes() for z in search.followed[NARROWING[0]][:most]}


def test_what_leaves_nothing_to_explain_is_not_followed_again(search: Search) -> None:
    search.least = 0.5
    z = best_arc(start(), WINDING, 100.0, ANYWHERE)
    assert z is not None and search.objective(Hypothesis(), z) < 0.5
    assert [len(known) for known in search.known[1:]] == list(ANYWHERE.again[:1])


@pytest.mark.usefixtures("search")
def test_points_lie_all_over_windings_and_arcs() -> None:
    points = module._points(start(), WINDING, ANYWHERE, ANYWHERE.trials, 0)
    for name, (low, high) in {"arc_deg": ANYWHERE.widths_deg, "contact_ratio": ANYWHERE.ratios}.items():
        values = [effect(z)[name] for z in points]
        assert low <= min(values) < 1.1 * low and 0.9 * high < max(values) <= high
    spread = np.array(points)[:, list(WINDING)]
    assert spread.min() < -2.0 and spread.max() > 2.0


@pytest.mark.usefixtures("search")
def test_points_nearby_have_a_winding_like_the_first_and_narrower_arcs() -> None:
    begun = start()
    points = module._points(begun, WINDING, NEARBY, NEARBY.trials, 0)
    aside = np.array(points)[:, list(WINDING)] - begun.z[list(WINDING)]
    assert NEARBY.aside is not None
    assert 0.9 * NEARBY.aside < np.abs(aside).max() <= NEARBY.aside
    widths = [effect(z)["arc_deg"] for z in points]
    assert min(widths) < ANYWHERE.widths_deg[0] and max(widths) < 1.01 * NEARBY.widths_deg[1]


def test_the_best_of_what_is_nearby_needs_no_other_bases(search: Search) -> None:
    begun = start()
    begun.z[list(WINDING)] = 0.4, -0.8
    z = best_arc(begun, WINDING, 100.0, NEARBY)
    assert z is not None and search.objective(Hypothesis(), z) < 0.5
    assert search.known == []
    # fewer and fewer are followed as the valleys narrow, the last ones once more from the best places of their arcs
    most, fewer, fewest = NEARBY.followed
    counts = [len(search.followed[discrepancy]) for discrepancy in (*NARROWING, 0.0)]
    assert counts == [most, fewer, 2 * fewest]


@pytest.mark.usefixtures("search")
def test_the_same_points_give_the_same_answer() -> None:
    first, second = (best_arc(start(), WINDING, 100.0, ANYWHERE) for _ in range(2))
    assert first is not None and np.array_equal(first, second)  # type: ignore[arg-type]


@pytest.mark.parametrize("direct", [True, False])
def test_of_both_ways_into_a_model_of_its_own_the_better_one_counts(
    search: Search, monkeypatch: pytest.MonkeyPatch, direct: bool
) -> None:
    best = start().z
    ways = {"refitted": search.refitted, "by_degrees": search.by_degrees}
    other = "by_degrees" if direct else "refitted"
    # its arc is a third as wide in the end
    astray = np.r_[best[:3], ARCS.parameters[0].internal(20.0), best[4:]]
    monkeypatch.setattr(module, other, lambda h, _: ways[other](h, astray))
    monkeypatch.setattr(module, "_turned", lambda found: found)
    own: Any = Hypothesis("own")
    assert np.array_equal(module.followed_near(own, PLACES, best), best)


@pytest.mark.usefixtures("search")
def test_in_a_model_of_its_own_an_arc_is_turned_to_its_best_place() -> None:
    own: Any = Hypothesis("own")
    z = module.followed_near(own, PLACES, start().z)
    assert z is not None
    assert effect(z)["angle_rad"] == pytest.approx(PLACE, abs=np.pi / module.PLACES)


@pytest.mark.usefixtures("search")
def test_where_no_winding_can_be_followed_nothing_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "in_valleys", lambda *_, **__: None)
    assert best_arc(start(), WINDING, 100.0, ANYWHERE) is None


def test_an_arc_that_explains_no_more_than_is_explained_without_gets_no_bases(search: Search) -> None:
    assert best_arc(start(), WINDING, -FAR_BEHIND, ANYWHERE) is None
    assert len(search.known) == 1
