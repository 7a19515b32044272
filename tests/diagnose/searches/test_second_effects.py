"""Which effects are tried beside the first, and what they must gain."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.fits.explanations import PAIR_GAIN, Explanation
from statorhom.diagnose.located.scan import Scan, Signature
from statorhom.diagnose.searches import second_effects as module
from statorhom.diagnose.searches.second_effects import SECONDS, may_be_added, second_effects


def signature(effect: str, gain: float, *, repeats: bool = False, place: str = "") -> Signature:
    candidate: Any = SimpleNamespace(effect=effect, label=f"{effect} {place}", repeats=repeats)
    return Signature(candidate, np.zeros(1), np.ones(1), 1.0, gain, np.ones(1))


def first(misfit: float) -> Explanation:
    lump: Any = SimpleNamespace(effect="attached_mass")
    refit: Any = SimpleNamespace(misfit=misfit, objective=misfit, jacobian=np.zeros((100, 1)))
    return Explanation((lump,), refit, -50.0)


def tried(
    monkeypatch: pytest.MonkeyPatch,
    one: Explanation,
    scan: Scan,
    gains: tuple[float, ...] = (),
    adequacy: float = 0.5,
) -> tuple[list[str], float, list[Explanation]]:
    """Labels of the favourites, the limit of their objective, and what is found."""
    seen: dict[str, Any] = {}

    def in_order(base: Any, found: Scan, favourites: tuple[Signature, ...]) -> None:
        assert base is one.refit
        assert all(f in found.signatures for f in favourites)
        seen["favourites"] = [s.candidate.label.strip() for s in favourites]

    def refits(base: Any, *trials: Any) -> list[Explanation]:
        seen["limit"] = trials[-1]
        return [Explanation(one.candidates, base, one.log_evidence + gain) for gain in gains]

    monkeypatch.setattr(Explanation, "adequacy_but_one", adequacy)
    monkeypatch.setattr(module, "in_order", in_order)
    monkeypatch.setattr(module, "refits", refits)
    found = second_effects(one, may_be_added(one, scan), {})
    return seen["favourites"], seen["limit"], found


def test_the_same_effect_again_only_where_it_may_repeat(monkeypatch: pytest.MonkeyPatch) -> None:
    scan = Scan((signature("attached_mass", 90.0), signature("ovality", 50.0)), 0.0)
    assert tried(monkeypatch, first(200.0), scan)[0] == ["ovality"]
    again = Scan((signature("attached_mass", 90.0, repeats=True), signature("ovality", 50.0)), 0.0)
    assert tried(monkeypatch, first(200.0), again)[0] == ["attached_mass", "ovality"]


def test_few_are_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    many = Scan(tuple(signature("ovality", 50.0 - k, place=str(k)) for k in range(2 * SECONDS)), 0.0)
    assert tried(monkeypatch, first(200.0), many)[0] == [f"ovality {k}" for k in range(SECONDS)]


def test_what_gains_too_little_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    scan = Scan((signature("ovality", 50.0),), 0.0)
    assert tried(monkeypatch, first(200.0), scan)[1] == 200.0 - 2 * PAIR_GAIN


def pair(objective: float, *, breaks: bool = True, changes: bool = True) -> Explanation:
    """Of two effects, one of which breaks the symmetry, and one changes materials."""
    actions = (
        SimpleNamespace(changes=breaks or None, materials=None),
        SimpleNamespace(changes=None, materials=changes or None),
    )
    hypothesis = SimpleNamespace(actions=lambda _: actions)
    refit: Any = SimpleNamespace(objective=objective, hypothesis=hypothesis, z=None)
    candidates: Any = ("lump", "sheets")
    return Explanation(candidates, refit, -objective)


def test_pairs_are_compared_at_the_materials_that_one_of_them_changes(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def sharpened(e: Explanation, *, leads: bool) -> Explanation:
        assert not leads
        return pair(e.refit.objective - 100.0)

    monkeypatch.setattr(module, "sharpened", sharpened)
    monkeypatch.setattr(module, "explained", lambda r, _: pair(r.objective))
    best, next_best, third = pair(130.0), pair(140.0), pair(150.0)
    rigid, even = pair(110.0, changes=False), pair(120.0, breaks=False)
    found = module._in_own_models([rigid, third, best, even, next_best], {})
    assert [e.log_evidence for e in found] == [-110.0, -150.0, -30.0, -120.0, -40.0]


@pytest.mark.parametrize(("adequacy", "own"), [(1e-9, True), (0.5, False)])
def test_where_the_first_explains_enough_no_pair_gets_a_model(
    monkeypatch: pytest.MonkeyPatch, adequacy: float, own: bool
) -> None:
    seen: list[bool] = []
    monkeypatch.setattr(module, "_in_own_models", lambda pairs, _: seen.append(True) or pairs)
    scan = Scan((signature("ovality", 50.0),), 0.0)
    tried(monkeypatch, first(200.0), scan, (PAIR_GAIN + 1,), adequacy)
    assert bool(seen) == own


def test_a_second_effect_has_to_add_evidence(monkeypatch: pytest.MonkeyPatch) -> None:
    scan = Scan((signature("ovality", 50.0),), 0.0)
    found = tried(monkeypatch, first(200.0), scan, (PAIR_GAIN - 1, PAIR_GAIN + 1, PAIR_GAIN + 9))[2]
    assert [e.log_evidence for e in found] == [-50.0 + PAIR_GAIN + 9, -50.0 + PAIR_GAIN + 1]


def found_beside(
    monkeypatch: pytest.MonkeyPatch,
    *,
    adequacy: float = 0.5,
    over_nothing: float = 60.0,
    left_p: float = 1e-3,
    repeated_p: float = 5e-3,
    confirms: bool = True,
    few: bool = False,
    stable: float = 1.0,
    needed: bool = True,
) -> tuple[int, bool]:
    """How many pairs stand beside a lump, and whether held-out modes confirm them."""
    lump = SimpleNamespace(
        effects=("attached_mass",), adequacy_but_one=adequacy, log_evidence=over_nothing, refit=None
    )
    held = SimpleNamespace(falls=confirms, worsens=False)
    monkeypatch.setattr(module, "nothing", lambda _: SimpleNamespace(log_evidence=0.0))
    monkeypatch.setattr(module, "left_over", lambda *_: SimpleNamespace(p_value=left_p))
    monkeypatch.setattr(
        module,
        "with_repeated_null",
        lambda _, left, __: SimpleNamespace(p_value=max(left.p_value, repeated_p)),
    )
    pair, alone = (SimpleNamespace(refit=None, is_pair=count > 1) for count in (2, 1))
    monkeypatch.setattr(module, "second_effects", lambda *_: [pair])
    monkeypatch.setattr(module, "with_both_needed", lambda pairs, _: pairs if needed else [alone])
    monkeypatch.setattr(module, "unseen_modes", lambda *_: held)
    monkeypatch.setattr(module, "too_few", lambda _: few)
    monkeypatch.setattr(module, "stability", lambda *_: stable)
    base = SimpleNamespace(refit=None, free=None)
    leading: Any = SimpleNamespace(base=base, scan=Scan((), 1e-4))
    pairs, confirmed = module.confirmed_pairs(leading, lump, {}, 0)  # type: ignore[arg-type]
    return len(pairs), confirmed


def test_beside_an_adequate_explanation_a_trace_that_is_no_accident_is_followed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert found_beside(monkeypatch) == (1, True)
    assert found_beside(monkeypatch, left_p=0.2) == (0, True)
    assert found_beside(monkeypatch, repeated_p=0.02) == (0, True)
    # hardly better than nothing: what would a second effect stand beside?
    assert found_beside(monkeypatch, over_nothing=1.0) == (0, True)
    # the first alone is named where modes do not confirm the second, or are too few
    assert found_beside(monkeypatch, confirms=False) == (0, True)
    assert found_beside(monkeypatch, confirms=False, few=True) == (0, True)
    # nor where resampled data are as well explained by it alone
    assert found_beside(monkeypatch, stable=0.75) == (0, True)


def test_an_effect_that_needs_no_other_one_takes_the_place_of_the_pair(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Nothing is asked of a second effect then."""
    assert found_beside(monkeypatch, needed=False, confirms=False, stable=0.0) == (1, True)


def test_what_one_effect_leaves_open_asks_for_a_second(monkeypatch: pytest.MonkeyPatch) -> None:
    assert found_beside(monkeypatch, adequacy=1e-6, left_p=0.2) == (1, True)
    assert found_beside(monkeypatch, adequacy=1e-6, stable=0.75) == (1, True)
    assert found_beside(monkeypatch, adequacy=1e-6, confirms=False) == (0, True)
    # too few modes to confirm it: told, and not named
    assert found_beside(monkeypatch, adequacy=1e-6, confirms=False, few=True) == (1, False)
