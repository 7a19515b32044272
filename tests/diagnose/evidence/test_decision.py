"""Each rule alone decides a case that breaks it."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest
from example_evidence import FALLS, GOOD, GROUPS

from statorhom.diagnose.evidence.decision import Evidence, decide, within_bounds
from statorhom.diagnose.evidence.held_out import HeldOut
from statorhom.diagnose.fits.explanations import Explanation
from statorhom.physics.candidate import Candidate
from statorhom.physics.parameter import EffectParameter


def test_all_rules_met_names() -> None:
    assert decide(GOOD) == "named"


@pytest.mark.parametrize(
    ("change", "verdict"),
    [
        ({"p_value": 0.02}, "none"),
        ({"over_nothing": 4.0}, "unknown"),
        ({"over_nothing": 4.0, "nothing_adequacy": 0.3}, "none"),
        ({"over_nothing": 4.0, "nothing_but_one": 0.3}, "none"),
        ({"nothing_but_one": 0.3}, "named"),
        ({"over_others": 2.0}, "ambiguous"),
        ({"over_discrepancy": 2.9}, "unknown"),
        ({"held_out": None}, "ambiguous"),
        ({"held_out": replace(FALLS, after=FALLS.before)}, "unknown"),
        ({"adequacy": 1e-3}, "unknown"),
        ({"within": False}, "unknown"),
        ({"stability": 0.7}, "ambiguous"),
        ({"confirmed": False}, "ambiguous"),
    ],
)
def test_each_rule_fails_alone(change: dict[str, object], verdict: str) -> None:
    assert decide(replace(GOOD, **change)) == verdict


def left(share: float, **change: object) -> Evidence:
    """Evidence before chance of e12, with a share of the error in unseen modes left."""
    unseen = replace(FALLS, after=tuple(share * b for b in FALLS.before))
    return replace(GOOD, **{"over_discrepancy": 12.0, "held_out": unseen, **change})


def test_what_leaves_more_than_right_ones_do_has_to_be_far_ahead_of_a_discrepancy() -> None:
    """Of two tethers that were called a suspension one left a misfit of a chance of 0.15, and led chance by 12."""
    assert decide(left(0.2, chance_of_rows=0.8)) == "named"
    assert decide(left(0.2, chance_of_rows=0.8, over_discrepancy=3.1)) == "named"
    assert decide(left(0.2, chance_of_rows=0.8, over_discrepancy=2.9)) == "unknown"
    assert decide(left(0.2, chance_of_rows=0.15)) == "unknown"
    # in between the more is asked, the more is left: a lump led chance by 5.4 where patches were (57085, 0.25)
    assert decide(left(0.2, chance_of_rows=0.55)) == "named"
    assert decide(left(0.2, chance_of_rows=0.5)) == "unknown"
    # what is far enough ahead is beyond doubt, whatever is left
    assert decide(left(0.2, chance_of_rows=0.15, over_discrepancy=19.9)) == "unknown"
    assert decide(left(0.2, chance_of_rows=0.15, over_discrepancy=20.1)) == "named"
    # rivals that explain it as well are told apart first
    assert decide(left(0.2, chance_of_rows=0.15, over_others=1.0)) == "ambiguous"


def test_what_predicts_unseen_modes_badly_has_to_be_far_ahead_of_a_discrepancy() -> None:
    """Four lumps that were called one (59222) left 0.28 of the unseen modes' error and a misfit of a chance of 0.42."""
    assert decide(left(0.28, chance_of_rows=0.5, over_discrepancy=11.8)) == "unknown"
    # a right one leaves less of it
    assert decide(left(0.15, chance_of_rows=0.5, over_discrepancy=11.8)) == "named"
    # more than half of it counts as half
    assert left(0.7).least_over_discrepancy == left(0.5).least_over_discrepancy
    assert replace(left(0.2), held_out=None).least_over_discrepancy == left(0.5).least_over_discrepancy


def test_one_mode_that_a_fit_without_it_loses_is_not_all_that_is_left() -> None:
    """A strip (55326) predicted all but one of its unseen modes: 12.33 of 12.85 % of the error were that one's."""
    lost = replace(FALLS, before=(*FALLS.before[:5], 30.0), after=(*FALLS.after[:5], 29.0))
    assert lost.after_rms > 0.9 * lost.before_rms
    assert 0.1 < lost.share_left < 0.2
    assert FALLS.share_left == pytest.approx(FALLS.after_rms / FALLS.before_rms)
    assert HeldOut((), (), (), ()).share_left == 1.0


def test_a_fall_by_less_than_a_quarter_is_none() -> None:
    almost = replace(FALLS, after=tuple(0.8 * b for b in FALLS.before))
    assert FALLS.falls
    assert not almost.falls


def test_a_fall_within_the_noise_is_none() -> None:
    noisy = HeldOut(GROUPS, (0.30, 0.20, 0.25, 0.1, 0.3, 0.2), (0.1, 0.15, 0.1, 0.2, 0.05, 0.2), (1.0,) * 6)
    assert not noisy.falls


def test_a_test_that_worsens_is_seen() -> None:
    groups = (*GROUPS[:5], ("other", (2, 0, 0)))
    worse = HeldOut(groups, (*FALLS.before[:5], 0.2), (*FALLS.after[:5], 1.0), (0.1,) * 6)
    assert worse.falls
    assert worse.worsens


