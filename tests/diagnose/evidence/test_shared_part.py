"""What is sure of an ambiguous answer: the part of the machine that all likely explanations concern."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from statorhom.diagnose.evidence import shared_part as module
from statorhom.diagnose.evidence.shared_part import shared_part
from statorhom.physics.library import library, part_of

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from example_evidence import GOOD

NEAR = replace(GOOD, over_others=0.8)
BACK = ("the back of the core",)


def explanation(log_evidence: float, *effects: str) -> Any:
    return SimpleNamespace(effects=effects, log_evidence=log_evidence)


def told(found: Sequence[Any], evidence: Any = NEAR) -> tuple[str, ...]:
    return shared_part(evidence, found, explanation(-40.0), 1)


@pytest.fixture(autouse=True)
def compared(monkeypatch: pytest.MonkeyPatch) -> list[list[str]]:
    """Effects of the rivals that resamplings saw."""
    seen: list[list[str]] = []

    def stability(explanations: Sequence[Any], _: int) -> float:
        seen.append(["+".join(e.effects) for e in explanations[2:]])
        return 1.0

    monkeypatch.setattr(module, "stability", stability)
    return seen


def test_a_lump_or_a_strip_is_on_the_back_of_the_core_in_any_case(compared: list[list[str]]) -> None:
    found = [
        explanation(0.0, "attached_mass"),
        explanation(-0.8, "local_stiffness"),
        explanation(-6.0, "suspension_stiffness"),
    ]
    assert told(found) == BACK
    assert compared == [["suspension_stiffness"]]


def test_a_rival_elsewhere_leaves_the_part_open() -> None:
    found = [explanation(0.0, "attached_mass"), explanation(-2.0, "suspension_stiffness")]
    assert told(found) == ()


def test_two_of_a_part_are_together_ahead_of_a_rival_elsewhere() -> None:
    """Each of them by less than is asked for: by 2.6, and together by 3.3."""
    both = [explanation(0.0, "attached_mass"), explanation(0.0, "ovality")]
    assert told([*both, explanation(-2.6, "suspension_stiffness")]) == BACK
    assert told([both[0], explanation(-2.6, "suspension_stiffness")]) == ()


def test_a_part_passes_the_other_rules_too(monkeypatch: pytest.MonkeyPatch) -> None:
    found = [explanation(0.0, "attached_mass"), explanation(-0.8, "local_stiffness")]
    assert told(found, replace(NEAR, over_discrepancy=1.0)) == ()
    assert told(found, replace(NEAR, confirmed=False)) == ()
    monkeypatch.setattr(module, "stability", lambda *_: 0.7)
    assert told(found) == ()


def test_with_a_second_effect_it_is_concerned_all_the_same() -> None:
    """A lump beside a soft end winding is no rival of a lump, as far as the back of the core is concerned."""
    found = [explanation(0.0, "attached_mass"), explanation(-1.0, "attached_mass", "end_winding_stiffness")]
    assert told(found) == BACK
    assert told(found[::-1]) == ()  # and the winding is not sure


def test_an_effect_without_a_part_is_like_no_other(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "part_of", lambda effect: effect if effect == "ovality" else part_of(effect))
    assert told([explanation(0.0, "ovality"), explanation(-1.0, "attached_mass")]) == ()
    assert told([explanation(0.0, "attached_mass"), explanation(-1.0, "ovality")]) == ()


def test_every_effect_of_the_library_says_its_part() -> None:
    assert all(effect.part for effect in library().values())
