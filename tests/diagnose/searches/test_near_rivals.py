"""Rivals that are near each other are compared where each is at its best, and nothing is sought twice."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose import diagnosis
from statorhom.diagnose.searches import approach, sharper

LUMP, STRIP, WAVE = ("attached_mass",), ("local_stiffness",), ("ovality",)


@dataclass(frozen=True, eq=False)
class Said:
    """An explanation by what the choice of the way on looks at."""

    effects: tuple[str, ...]
    log_evidence: float
    adequacy_but_one: float = 0.5
    settled: bool = False

    @property
    def refit(self) -> Said:
        return self


@pytest.mark.parametrize(
    ("found", "is_open"),
    [
        ([Said(LUMP, 0.0)], False),
        ([Said(LUMP, 0.0, 0.04)], True),
        ([Said(LUMP, 0.0), Said(STRIP, -9.0)], True),
        ([Said(LUMP, 0.0), Said(STRIP, -11.0)], False),
        ([Said(LUMP, 0.0), Said(LUMP, -1.0)], False),
    ],
)
def test_an_answer_is_open_where_the_misfit_or_a_rival_leaves_it(found: list[Any], is_open: bool) -> None:
    assert diagnosis._is_open(found) is is_open


def test_near_rivals_get_models_of_their_own(monkeypatch: pytest.MonkeyPatch) -> None:
    better = {LUMP: 1.0, STRIP: 12.0, WAVE: 100.0}
    led = []

    def sharpened(e: Any, *, leads: bool) -> Any:
        led.append((e.effects, leads))
        return replace(e, log_evidence=e.log_evidence + better[e.effects])

    def deepest(own: Any, *_: object) -> Any:
        deeper.append(own.effects)
        return own

    deeper: list[Any] = []
    monkeypatch.setattr(sharper, "sharpened", sharpened)
    monkeypatch.setattr(sharper, "_deepest", deepest)
    monkeypatch.setattr(sharper, "_settled", lambda refit, _: replace(refit, settled=True))
    found: list[Any] = [Said(LUMP, 0.0), Said(STRIP, -8.0), Said(WAVE, -30.0)]
    now = sharper.refined(found, [], {})
    assert [e.effects for e in now] == [STRIP, LUMP, WAVE]
    assert led == [(LUMP, True), (STRIP, False)]
    # a strip that stood in a side valley beside a suspension that explained all was left out of the answer
    assert deeper == [STRIP]
    assert [e.settled for e in now] == [True, True, False]


def test_what_stands_in_a_model_of_its_own_is_not_sought_again(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(approach, "at_likelier_height", lambda e: e)
    monkeypatch.setattr(approach, "at_its_own_materials", lambda e: e)
    monkeypatch.setattr(approach, "sharpened", lambda e: replace(e, log_evidence=5.0))
    assert approach._ring_final(Said(LUMP, 0.0, settled=True)).log_evidence == 0.0  # type: ignore[arg-type]
    assert approach._ring_final(Said(LUMP, 0.0)).log_evidence == 5.0  # type: ignore[arg-type]


def test_valleys_are_followed_that_are_new_and_near() -> None:
    def rough(at: float, objective: float) -> Any:
        return SimpleNamespace(z=np.array([at]), objective=objective)

    tried = [rough(0.0, 50.0)]
    assert sharper._is_news(rough(2.0, 60.0), tried)
    assert not sharper._is_news(rough(0.5, 40.0), tried)
    assert not sharper._is_news(rough(2.0, 75.0), tried)
    assert sharper._is_news(rough(2.0, 1e9), [])
