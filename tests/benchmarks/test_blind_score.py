"""The blind benchmark's list, and how it scores answers whose worth is known."""

from __future__ import annotations

from collections import Counter

import blind_work
import numpy as np
import pytest
from blind_baselines import METHODS, comparison, held_out_ratios, simpler_answers
from blind_cases import blind_cases
from blind_kept import kept_rows, refused, write_refused
from blind_machines import machine, study
from blind_report import markdown, write_report
from blind_score import angle_error_deg, compared, interval, magnitude_error, median_interval, summary

from statorhom.conceal.library import NONE, library
from statorhom.errors import MaterialError
from statorhom.geometry.stator import stator_geometry
from statorhom.study.geometry_file import GeometryFile
from statorhom.study.study_file import StudyFile

LUMP = {
    "effect": "attached_mass",
    "location": {"angle_deg": 350.0, "z_mm": 20.0},
    "parameters": {"mass_kg": 0.05},
}


def answer(verdict: str = "named", **effect) -> dict:
    stated = {
        "effect": "attached_mass",
        "location": {"angle_deg": 4.0, "angle_ambiguity_deg": [4.0, 184.0]},
        "parameters": {"mass_kg": {"value": 0.045, "ci90": [0.04, 0.051]}},
    }
    fit = {"held_out": {"what": "-", "before_rms_percent": 1.0, "after_rms_percent": 0.2}}
    return {"verdict": verdict, "effects": [stated | effect] if verdict == "named" else [], "fit": fit}


def test_the_list_is_long_and_every_beginning_is_mixed() -> None:
    cases = blind_cases()
    groups = Counter(case.group for case in cases)
    assert len(cases) >= 360
    assert groups["nothing"] >= 80
    assert groups["outside"] >= 60
    assert blind_cases(40) == cases[:40]
    # none of the eighth series' machines has as few slots as the benchmark's smallest
    assert len(blind_cases(series=8)) == len(cases)
    assert len(Counter(case.group for case in cases[:20])) == 5
    assert {name for case in cases for name in case.effects} == {NONE, *library()}


def test_machines_differ_and_can_be_built(tmp_path) -> None:
    files = [GeometryFile.model_validate(machine(number)) for number in range(8)]
    assert len({file.slots.count for file in files}) > 3
    for file in files:
        stator_geometry(file, tmp_path)


@pytest.mark.parametrize("template", sorted({case.template for case in blind_cases()}))
def test_templates_are_studies(template: str) -> None:
    assert StudyFile.model_validate(study(template, seed=3)).stages[0].tests


def test_a_right_answer() -> None:
    row = compared({"verdict": "named", "effects": [LUMP]}, answer())
    assert row["effect_right"]
    assert row["class_right"]
    assert row["angle_error_deg"] == pytest.approx(14.0)
    assert row["magnitude_error"] == pytest.approx(0.1)
    assert row["covered"]
    assert row["held_out_ratio"] == pytest.approx(0.2)


def test_the_right_class_alone_is_not_the_right_effect() -> None:
    row = compared({"verdict": "named", "effects": [LUMP]}, answer(effect="local_stiffness"))
    assert (row["effect_right"], row["class_right"]) == (False, True)
    assert "magnitude_error" not in row


def test_an_ambiguous_answer_may_be_sure_of_the_class() -> None:
    lump = {"verdict": "named", "effects": [LUMP]}
    row = compared(lump, answer("ambiguous"), ["the back of the core"])
    assert (row["effect_right"], row["class_named"], row["class_right"]) == (False, False, True)
    assert not compared(lump, answer("ambiguous"), ["the winding"])["class_right"]
    assert not compared(lump, answer("ambiguous"), ["the back of the core", "the winding"])["class_right"]
    assert not compared(lump, answer("ambiguous"))["class_right"]


def test_silence_is_right_where_nothing_is_missing() -> None:
    nothing = {"verdict": "none", "effects": []}
    assert compared(nothing, answer("none"))["verdict_right"]
    assert not compared(nothing, answer())["verdict_right"]


def test_an_oval_yoke_repeats_itself() -> None:
    true = {"location": {"angle_deg": 80.0}, "parameters": {"harmonic": 4}}
    assert angle_error_deg(true, {"location": {"angle_deg": 353.0}}) == pytest.approx(3.0)


def test_a_wrong_input_of_another_key_has_no_magnitude() -> None:
    true = {"effect": "wrong_input", "parameters": {"input": "mass_kg", "value": 3.05}}
    said = {"parameters": {"input": "length_mm", "value": {"value": 80.0}}}
    assert magnitude_error(true, said) is None


def test_figures_count_what_they_say() -> None:
    base = {"data": "table", "snr": 9.0, "seconds": 1.0, "truth": "x", "template": "stack"}
    rows = [
        base
        | {
            "group": "single",
            "verdict": "named",
            "best": "x",
            "effect": "x",
            "effect_right": True,
            "class_right": True,
            "class_named": True,
        },
        base | {"group": "single", "verdict": "failed", "fault": "no answer"},
        base
        | {
            "group": "single",
            "verdict": "ambiguous",
            "best": "x",
            "effect": "x",
            "named": "",
            "class_right": True,
        },
        base | {"group": "single", "verdict": "unknown", "best": "y", "effect": "x", "named": ""},
        base
        | {"group": "single", "verdict": "none", "snr": 1.0, "effect_right": False, "class_right": False},
        base | {"group": "nothing", "verdict": "named", "named": "ovality"},
        base | {"group": "nothing", "verdict": "none", "verdict_right": True},
    ]
    figures = summary(rows)
    assert figures["effect right, snr >= 4"] == 0.25
    assert figures["class right, snr >= 4"] == 0.5
    assert figures["class right by name, snr >= 4"] == 0.25
    assert figures["right effect leads, snr >= 4, whatever the verdict"] == 0.5
    assert figures["named on nothing missing"] == 0.5
    assert np.isnan(figures["named outside the library"])
    assert "| false name | x (nothing, table) | ovality | 1 |" in markdown(rows, 5)


