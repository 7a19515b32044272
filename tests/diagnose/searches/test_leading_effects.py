"""A declared model in the wrong valley, and what was found beside it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.searches import declared_again as again
from statorhom.diagnose.searches import leading_effects as leading
from statorhom.diagnose.searches.leading_effects import leading_effects


def base(log_evidence: float, objective: float = 1000.0, constants: int = 2) -> Any:
    hypothesis = SimpleNamespace(constants=constants)
    fit = SimpleNamespace(
        log_evidence=log_evidence,
        objective=objective,
        cost=objective,
        hypothesis=hypothesis,
        z=[0.0] * constants,
    )
    return SimpleNamespace(free=fit, refit=fit, valleys=())


def explanation(label: str, log_evidence: float, adequacy: float = 0.0) -> Any:
    return SimpleNamespace(
        candidates=(SimpleNamespace(label=label),),
        label=label,
        log_evidence=log_evidence,
        adequacy_but_one=adequacy,
    )


def led(
    monkeypatch: pytest.MonkeyPatch,
    p_value: float,
    *steps: tuple[Any, list[Any]],
    again: Sequence[Any] = (),
    typical: Callable[..., list[Any]] = lambda *_: [],
    thorough: Callable[..., list[Any]] = lambda *_: [],
) -> Any:
    """What leads where the declared model is first one, then another; `again`: refits of one candidate there."""
    bases = [b for b, _ in steps]
    monkeypatch.setattr(leading, "lacks_modes", lambda _: False)
    monkeypatch.setattr(
        leading,
        "scan",
        lambda fit, *_: SimpleNamespace(
            p_value=1e-4 if fit is bases[0].free else p_value,
            signatures=[SimpleNamespace(candidate=SimpleNamespace(label=e.label), gain=9.0) for e in again],
        ),
    )
    monkeypatch.setattr(leading, "starts_of", lambda _, __, signature: signature.candidate.label)
    monkeypatch.setattr(
        leading, "refits", lambda _, trials, __: [e for e in again if (9.0, e.label) in trials]
    )
    monkeypatch.setattr(leading, "beside_typical_materials", typical)
    monkeypatch.setattr(leading, "sought_thoroughly", thorough)
    monkeypatch.setattr(leading, "leaning_fields", lambda *_: [])
    monkeypatch.setattr(leading, "in_other_valleys", lambda _, found, __: found)
    monkeypatch.setattr(leading, "with_repeated_null", lambda _, found, __: found)
    monkeypatch.setattr(leading, "single_effects", lambda fit, *_: next(e for b, e in steps if b.free is fit))
    monkeypatch.setattr(leading, "new_names", lambda *_: [])
    monkeypatch.setattr(leading, "renames_alone", lambda _: False)
    approach: Any = SimpleNamespace(
        declared_again=lambda now, _: next(iter(bases[bases.index(now) + 1 :]), None)
    )
    return leading_effects(approach, bases[0], [], {}, 1)


def test_one_valley_is_judged_by_its_scan(monkeypatch: pytest.MonkeyPatch) -> None:
    lump = explanation("lump", -50.0)
    found = led(monkeypatch, 0.5, (base(-700.0), [lump]))
    assert found.found == (lump,)
    assert found.misfit_is_real
    assert found.chance(lump) == 1e-4


def test_what_was_found_beside_another_valley_is_judged_by_its_evidence(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    soft, loose = explanation("soft", -53.0), explanation("loose", -103.5)
    deeper = base(-99.7)
    found = led(monkeypatch, 0.5, (base(-700.0), [soft, loose]), (deeper, []))
    assert found.base is deeper
    assert [e.log_evidence for e in found.found] == [-53.0, -103.5]
    assert found.misfit_is_real
    assert found.chance(soft) < 1e-15
    # what is no better than the deeper valley needs no physics
    assert found.chance(found.found[1]) == 0.5


def test_a_contact_lost_beside_another_winding_is_judged_by_its_evidence(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    weaker, arc, lump = explanation("arc", -60.0), explanation("arc", -40.0), explanation("lump", -50.0)
    monkeypatch.setattr(leading, "with_lost_contact", lambda *_: [arc])
    found = led(monkeypatch, 0.5, (base(-700.0), [lump, weaker]))
    assert found.found == (arc, lump)
    assert found.chance(arc) < 1e-15
    assert found.chance(lump) == 1e-4


@pytest.mark.parametrize("moved", [False, True])
def test_typical_materials_are_asked_again_where_the_declared_model_has_moved(
    monkeypatch: pytest.MonkeyPatch, moved: bool
) -> None:
    """It may have fled there: of a soft end winding nothing was left then, and nothing was sought."""
    soft, asked = explanation("soft", -60.0), []

    def typical(fit: Any, *_: Any) -> list[Any]:
        asked.append(fit.log_evidence)
        return [soft] if fit.log_evidence == -70.0 else []

    steps = [(base(-300.0), [explanation("slow", -200.0)]), *([(base(-70.0), [])] if moved else [])]
    found = led(monkeypatch, 0.5, *steps, typical=typical)
    assert asked == ([-300.0, -70.0] if moved else [-300.0])
    assert (soft in found.found) is moved
    if moved:
        assert found.chance(soft) == pytest.approx(np.exp(-10.0))


@pytest.mark.parametrize("more", [False, True])
def test_what_typical_materials_find_then_may_lead_to_a_still_deeper_valley(
    monkeypatch: pytest.MonkeyPatch, more: bool
) -> None:
    """A clean chain's declared model stayed at -255 where effects that may as well be absent stood at -198."""

    def typical(fit: Any, *_: Any) -> list[Any]:
        return [explanation("slow", -198.0)] if more and fit.log_evidence == -255.0 else []

    steps = [(base(left), [explanation("lump", left - 1.0)]) for left in (-330.0, -270.0, -255.0, -199.0)]
    found = led(monkeypatch, 0.5, *steps, typical=typical)
    assert found.base.free.log_evidence == (-199.0 if more else -255.0)


