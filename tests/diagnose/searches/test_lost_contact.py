"""Arcs of lost contact: when they are sought, beside which winding the search begins, and what is made of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.evidence.decision import NEAR_RIVAL, OVER_NOTHING
from statorhom.diagnose.searches import lost_contact as module
from statorhom.diagnose.searches import refit_starts as starts_module
from statorhom.diagnose.searches import typical_materials as typical
from statorhom.diagnose.searches.arc_search import ANYWHERE, NEARBY, Reach
from statorhom.diagnose.searches.lost_contact import NARROW, ROUNDS, with_lost_contact
from statorhom.diagnose.searches.refit_starts import Start
from statorhom.errors import SolverError
from statorhom.physics.candidate import Candidate
from statorhom.physics.effects.interface_debond import ARC, LOSS, RATIO
from statorhom.physics.parameter import angle

ARCS = Candidate("interface_debond", "wound", (ARC, RATIO, LOSS, angle()), "winding")
LUMP = Candidate("attached_mass", "wound", (), "lamination")
PLACED = Candidate("attached_mass", "wound", (angle(),), "lamination")
# of a stack, and of the winding
NAMES = ("stack:lamination.E_p_pa", "wound:winding.E_p_pa", "wound:winding.G_rz_pa", "wound:winding.nu_p")
FOUND = np.array([0.4, 1.0, 1.2, 0.0, 0.1, 0.2, 0.3, 2.0])


class Search:
    """A search that finds one arc, whose objective falls from model to model."""

    def __init__(
        self, monkeypatch: pytest.MonkeyPatch, objectives: Sequence[float] = (90.0, 40.0, 35.0)
    ) -> None:
        self.begins: list[np.ndarray] = []  # of the typical winding's models
        self.begun: list[tuple[np.ndarray, Sequence[int]]] = []
        self.objectives = list(objectives)
        self.lost: list[str] = []  # tests of which what leads lacks a line
        self.fled = False  # whether the winding of what leads has
        self.own_fled = True  # and whether it still has in a model of its own
        self.symmetric = False  # whether what leads keeps the symmetry
        self.own = 0.0  # the chance of its misfit in a model of its own
        self.before = 0.0  # what the steps before the winding leave of the declared model
        items = tuple(SimpleNamespace(name=n, log=not n.endswith("nu_p"), fixed=False) for n in NAMES)
        tests = (SimpleNamespace(name="wound-free"),)
        stage = SimpleNamespace(
            name="wound", tests=tests, setup=SimpleNamespace(keys=SimpleNamespace(name="wound"))
        )
        self.study = study = SimpleNamespace(constants=SimpleNamespace(items=items), stages=(stage,))
        hypothesis = SimpleNamespace(study=study, candidates=(), constants=4)
        self.base: Any = SimpleNamespace(
            hypothesis=hypothesis, z=np.array([0.4, -2.0, -2.5, 0.7]), log_evidence=-200.0
        )
        monkeypatch.setattr(module, "nothing", lambda _: self.explanation(-200.0))
        monkeypatch.setattr(module, "explained", self.explained)
        monkeypatch.setattr(typical, "blank", lambda h, _: h)
        monkeypatch.setattr(typical, "evaluated", lambda h, z: SimpleNamespace(hypothesis=h, z=z))
        monkeypatch.setattr(typical, "in_its_own_model", self.usual)
        # the base with what leads' constants, and an arc's start in another model
        monkeypatch.setattr(module, "replace", lambda of, **new: of.__class__(**{**vars(of), **new}))
        monkeypatch.setattr(module, "in_its_own_model", self.model)
        monkeypatch.setattr(starts_module, "scan_starts", lambda *_: [np.zeros(4)])
        monkeypatch.setattr(starts_module, "start_of", self.start)
        monkeypatch.setattr(module, "best_arc", self.search)
        # what few vectors lead to is refitted in all
        monkeypatch.setattr(module, "varied", lambda _, winding: [*winding, 4, 5])
        monkeypatch.setattr(module, "followed_near", self.near)
        monkeypatch.setattr(module, "typical_where_fled", self.typical)
        monkeypatch.setattr(module, "refitted", self.refit)
        monkeypatch.setattr(module, "left_before", lambda *_: self.before)
        monkeypatch.setattr(module, "keeps_symmetry", lambda _: self.symmetric)
        monkeypatch.setattr(
            module,
            "sharpened",
            lambda e: self.explanation(e.log_evidence, self.leader(20.0, own=True), adequacy=self.own),
        )

    def typical(self, of: Any, stage: Any, *_: Any) -> Any:
        has_fled = self.fled and (self.own_fled or not hasattr(of, "own"))
        return stage if has_fled else None

    @staticmethod
    def start(base: Any, candidate: Candidate, z: np.ndarray) -> Start:
        hypothesis: Any = SimpleNamespace(study=base.hypothesis.study, candidates=(candidate,))
        return Start(hypothesis, np.r_[base.z, z])

    def leader(self, objective: float, **told: Any) -> Any:
        lines = [SimpleNamespace(test="wound-free", lost=False)]
        lines += [SimpleNamespace(test=test, lost=True) for test in self.lost]
        hypothesis = SimpleNamespace(study=self.study, constants=4, features=lambda _: lines)
        return SimpleNamespace(
            **{"z": np.zeros(8), "objective": objective, "cost": objective, "hypothesis": hypothesis, **told}
        )

    def explanation(
        self,
        log_evidence: float,
        refit: Any = None,
        adequacy: float = 0.0,
        of_all: float = 0.0,
        candidates: Sequence[Candidate] = (LUMP,),
    ) -> Any:
        return SimpleNamespace(
            log_evidence=log_evidence,
            refit=refit or self.leader(-log_evidence),
            adequacy=adequacy,
            adequacy_but_one=adequacy,
            adequacy_of_all=of_all,
            candidates=candidates,
        )

    def explained(self, r: Any, _: Any) -> Any:
        return self.explanation(-r.objective, r, adequacy=0.5 if r.objective < 30.0 else 0.0)

    def usual(self, hypothesis: Any, z: np.ndarray) -> Any:
        # the declared winding's mesh factors are none of a typical one, which gets its own
        self.begins.append(z)
        return hypothesis

    def model(self, hypothesis: Any, _: np.ndarray, *, quick: bool = False, around: Any = ()) -> Any:
        if around:
            assert around == NARROW and quick
        return hypothesis

    @staticmethod
    def near(_: Any, places: Sequence[int], z: np.ndarray) -> np.ndarray:
        # the winding, and the width and the ratio of the arc
        assert list(places) == [1, 2, 3, 4, 5]
        return z

    def search(self, start: Start, winding: Sequence[int], worth: float, reach: Reach) -> np.ndarray:
        self.worth, self.reach = worth, reach
        self.begun.append((start.z, winding))
        return FOUND

    def refit(self, hypothesis: Any, z: np.ndarray) -> Any:
        return SimpleNamespace(hypothesis=hypothesis, z=z, objective=self.objectives.pop(0))


def test_the_search_begins_beside_the_winding_that_is_usual(monkeypatch: pytest.MonkeyPatch) -> None:
    search = Search(monkeypatch)
    (found,) = with_lost_contact(search.base, [], [LUMP, ARCS], {})
    assert np.array_equal(found.refit.z, FOUND)
    # the stack stays as the declared model has it
    assert [z.tolist() for z in search.begins] == [[0.4, 0.0, 0.0, 0.0]]
    assert search.worth == 200.0 and search.reach is ANYWHERE
    ((z, winding),) = search.begun
    assert z.tolist() == [0.4, *np.zeros(7)] and list(winding) == [1, 2, 3]


@pytest.mark.parametrize(
    ("objectives", "left", "best"),
    [((90.0, 40.0, 35.0), 0, 35.0), ((20.0, 10.0), 1, 20.0), ((90.0, 95.0, 35.0), 1, 90.0)],
    ids=["while it explains more", "until it explains all", "until another model explains less"],
)
def test_models_of_its_own_are_made(
    monkeypatch: pytest.MonkeyPatch, objectives: Sequence[float], left: int, best: float
) -> None:
    search = Search(monkeypatch, objectives)
    (found,) = with_lost_contact(search.base, [], [ARCS], {})
    assert found.refit.objective == best
    assert len(search.objectives) == left
    assert len(objectives) <= ROUNDS


def test_nothing_is_sought_where_something_explains_the_misfit(monkeypatch: pytest.MonkeyPatch) -> None:
    search = Search(monkeypatch)
    enough = search.explanation(-20.0, adequacy=0.3)
    assert with_lost_contact(search.base, [enough], [ARCS], {}) == []
    assert not search.begun
    # a lump that leaves more than noise may stand in for an arc
    assert with_lost_contact(search.base, [search.explanation(-50.0, adequacy=0.05)], [ARCS], {})
    assert search.begun


@pytest.mark.parametrize(
    ("symmetric", "own", "sought"), [(True, 0.5, False), (True, 0.05, True), (False, 0.5, True)]
)
def test_what_explains_everything_in_a_model_of_its_own_needs_no_arcs(
    monkeypatch: pytest.MonkeyPatch, symmetric: bool, own: float, sought: bool
) -> None:
    """Beside a wrong mass arcs were sought for minutes, for the basis was not the mass's own."""
    search = Search(monkeypatch)
    search.symmetric, search.own = symmetric, own
    with_lost_contact(search.base, [search.explanation(-50.0, adequacy=0.05)], [ARCS], {})
    assert bool(search.begun) == sought


