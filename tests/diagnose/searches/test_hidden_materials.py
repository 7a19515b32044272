"""When materials that another effect hides are sought in wide valleys, and what is made of them."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from statorhom.diagnose.fits.explanations import PAIR_GAIN
from statorhom.diagnose.searches import hidden_materials as module
from statorhom.diagnose.searches.hidden_materials import GAIN, beside_hidden_materials

DECLARED = 200.0  # objective in wide valleys


def explanation(log_evidence: float, adequacy: float = 0.0, effects: int = 2) -> Any:
    refit = SimpleNamespace(log_evidence=log_evidence)
    return SimpleNamespace(
        log_evidence=log_evidence, adequacy_but_one=adequacy, refit=refit, is_pair=effects > 1
    )


def leading(*effects: str) -> Any:
    hypothesis = SimpleNamespace(candidates=(), study=None)
    free = SimpleNamespace(hypothesis=hypothesis, z=None)
    rows = tuple(SimpleNamespace(candidate=SimpleNamespace(effect=e)) for e in effects)
    return SimpleNamespace(
        base=SimpleNamespace(free=free), scan=SimpleNamespace(of_every_candidate=lambda: rows)
    )


@pytest.fixture
def stand_ins(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """A stack in which sheets may slide, and a lump; what is tried beside them is noted."""
    told: dict[str, Any] = {
        "tried": [],
        "rough": DECLARED - GAIN - 1,
        "pair": 0.0,
        "unseen": (True, False),
        "poor": True,
    }

    def starts_of(_: Any, __: Any, signature: Any) -> list[Any]:
        changes = signature.candidate.effect == "interlaminar_shear"
        action = SimpleNamespace(materials=changes or None)
        hypothesis = SimpleNamespace(actions=lambda _: (action,), name=signature.candidate.effect)
        return [SimpleNamespace(hypothesis=hypothesis, z=None)]

    def searched(start: Any) -> list[Any]:
        rough = SimpleNamespace(objective=told["rough"], hypothesis=start.hypothesis)
        return [SimpleNamespace(rough=None), SimpleNamespace(rough=rough)]

    def second_effects(first: Any, *_: Any) -> list[Any]:
        told["tried"].append(first.name)
        return [explanation(told["pair"] - 1.0), explanation(told["pair"])]

    def unseen(base: Any, best: Any) -> Any:
        told["against"] = (base.log_evidence, best.log_evidence)
        falls, worsens = told["unseen"]
        return SimpleNamespace(falls=falls, worsens=worsens)

    replaced = {
        "starts_of": starts_of,
        "searched": searched,
        "second_effects": second_effects,
        "unseen_modes": unseen,
        "price": lambda _: module.CHEAP,
        "is_poor": lambda _: told["poor"],
        "blank": lambda hypothesis, _: hypothesis,
        "widened": lambda *_: SimpleNamespace(objective=DECLARED),
        "left_over": lambda *_: None,
        "may_be_added": lambda *_: None,
        "with_both_needed": lambda pairs, _: pairs,
        "explained": lambda first, _: first,
        "_in_narrow_valleys": lambda rough, _: SimpleNamespace(name=rough.hypothesis.name, refit=None),
    }
    for name, stand_in in replaced.items():
        monkeypatch.setattr(module, name, stand_in)
    return told


def pairs_beside(adequacy: float = 0.0) -> tuple[list[float], bool]:
    found, confirmed = beside_hidden_materials(
        leading("attached_mass", "interlaminar_shear"), explanation(-60.0, adequacy), {}, 0
    )
    return [e.log_evidence for e in found], confirmed


def test_pairs_are_sought_beside_materials_alone_and_the_best_comes_first(stand_ins: dict[str, Any]) -> None:
    assert pairs_beside() == ([0.0, -1.0], True)
    assert stand_ins["tried"] == ["interlaminar_shear"]
    assert stand_ins["against"] == (-60.0, 0.0)


@pytest.mark.parametrize(
    ("name", "value"), [("rough", DECLARED - GAIN + 1), ("poor", False), ("pair", -60.0 + PAIR_GAIN - 0.5)]
)
def test_no_pair_where_there_is_nothing_to_gain(stand_ins: dict[str, Any], name: str, value: Any) -> None:
    stand_ins[name] = value
    assert pairs_beside() == ([], True)


def test_an_explanation_that_leaves_no_more_than_noise_hides_nothing(stand_ins: dict[str, Any]) -> None:
    assert pairs_beside(adequacy=0.5) == ([], True)
    assert stand_ins["tried"] == []


def test_an_effect_that_needs_no_other_one_needs_no_confirmation(
    stand_ins: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "with_both_needed", lambda *_: [explanation(-3.0, effects=1)])
    stand_ins["unseen"] = (False, False)
    assert pairs_beside() == ([-3.0], True)


@pytest.mark.parametrize("unseen", [(False, False), (True, True)])
def test_unseen_modes_have_to_confirm_the_pair(stand_ins: dict[str, Any], unseen: tuple[bool, bool]) -> None:
    stand_ins["unseen"] = unseen
    assert pairs_beside() == ([0.0, -1.0], False)
