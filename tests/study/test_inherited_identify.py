"""Constants prescribed at a step that is only weighed."""

from __future__ import annotations

from typing import Any

from statorhom.study.inherited_identify import with_inherited_identify
from statorhom.study.study_file import StudyFile

TEST = {"name": "free", "support": "free", "modal_table": "free.csv"}


def study(last: str, *, tested: bool = False, own: dict[str, Any] | None = None) -> StudyFile:
    """A stack, a wound step with a prescribed winding, and a last tested step."""
    stack = {
        "name": "stack",
        "kind": "stack",
        "mass_kg": 3.0,
        "model": {"lamination": "isotropic"},
        "identify": {"fixed": {"lamination": {"nu": 0.3}}},
        "tests": [TEST] if tested else [],
    }
    wound = {
        "name": "wound",
        "kind": "wound",
        "mass_kg": 4.0,
        "model": {"winding": "isotropic"},
        "identify": {"fixed": {"winding": {"nu": 0.25}}},
    }
    end = {"name": last, "kind": last, "mass_kg": 5.0, "tests": [TEST | {"name": "end"}]}
    end["model"] = {"framed": {"frame": "isotropic"}}.get(last, {"winding": "isotropic"})
    if own is not None:
        end["identify"] = own
    return StudyFile.model_validate(
        {"schema": 1, "name": "s", "geometry": "g.toml", "stages": [stack, wound, end]}
    )


def test_what_untested_steps_say_counts_at_the_next_test() -> None:
    keys = with_inherited_identify(study("framed", own={"fixed": {"frame": {"nu": 0.33}}}), 2).identify
    assert keys.fixed == {"lamination": {"nu": 0.3}, "winding": {"nu": 0.25}, "frame": {"nu": 0.33}}


def test_a_dry_winding_says_nothing_of_an_impregnated_one() -> None:
    keys = with_inherited_identify(study("impregnated"), 2).identify
    assert keys.fixed == {"lamination": {"nu": 0.3}}


def test_a_tested_step_keeps_its_word_for_itself() -> None:
    keys = with_inherited_identify(study("framed", tested=True), 2).identify
    assert keys.fixed == {"winding": {"nu": 0.25}}


def test_an_untested_step_inherits_nothing() -> None:
    keys = with_inherited_identify(study("framed"), 1).identify
    assert keys.fixed == {"winding": {"nu": 0.25}}
