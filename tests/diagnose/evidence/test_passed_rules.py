"""The rules that are told are those that decide."""

from __future__ import annotations

from dataclasses import replace

import pytest
from example_evidence import FALLS, GOOD, GROUPS
from hypothesis import example, given
from hypothesis import strategies as st

from statorhom.diagnose.evidence.decision import FAR_OVER_NOTHING, Evidence, decide
from statorhom.diagnose.evidence.held_out import HeldOut
from statorhom.diagnose.evidence.passed_rules import rule_rows
from statorhom.results.diagnosis import RuleRow

CHANCES = st.sampled_from([1e-12, 1e-3, 0.009, 0.011, 0.05, 0.3, 0.9])
ERRORS = st.sampled_from([0.02, 0.1, 0.3, 1.0, 3.0])
EVIDENCE = st.builds(
    Evidence,
    p_value=CHANCES,
    unpaired=st.booleans(),
    over_nothing=st.sampled_from([-3.0, 4.0, 6.0, 9.0, 21.0, 60.0]),
    over_others=st.sampled_from([0.5, 2.9, 4.0, 6.0, 50.0, float("inf")]),
    over_discrepancy=st.sampled_from([-1.0, 2.0, 4.0, 6.0, 21.0]),
    held_out=st.none()
    | st.builds(
        lambda n, before, after, noise, lines: HeldOut(
            GROUPS[:n], tuple(before[:n]), tuple(after[:n]), tuple(noise[:n]), of_lines=lines
        ),
        st.integers(0, 6),
        *(st.lists(ERRORS, min_size=6, max_size=6) for _ in range(3)),
        st.booleans(),
    ),
    adequacy=CHANCES,
    chance_of_rows=CHANCES,
    nothing_adequacy=CHANCES,
    nothing_but_one=CHANCES,
    within=st.booleans(),
    stability=st.sampled_from([0.5, 0.79, 0.8, 1.0]),
    confirmed=st.booleans(),
)


def row(evidence: Evidence, rule: str) -> RuleRow:
    return next(r for r in rule_rows(evidence, pair=True) if r.rule == rule)


UNSEEN = HeldOut(GROUPS[:1], (0.02,), (0.02,), (0.02,))  # by which nothing is predicted better or worse
BEYOND_DOUBT = Evidence(1e-12, False, 21.0, 6.0, 21.0, UNSEEN, 0.011, 0.0, 1e-12, 1e-12, True, 0.8)


@example(BEYOND_DOUBT)
@given(EVIDENCE)
def test_what_passes_every_rule_is_named_and_nothing_else(evidence: Evidence) -> None:
    rows = rule_rows(evidence, pair=True)
    # of what is beyond doubt unseen modes that show nothing are asked nothing
    asked = [r for r in rows if not (r.passed is None and r.needed is None and evidence.beyond_doubt)]
    assert (decide(evidence) == "named") == all(r.passed for r in asked)


def test_all_are_passed_where_an_effect_is_named() -> None:
    assert decide(GOOD) == "named"
    assert all(r.passed for r in rule_rows(GOOD, pair=False))


@pytest.mark.parametrize(
    ("change", "rule"),
    [
        ({"p_value": 0.02}, "chance"),
        ({"over_nothing": 4.0}, "nothing"),
        ({"over_others": 2.0}, "others"),
        ({"over_discrepancy": 2.9}, "discrepancy"),
        ({"held_out": replace(FALLS, after=FALLS.before)}, "held_out"),
        ({"adequacy": 1e-3}, "adequacy"),
        ({"within": False}, "within"),
        ({"stability": 0.7}, "stability"),
        ({"confirmed": False}, "confirmed"),
    ],
)
def test_each_rule_is_told_as_the_one_that_failed(change: dict[str, object], rule: str) -> None:
    rows = rule_rows(replace(GOOD, **change), pair=True)
    assert [r.rule for r in rows if not r.passed] == [rule]


def test_more_is_asked_where_the_declared_model_is_adequate_or_few_modes_show_it() -> None:
    assert row(GOOD, "nothing").needed == 5.0
    assert row(replace(GOOD, nothing_adequacy=0.3), "nothing").needed == 8.0
    # one mode is predicted better, but perhaps by chance
    few = HeldOut(GROUPS[:1], (0.3,), (0.2,), (0.15,))
    assert few.improves
    assert not few.falls
    assert row(replace(GOOD, held_out=few), "nothing").needed == 8.0
    assert row(replace(GOOD, held_out=few, chance_of_rows=0.9), "discrepancy").needed == 5.0
    assert row(replace(GOOD, held_out=few), "others").needed == 5.0
    assert row(replace(GOOD, held_out=few, over_others=float("inf")), "nothing").needed == 8.0
    # more is left than right explanations leave
    assert row(replace(GOOD, chance_of_rows=0.45), "discrepancy").needed == pytest.approx(9.2, abs=0.2)
    assert row(replace(GOOD, held_out=few, chance_of_rows=0.15), "discrepancy").needed == FAR_OVER_NOTHING


def test_modes_that_show_nothing_neither_pass_nor_fail() -> None:
    blind = HeldOut(GROUPS, (0.1,) * 6, (0.1,) * 6, (0.1,) * 6)
    assert row(replace(GOOD, held_out=blind), "held_out").passed is None
    assert row(replace(GOOD, held_out=None), "held_out").found is None


def test_of_what_is_beyond_doubt_no_fall_is_asked() -> None:
    """A row that says 10 % of 25 % and passes would be no explanation."""
    few = HeldOut(GROUPS, (0.1, 0.1, 2.0, 0.1, 0.1, 0.1), (0.1, 0.1, 1.8, 0.1, 0.1, 0.1), (0.1,) * 6)
    far = replace(GOOD, held_out=few, over_nothing=35.0, over_discrepancy=35.0)
    found = row(far, "held_out")
    assert found.passed and found.needed == 0.0 < found.found  # type: ignore[operator]
    assert row(far, "nothing").needed == row(far, "discrepancy").needed == FAR_OVER_NOTHING
    noise = row(replace(far, held_out=replace(few, before=(0.05,) * 6, after=(0.08,) * 6)), "held_out")
    assert noise.passed is None and noise.needed is None
    better = replace(few, after=(0.1, 0.1, 0.5, 0.1, 0.1, 0.1))
    assert row(replace(GOOD, held_out=better), "held_out").needed == better.least_fall