def test_what_the_lead_is_taken_for_is_sought_behind_it(monkeypatch: pytest.MonkeyPatch) -> None:
    soft, slow = explanation("soft", -40.0), explanation("slow", -50.0)
    asked: list[Any] = []

    def alike(_: Any, found: Any, *__: Any) -> list[Any]:
        asked.append(found)
        return [soft]

    monkeypatch.setattr(leading, "look_alikes", alike)
    found = led(monkeypatch, 0.5, (base(-700.0), [slow]))
    assert asked == [(slow,)]
    assert found.found == (soft, slow)
    assert found.elsewhere == {"soft"}


def test_what_typical_materials_lead_to_is_judged_by_its_evidence(monkeypatch: pytest.MonkeyPatch) -> None:
    """Beside a winding a tenth as stiff no signature gains, so that the scan finds nothing."""
    soft, loose = explanation("soft", -52.0), explanation("loose", -90.0)
    asked: list[Any] = []

    def typical(fit: Any, found: Any, *_: Any) -> list[Any]:
        asked.append((fit, found))
        return [soft, explanation("lump", -110.0)]

    declared = base(-138.0)
    lump = explanation("lump", -100.0)
    found = led(monkeypatch, 1e-4, (declared, [loose, lump]), typical=typical)
    assert found.found == (soft, loose, lump)
    assert asked == [(declared.free, (loose, lump))]  # what they beat
    assert found.elsewhere == {"soft"}


def test_a_deeper_valley_may_leave_nothing_to_explain(monkeypatch: pytest.MonkeyPatch) -> None:
    found = led(monkeypatch, 0.5, (base(-700.0), [explanation("loose", -100.0)]), (base(-99.0), []))
    assert not found.misfit_is_real
    assert found.chance(found.found[0]) == 0.5


def test_what_leaves_nothing_needs_no_rivals_from_another_valley(monkeypatch: pytest.MonkeyPatch) -> None:
    soft = explanation("soft", -53.0, 0.5)
    found = led(monkeypatch, 1e-4, (base(-700.0), [soft]), (base(-99.7), [explanation("loose", -90.0)]))
    assert found.found == (soft,)


