"""What leads by far gets a model of its own before anything is sought beside it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from statorhom.diagnose import diagnosis as module
from statorhom.diagnose.fits.explanations import Explanation


class Led(Explanation[Any]):
    """With a chance of its misfit that is given."""

    adequacy_but_one = 0.0


def led(effect: str, log_evidence: float) -> Explanation[Any]:
    candidate: Any = SimpleNamespace(effect=effect, label=effect)
    return Led((candidate,), SimpleNamespace(objective=-2.0 * log_evidence), log_evidence)  # type: ignore[arg-type]


@pytest.fixture
def done(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """In which order models of their own and hidden materials were tried."""
    order: list[str] = []

    def hidden(_: Any, best: Explanation[Any], *__: Any) -> tuple[list[Explanation[Any]], bool]:
        order.append(f"hidden behind {best.log_evidence:.0f}")
        return [], True

    monkeypatch.setattr(module, "beside_hidden_materials", hidden)
    monkeypatch.setattr(module, "confirmed_pairs", lambda *_: ([], True))
    return order


def tried(done: list[str], *found: Explanation[Any]) -> list[str]:
    def refined(explanations: list[Explanation[Any]], *_: Any) -> list[Explanation[Any]]:
        done.append("refined")
        return [led(explanations[0].effects[0], -40.0), *explanations[1:]]

    leading: Any = SimpleNamespace(found=found, base=SimpleNamespace(valleys=()))
    approach: Any = SimpleNamespace(refined=refined)
    module._with_pairs(approach, leading, {}, 0)
    return done


def test_a_clamp_that_gives_way_is_refined_before_materials_are_suspected(done: list[str]) -> None:
    """One of −240 before a wrong bore of −870: pairs took ten minutes, and its own model explained all."""
    assert tried(done, led("support_compliance", -240.0), led("wrong_input", -870.0)) == [
        "refined",
        "hidden behind -40",
    ]


def test_where_rivals_are_near_hidden_materials_come_first(done: list[str]) -> None:
    assert tried(done, led("attached_mass", -240.0), led("wrong_input", -260.0)) == [
        "hidden behind -240",
        "refined",
    ]


@pytest.mark.parametrize(
    ("adequacy", "lead", "is_open"),
    # nothing is missed by more than chance, and no effect leads; one leads by little; and something is missed
    [(0.96, -1.4, False), (0.96, 0.5, True), (0.01, -1.4, True)],
)
def test_beside_an_adequate_model_pairs_need_a_lead(
    monkeypatch: pytest.MonkeyPatch, adequacy: float, lead: float, is_open: bool
) -> None:
    monkeypatch.setattr(module, "nothing", lambda _: SimpleNamespace(adequacy=adequacy, log_evidence=-40.0))
    leading: Any = SimpleNamespace(
        base=SimpleNamespace(refit=None), found=(SimpleNamespace(log_evidence=-40.0 + lead),)
    )
    assert module._is_open_to_pairs(leading) is is_open
