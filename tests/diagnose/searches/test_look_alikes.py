"""Behind which leads what looks like them is sought thoroughly, and what of it counts as a rival."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.evidence.decision import AS_IT_SHOULD, NEAR_RIVAL, OVER_ADEQUATE
from statorhom.diagnose.fits.explanations import WELL
from statorhom.diagnose.searches import look_alikes as module
from statorhom.diagnose.searches.look_alikes import NEAR, look_alikes

LEAD = -50.0  # log evidence
# objectives of what is found in the common model, and log evidence in models of their own
COMMON = {"end_winding_stiffness": 80.0, "loose_winding_mass": 20.0}


def candidate(effect: str, stage: str = "wound") -> Any:
    return SimpleNamespace(effect=effect, stage=stage, label=f"{effect} {stage}")


def lead(effect: str, adequacy: float = 2 * WELL, stage: str = "wound") -> Any:
    """Two constants and what the effect adds."""
    return SimpleNamespace(
        candidates=(candidate(effect, stage),),
        log_evidence=LEAD,
        adequacy_but_one=adequacy,
        refit=SimpleNamespace(objective=10.0, z=np.array([0.5, 0.6, 9.0])),
    )


def base(adequacy: float = 0.0, behind: float = 50.0) -> Any:
    """The declared model, behind the lead by some log evidence."""
    files = SimpleNamespace(drawing=SimpleNamespace(kind="stator"))
    stages = [SimpleNamespace(name=n) for n in ("stack", "wound")]
    study = SimpleNamespace(stages=stages, files=files)
    return SimpleNamespace(
        adequacy=adequacy,
        log_evidence=LEAD - behind,
        z=np.zeros(2),
        hypothesis=SimpleNamespace(study=study, constants=2),
    )


CANDIDATES = [
    candidate(effect, stage)
    for effect in ("viscoelastic_winding", "end_winding_stiffness", "loose_winding_mass", "wrong_input")
    for stage in ("stack", "wound")
]


@pytest.fixture
def sought(monkeypatch: pytest.MonkeyPatch) -> tuple[list[str], dict[str, float]]:
    """Labels of what was sought, and effect → log evidence in a model of its own."""
    seen: list[str] = []
    evidence = {"end_winding_stiffness": LEAD + 40.0, "loose_winding_mass": LEAD - 2 * NEAR_RIVAL}

    def best_of_many(start: Any) -> Any:
        seen.append(start.label)
        return SimpleNamespace(effect=start.effect, objective=COMMON[start.effect])

    def in_own_models(found: list[Any], _: Any) -> list[Any]:
        return [SimpleNamespace(effect=r.effect, log_evidence=evidence[r.effect]) for r in found]

    monkeypatch.setattr(module, "Hypothesis", SimpleNamespace)
    monkeypatch.setattr(module, "nothing", lambda base: base)
    monkeypatch.setattr(module, "cheap_starts", lambda _, candidates: candidates)
    monkeypatch.setattr(module, "replace", lambda of, **new: SimpleNamespace(**{**vars(of), **new}))
    monkeypatch.setattr(module, "shared_by", lambda _: [])
    monkeypatch.setattr(module, "best_of_many", best_of_many)
    monkeypatch.setattr(module, "in_own_models", in_own_models)
    return seen, evidence


def test_what_a_lead_is_taken_for_leads_once_it_was_sought(sought: Any) -> None:
    """The library calls a winding that follows the frequency like a soft end winding."""
    found = look_alikes(base(), [lead("viscoelastic_winding")], CANDIDATES, {})
    assert [e.effect for e in found] == ["end_winding_stiffness"]
    assert sought[0] == ["end_winding_stiffness wound"]


def test_both_effects_may_say_that_they_are_confused_and_what_stays_behind_is_no_rival(sought: Any) -> None:
    """Of wrong inputs it is the loose winding that says so, and it is sought on the lead's step alone."""
    assert not look_alikes(base(), [lead("wrong_input")], CANDIDATES, {})
    assert sought[0] == ["loose_winding_mass wound"]
    sought[1]["loose_winding_mass"] = LEAD - 0.5 * NEAR_RIVAL
    found = look_alikes(base(), [lead("wrong_input")], CANDIDATES, {})
    assert [e.effect for e in found] == ["loose_winding_mass"]


def test_what_is_far_behind_in_the_common_model_gets_none_of_its_own(
    sought: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(COMMON, "end_winding_stiffness", 10.0 + NEAR)
    assert not look_alikes(base(), [lead("viscoelastic_winding")], CANDIDATES, {})
    assert sought[0]


@pytest.mark.usefixtures("sought")
def test_where_the_declared_model_may_do_as_well_they_are_sought_beside_the_winding_of_the_lead(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A wrong mass led a loose winding whose valley six starts had missed by e45 (61280); it leads by e3."""
    beside: list[list[float]] = []

    def cheap(declared: Any, candidates: Any) -> Any:
        beside.append(list(declared.z))
        return candidates

    monkeypatch.setattr(module, "cheap_starts", cheap)
    monkeypatch.setattr(module, "best_of_sizes", module.best_of_many)
    monkeypatch.setattr(module, "best_of_many", lambda _: pytest.fail("the whole prior"))
    declared = base(2 * AS_IT_SHOULD, behind=1.1 * OVER_ADEQUATE)
    found = look_alikes(declared, [lead("viscoelastic_winding")], CANDIDATES, {})
    assert [e.effect for e in found] == ["end_winding_stiffness"]
    assert beside == [[0.5, 0.6]]


@pytest.mark.parametrize(
    ("declared", "leads"),
    [
        (
            base(2 * AS_IT_SHOULD, 0.9 * OVER_ADEQUATE),
            lead("viscoelastic_winding"),
        ),  # nothing need be missing
        (base(), lead("viscoelastic_winding", 0.5 * WELL)),  # sought thoroughly in any case
        (base(), lead("wrong_input", stage="stack")),  # a core has one valley
    ],
)
def test_nothing_is_sought_where_no_name_hangs_on_it(sought: Any, declared: Any, leads: Any) -> None:
    assert not look_alikes(declared, [leads], CANDIDATES, {})
    assert not sought[0]
    assert not look_alikes(base(), [], CANDIDATES, {})