def test_what_needs_no_rivals_is_itself_sought_again_in_the_deeper_valley(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The same effect may explain as much with other constants, and then with another magnitude."""
    soft, better = explanation("soft", -53.0, 0.5), explanation("soft", -40.0)
    loose = explanation("loose", -30.0)
    steps = (base(-700.0), [soft]), (base(-99.7), [explanation("lump", -20.0)])
    assert led(monkeypatch, 1e-4, *steps, again=[better, loose]).found == (better,)


def test_what_only_stood_in_for_the_deeper_valley_has_rivals_there(monkeypatch: pytest.MonkeyPatch) -> None:
    """A wrong bore at -77 led to a declared model at -65, beside which a suspension at -20 was not looked for."""
    bore, suspension = explanation("bore", -77.0, 0.5), explanation("suspension", -20.0, 0.5)
    found = led(monkeypatch, 1e-4, (base(-142.0), [bore]), (base(-65.0), [suspension]))
    assert found.found == (suspension, bore)


def sought_again(
    monkeypatch: pytest.MonkeyPatch, without_effect: float, adequacy: float = 0.0, doubt: float = 0.0
) -> Any:
    """The declared model from an explanation's constants, whose refit without the effect ends at an objective."""
    monkeypatch.setattr(again, "blank", lambda hypothesis, _: hypothesis)
    monkeypatch.setattr(
        again,
        "refitted",
        lambda h, z: SimpleNamespace(
            objective=without_effect, cost=without_effect + 2 * doubt, hypothesis=h, z=z
        ),
    )
    monkeypatch.setattr(again, "nothing", lambda refit: SimpleNamespace(refit=refit))
    monkeypatch.setattr(again, "sharpened", lambda e: e)
    monkeypatch.setattr(again, "shown_by_magnitudes", lambda _: [True])
    fit = SimpleNamespace(hypothesis=SimpleNamespace(study=None, constants=2), z=[1.0, 2.0, 3.0], cost=30.0)
    found: Any = [SimpleNamespace(refit=fit, adequacy_but_one=adequacy, candidates=(None,))]
    monkeypatch.setattr(
        again,
        "baseline_at",
        lambda _, z, valleys: SimpleNamespace(**vars(base(0.0, without_effect)), z=z, kept=valleys),
    )
    return again.declared_again(base(-700.0, 1000.0), found)


def test_constants_that_explain_more_without_the_effect_are_the_declared_models(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    deeper = sought_again(monkeypatch, 100.0)
    assert deeper.z == [1.0, 2.0]  # the effect's own coordinate is left out
    assert deeper.kept == ([0.0, 0.0],)  # where it was is a valley still


def test_the_declared_model_stays_where_an_explanation_needs_its_effect(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert sought_again(monkeypatch, 990.0) is None


def test_a_valley_that_says_nothing_is_no_deeper_one(monkeypatch: pytest.MonkeyPatch) -> None:
    assert sought_again(monkeypatch, 960.0) is not None
    assert sought_again(monkeypatch, 960.0, doubt=15.0) is None


def test_an_explanation_that_is_beyond_doubt_asks_for_no_other_valley(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert sought_again(monkeypatch, 500.0, 0.5) is None
    assert sought_again(monkeypatch, 100.0, 0.5) is not None


@pytest.mark.parametrize(
    ("p_value", "unpaired", "by_chance"), [(0.5, False, True), (1e-4, False, False), (0.5, True, False)]
)
def test_where_the_misfit_is_chance_nothing_is_sharpened(
    p_value: float, unpaired: bool, by_chance: bool
) -> None:
    lump = explanation("lump", -50.0)
    lump.effects = ("attached_mass",)
    lump.candidates[0].parameters = (1,)
    now: Any = leading.Leading(base(-700.0), SimpleNamespace(p_value=p_value), unpaired, (lump,))  # type: ignore[arg-type]
    assert now.by_chance(lump) is by_chance


def test_what_a_thorough_search_leads_to_is_judged_by_its_evidence(monkeypatch: pytest.MonkeyPatch) -> None:
    soft, lump = explanation("soft", -13.0, 0.9), explanation("lump", -33.0)
    declared = base(-60.0)

    def thorough(fit: Any, found: Any, *_: Any) -> list[Any]:
        assert fit is declared.free and list(found) == [lump]
        return [soft]

    found = led(monkeypatch, 0.5, (declared, [lump]), thorough=thorough)
    assert found.found == (soft, lump)
    assert found.chance(soft) == pytest.approx(np.exp(-47.0))
