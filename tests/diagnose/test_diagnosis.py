"""What of the whole way is gone where the verdict can no longer depend on it."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import pytest

from statorhom.diagnose import diagnosis
from statorhom.diagnose.evidence.decision import OVER_ADEQUATE, OVER_NOTHING


@dataclass(frozen=True)
class Lump:
    log_evidence: float
    effects: tuple[str, ...] = ("attached_mass",)
    is_pair: bool = False
    compared: Any = None


def in_models_of_their_own(monkeypatch: pytest.MonkeyPatch, over: float, adequacy: float) -> list[Lump]:
    """What gets a model of its own for its numbers where a lump leads by so much over a declared model."""
    lump, asked = Lump(over - 100.0), []
    leading = SimpleNamespace(
        found=(lump,),
        misfit_is_real=False,
        base=SimpleNamespace(refit=None),
        scan=None,
        by_chance=lambda _: False,
    )

    def final(best: Lump) -> Lump:
        asked.append(best)
        return best

    for name, value in {
        "all_candidates": lambda _: [],
        "leading_effects": lambda *_: leading,
        "nothing": lambda _: SimpleNamespace(log_evidence=-100.0, adequacy=adequacy),
        "_evidence": lambda *_: diagnosis.Evidence(*[0.0] * 5, None, *[0.0] * 4, True, 1.0),
        "decide": lambda _: "none",
    }.items():
        monkeypatch.setattr(diagnosis, name, value)
    approach: Any = SimpleNamespace(baseline=lambda *_: None, final=final)
    settings: Any = SimpleNamespace(seed=0)
    unread: Any = None
    diagnosis._find(approach, unread, unread, {}, settings, lambda *_: lambda _: None)
    return asked


@pytest.mark.parametrize(("adequacy", "least"), [(0.0, OVER_NOTHING), (0.5, OVER_ADEQUATE)])
def test_what_the_evidence_cannot_name_gets_no_model_of_its_own(
    monkeypatch: pytest.MonkeyPatch, adequacy: float, least: float
) -> None:
    """It took 40 s of a clean chain's time, where an uneven pressure led by too little."""
    assert in_models_of_their_own(monkeypatch, least - 0.1, adequacy) == []
    assert in_models_of_their_own(monkeypatch, least + 0.1, adequacy) == [Lump(least + 0.1 - 100.0)]