@pytest.mark.parametrize(("of_all", "sought"), [(0.05, True), (0.5, False)])
def test_an_arc_that_leads_has_to_leave_no_more_than_noise_in_losses_too(
    monkeypatch: pytest.MonkeyPatch, of_all: float, sought: bool
) -> None:
    search = Search(monkeypatch, (90.0, 40.0, 32.0))
    arc = search.explanation(-55.0, adequacy=0.5, of_all=of_all, candidates=(ARCS,))
    found = with_lost_contact(search.base, [arc], [ARCS], {})
    assert bool(search.begun) == sought
    assert [e.refit.objective for e in found] == ([32.0] if sought else [])


def lead(search: Search, candidate: Candidate, log_evidence: float = -20.0) -> Any:
    """What leaves no more than noise, with a winding of its own."""
    refit = search.leader(-log_evidence, z=np.array([0.5, 0.1, 0.2, 0.3, 9.0]))
    return search.explanation(log_evidence, refit, adequacy=0.5, candidates=(candidate,))


def test_behind_what_parts_lines_as_an_arc_does_arcs_are_sought_beside_its_winding(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    search = Search(monkeypatch, (25.0,))
    (found,) = with_lost_contact(search.base, [lead(search, PLACED)], [ARCS], {})
    assert found.refit.objective == 25.0
    assert search.reach is NEARBY and search.worth == 20.0 and not search.begins
    ((z, _),) = search.begun
    assert z.tolist() == [0.5, 0.1, 0.2, 0.3, *np.zeros(4)]


def test_an_arc_that_comes_near_what_leads_is_a_rival_and_one_far_behind_is_none(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for objective, count in ((20.0 + 0.9 * NEAR_RIVAL, 1), (20.0 + 1.1 * NEAR_RIVAL, 0)):
        search = Search(monkeypatch, (objective,) * ROUNDS)
        assert len(with_lost_contact(search.base, [lead(search, PLACED)], [ARCS], {})) == count


@pytest.mark.parametrize(
    "candidate", [replace(PLACED, stage="stack"), LUMP, ARCS], ids=["another step", "no place", "an arc"]
)
def test_what_an_arc_does_not_look_like_needs_none_for_a_rival(
    monkeypatch: pytest.MonkeyPatch, candidate: Candidate
) -> None:
    search = Search(monkeypatch, (25.0,))
    explanation = lead(search, candidate)
    explanation.adequacy_of_all = 0.5
    assert with_lost_contact(search.base, [explanation], [ARCS], {}) == []
    assert not search.begun


def test_behind_what_has_not_got_a_line_of_the_step_arcs_are_sought_anywhere(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A table's arc of 140°: a soft end winding left no more than noise but for a line that it had no mode for."""
    for tests, sought in ((["stack-free"], False), (["wound-free"], True)):
        search = Search(monkeypatch, (15.0,))
        search.lost = tests
        assert bool(with_lost_contact(search.base, [lead(search, LUMP)], [ARCS], {})) == sought
        assert bool(search.begun) == sought
    assert search.reach is ANYWHERE


@pytest.mark.parametrize(
    ("lost", "candidate", "lead_by", "sought"),
    [
        (["wound-free"], LUMP, 2 * OVER_NOTHING, True),
        (["wound-free"], LUMP, 1.0, False),
        ([], LUMP, 2 * OVER_NOTHING, False),
        ([], PLACED, 2 * OVER_NOTHING, True),
        ([], PLACED, 1.0, False),
    ],
    ids=[
        "a lead without a line",
        "what hardly leads",
        "all lines have partners",
        "what an arc looks like",
        "what looks like one and hardly leads",
    ],
)
def test_beside_a_declared_model_that_leaves_no_more_than_noise_what_leads_has_to_ask_for_arcs(
    monkeypatch: pytest.MonkeyPatch, lost: list[str], candidate: Candidate, lead_by: float, sought: bool
) -> None:
    """By recordings 159 g led by e21 where 22 degrees of a winding had let go, which may leave as much (61324)."""
    search = Search(monkeypatch, (15.0,))
    search.lost, search.fled = lost, True
    monkeypatch.setattr(module, "nothing", lambda _: search.explanation(-30.0, adequacy=0.065))
    found = with_lost_contact(search.base, [lead(search, candidate, lead_by - 30.0)], [ARCS], {})
    assert bool(found) == bool(search.begun) == sought


def test_behind_a_winding_that_has_fled_arcs_are_sought_anywhere(monkeypatch: pytest.MonkeyPatch) -> None:
    """A table's arc of 75°: another name of a line left no more than noise beside a winding of 12 MPa."""
    search = Search(monkeypatch, (25.0,))
    search.fled = True
    leader = search.leader(20.0, cost=60.0)  # its winding is sure of nothing
    enough = search.explanation(-50.0, leader, adequacy=0.5)
    (found,) = with_lost_contact(search.base, [enough], [ARCS], {})
    assert found.refit.objective == 25.0
    assert search.worth == 60.0 and search.reach is ANYWHERE


@pytest.mark.parametrize(
    ("symmetric", "own_fled", "sought"), [(True, False, False), (True, True, True), (False, False, True)]
)
def test_a_winding_that_has_not_fled_in_a_model_of_its_own_needs_no_arcs(
    monkeypatch: pytest.MonkeyPatch, symmetric: bool, own_fled: bool, sought: bool
) -> None:
    """Beside a soft end winding arcs were sought for minutes: in the declared winding's model its own seemed unsure."""
    search = Search(monkeypatch, (25.0,))
    search.fled, search.symmetric, search.own_fled, search.own = True, symmetric, own_fled, 0.9
    enough = search.explanation(-50.0, search.leader(20.0, cost=60.0), adequacy=0.5)
    assert bool(with_lost_contact(search.base, [enough], [ARCS], {})) == bool(search.begun) == sought


@pytest.mark.parametrize(("before", "sought"), [(70.0, True), (90.0, False)])
def test_no_arc_of_a_winding_mends_what_the_bare_stack_leaves(
    monkeypatch: pytest.MonkeyPatch, before: float, sought: bool
) -> None:
    """A wrong yoke that left one mistaken line: without it the stack alone leaves more than all with it."""
    search = Search(monkeypatch, (25.0,))
    search.fled, search.before = True, before
    enough = search.explanation(-50.0, search.leader(20.0, cost=60.0), adequacy=0.5)
    assert bool(with_lost_contact(search.base, [enough], [ARCS], {})) == sought
    assert bool(search.begun) == sought


def test_an_arc_that_explains_less_is_no_news(monkeypatch: pytest.MonkeyPatch) -> None:
    search = Search(monkeypatch)
    assert with_lost_contact(search.base, [search.explanation(1.0)], [ARCS], {}) == []
    assert search.begun


def test_windings_without_a_body_are_passed_over(monkeypatch: pytest.MonkeyPatch) -> None:
    def impossible(*_: Any, **__: Any) -> Any:
        raise SolverError("no such body")

    search = Search(monkeypatch)
    monkeypatch.setattr(module, "best_arc", impossible)
    assert with_lost_contact(search.base, [], [ARCS], {}) == []
    monkeypatch.setattr(typical, "evaluated", impossible)
    assert with_lost_contact(search.base, [], [ARCS], {}) == []
    assert not search.begun