def test_simpler_methods_answer_by_one_number() -> None:
    details = {
        "nothing_adequacy": 1e-4,
        "maps": [{"regions": {"lamination": [[0.2]], "winding": [[0.5], [0.3]]}, "error": 0.1}],
        "simpler": {"by_criterion": [{"effect": "ovality", "label": "ovality (stack)", "gain": 30.0}]},
    }
    assert simpler_answers(details) == {
        "refit of E alone": "",
        "refit of all constants": "",
        "error map alone": "end_winding_stiffness",
        "BIC without projection": "ovality",
    }
    quiet = {"nothing_adequacy": 0.5, "simpler": {"by_criterion": [{"effect": "ovality", "gain": -1.0}]}}
    assert set(simpler_answers(details | quiet).values()) == {""}


def test_held_out_errors_are_measured_against_the_refit_of_all_constants() -> None:
    simpler = {"modulus_alone_held_out_percent": 3.0, "all_constants_held_out_percent": 1.5}
    found = held_out_ratios({"simpler": simpler}, answer())
    assert found == {
        "refit of E alone": 2.0,
        "refit of all constants": 1.0,
        "diagnose": pytest.approx(0.2),
    }
    assert "diagnose" not in held_out_ratios({"simpler": simpler}, answer("none"))


def test_methods_are_compared_on_the_same_cases() -> None:
    answers = {"diagnose": "x", "refit of E alone": "", "refit of all constants": ""}
    answers |= {"error map alone": "y", "BIC without projection": "x"}
    rows = [
        {"group": "single", "snr": 9.0, "effect": "x", "answers": answers},
        {"group": "single", "snr": 9.0, "verdict": "failed"},
        {"group": "nothing", "snr": 1.0, "effect": "", "answers": answers},
    ]
    found = comparison(rows, 4.0)
    assert [found[m]["effect right"] for m in ("diagnose", "error map alone")] == [(1, 2), (0, 2)]
    assert found["refit of all constants"]["named on nothing"] == (0, 1)


def test_intervals_of_shares_and_medians() -> None:
    assert interval(0, 10) == (0.0, pytest.approx(0.3085, abs=1e-4))
    assert interval(9, 10) == pytest.approx((0.5550, 0.9975), abs=1e-4)
    assert median_interval(range(1, 21)) == (6.0, 15.0)
    assert median_interval([3.0]) == (3.0, 3.0)


def test_the_report_says_how_many_cases_at_which_commit(tmp_path) -> None:
    row = {"case": "c", "group": "nothing", "data": "FRF", "snr": 0.0, "seconds": 1.0, "truth": "none"}
    rows = [row | {"verdict": "none", "verdict_right": True, "commit": "abc", "template": "stack"}]
    assert write_report(rows, tmp_path, 12).startswith("1 of 12 cases, diagnosed at commit abc (1).")
    assert (tmp_path / "blind.png").stat().st_size > 0


def test_rows_of_earlier_runs_give_the_same_report(tmp_path) -> None:
    common = {
        "group": "single",
        "data": "table",
        "template": "stack",
        "seconds": 2.0,
        "snr": 9.0,
        "fault": "",
    }
    named = common | compared({"verdict": "named", "effects": [LUMP]}, answer()) | {"effect": LUMP["effect"]}
    named |= {"answers": dict.fromkeys(METHODS, "") | {"diagnose": "attached_mass"}}
    named |= {"held_out": {"refit of all constants": 1.0, "diagnose": 0.2}}
    rows = [
        named | {"case": "case-0001", "truth": "attached_mass", "commit": "0012345"},
        common
        | {"case": "case-0002", "truth": "ovality", "commit": "12e5", "verdict": "failed", "fault": "late"},
    ]
    first = write_report(rows, tmp_path, 2)
    kept = kept_rows(tmp_path)
    assert list(kept) == ["case-0001", "case-0002"]
    assert kept["case-0001"]["held_out"] == named["held_out"]
    assert [row["commit"] for row in kept.values()] == ["0012345", "12e5"]
    assert write_report(list(kept.values()), tmp_path, 2) == first


def test_what_cannot_be_concealed_is_known_to_later_runs(tmp_path, monkeypatch: pytest.MonkeyPatch) -> None:
    tried = []

    def fails(*_: object, **__: object) -> None:
        tried.append(1)
        raise MaterialError("no such material")

    monkeypatch.setattr(blind_work, "conceal_study", fails)
    work, case = blind_work.Work(tmp_path / "work"), blind_cases(1)[0]
    assert blind_work.make(work, case) == blind_work.make(work, case) == f"{case.name}: no such material"
    assert len(tried) == 1
    write_refused(work.refusals(), tmp_path)
    write_refused(["case-9999: too thin"], tmp_path)
    assert refused(tmp_path) == {case.name, "case-9999"}
    assert refused(tmp_path / "elsewhere") == frozenset()


def test_without_a_table_nothing_is_kept(tmp_path) -> None:
    assert kept_rows(tmp_path) == {}