FEW = HeldOut(GROUPS, (0.1, 0.1, 2.0, 0.1, 0.1, 0.1), (0.1, 0.1, 2.0, 0.1, 0.1, 0.1), (0.1,) * 6)


def test_too_few_modes_for_held_out_confirm_nothing() -> None:
    unconfirmed = replace(GOOD, held_out=FEW)
    assert decide(unconfirmed) == "ambiguous"
    assert decide(replace(unconfirmed, adequacy=1e-3)) == "unknown"
    # enough modes, and they contradict
    assert decide(replace(unconfirmed, held_out=replace(FALLS, after=FALLS.before))) == "unknown"
    # few modes, and they contradict
    worse = replace(FEW, after=(0.1, 0.1, 9.0, 0.1, 0.1, 0.1))
    assert decide(replace(unconfirmed, held_out=worse)) == "unknown"


def test_one_explanation_alone_is_never_ambiguous() -> None:
    alone = replace(GOOD, over_others=float("inf"))
    assert decide(alone) == "named"
    assert decide(replace(alone, held_out=FEW)) == "unknown"


BETTER = replace(FEW, after=(0.1, 0.1, 0.5, 0.1, 0.1, 0.1))


def test_few_modes_and_evidence_far_ahead_name() -> None:
    seen = replace(GOOD, held_out=replace(BETTER, noise=(0.9,) * 6))
    assert not seen.predicts
    assert decide(seen) == "named"
    assert decide(replace(seen, over_others=4.9)) == "ambiguous"
    # a roving sensor that moves one mode alone, and nothing else that explains anything
    alone = replace(seen, over_others=float("inf"))
    assert decide(alone) == "named"
    assert decide(replace(seen, over_nothing=7.9)) == "ambiguous"
    # something in no library has to be as far behind as a rival
    assert decide(replace(seen, over_discrepancy=4.9)) == "ambiguous"
    # which of several effects it is takes more evidence than whether the only one is there
    assert decide(replace(alone, over_nothing=9.0)) == "named"
    assert decide(replace(alone, over_nothing=7.9)) == "unknown"


def test_what_few_modes_show_and_nothing_contradicts_is_named_where_all_else_is_far_behind() -> None:
    """Of a wrong length unseen modes tell little: the modulus makes up for it in them too."""
    little = replace(FEW, after=(0.1, 0.1, 1.8, 0.1, 0.1, 0.1))
    far = replace(GOOD, held_out=little, over_nothing=35.0, over_discrepancy=35.0)
    assert not little.improves
    assert decide(far) == "named"
    assert decide(replace(far, over_nothing=19.0)) == "ambiguous"
    assert decide(replace(far, over_others=4.9)) == "ambiguous"
    # something in no library is as strong
    assert decide(replace(far, over_discrepancy=19.0)) == "ambiguous"
    assert decide(replace(far, held_out=FEW)) == "ambiguous"


def test_errors_within_the_noise_contradict_nothing_whichever_is_the_smaller() -> None:
    """A winding that follows the frequency: the declared one is as good in unseen modes, with impossible constants."""
    noise = HeldOut(GROUPS, (0.1,) * 6, (0.15,) * 6, (0.2,) * 6)
    far = replace(GOOD, held_out=noise, over_nothing=35.0, over_discrepancy=35.0)
    assert decide(far) == "named"
    assert decide(replace(far, over_nothing=19.0)) == "ambiguous"
    assert decide(replace(far, over_others=4.9)) == "ambiguous"
    assert decide(replace(far, held_out=replace(noise, after=(0.25,) * 6))) == "ambiguous"


def test_lines_beside_their_mates_name_where_rivals_are_behind() -> None:
    lines = replace(GOOD, held_out=replace(FALLS, of_lines=True))
    assert not lines.predicts
    assert decide(lines) == "named"
    assert decide(replace(lines, over_others=4.0)) == "named"
    assert decide(replace(lines, over_others=2.9)) == "ambiguous"
    assert decide(replace(lines, over_nothing=15.0)) == "named"
    assert decide(replace(lines, over_nothing=4.0, nothing_adequacy=1e-3)) != "named"
    worse = replace(FALLS, of_lines=True, after=FALLS.before)
    assert decide(replace(lines, held_out=worse)) == "ambiguous"


def test_an_adequate_declared_model_wants_more_evidence() -> None:
    adequate = replace(GOOD, nothing_adequacy=0.4, over_nothing=7.0)
    assert decide(adequate) == "none"
    assert decide(replace(adequate, over_nothing=9.0)) == "named"


@pytest.mark.parametrize(
    ("value", "within"), [(3.111, False), (3.14, False), (3.0, True), (3.2, True), (9.41, False)]
)
def test_a_dimension_within_its_tolerance_was_not_mistyped(value: float, within: bool) -> None:
    typed = 3.14
    width = EffectParameter("value", 2.5, 4.0, typed / 3, 3 * typed, "log", (3.2,), typed, negligible=0.05)
    candidate = Candidate("wrong_input", "stack", (width,))
    hypothesis: Any = SimpleNamespace(effect_values=lambda _: [{"value": value}])
    refit: Any = SimpleNamespace(hypothesis=hypothesis, z=None)
    assert within_bounds(Explanation((candidate,), refit, 0.0)) is within


def test_many_modes_without_a_partner_are_no_accident_whatever_the_scan_says() -> None:
    assert decide(replace(GOOD, p_value=0.7, unpaired=True)) == "named"
    assert decide(replace(GOOD, p_value=0.7, unpaired=True, over_nothing=1.0)) == "unknown"
