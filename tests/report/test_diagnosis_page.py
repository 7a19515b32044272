"""The diagnosis page of every verdict: what it must say, what it must keep of the identification, what it escapes."""

from __future__ import annotations

import html
import re
import shutil
import sys
from pathlib import Path

import pytest

from statorhom.errors import ResultsError
from statorhom.report import write_report
from statorhom.report.diagnosis.fingerprint_figure import fingerprint_figure, misses
from statorhom.report.diagnosis.page import diagnosis_document
from statorhom.report.diagnosis.words import figure, quantity, sizes_words
from statorhom.report.html import render_html
from statorhom.results import write_results
from statorhom.results.diagnosis import Estimated, FeatureRow, RuleRow, Verdict, write_diagnosis

sys.path.insert(0, str(Path(__file__).resolve().parent))

from example_diagnosis import example_details, example_diagnosis
from example_results import example_results, write_example

VERDICTS: tuple[Verdict, ...] = ("none", "named", "ambiguous", "unknown")
TECHNICAL = (
    "log evidence",
    "posterior",
    "attached_mass",
    "local_stiffness",
    "mass_kg",
    "E_p_pa",
    "nan",
    "None",
)


def words_of(page: str) -> str:
    """What a reader sees, on one line."""
    body = page[page.index("<body>") :]
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]+>", " ", body)))


def titles(page: str) -> list[str]:
    return [html.unescape(t) for t in re.findall(r'<h2><span class="number">\d+</span>([^<]+)', page)]


def page(verdict: Verdict, places: bool = True) -> str:
    return render_html(
        diagnosis_document(example_diagnosis(verdict), example_details(verdict, places=places))
    )


@pytest.mark.parametrize("places", [True, False])
@pytest.mark.parametrize("verdict", VERDICTS)
def test_every_verdict_is_told_in_plain_words(verdict: Verdict, places: bool) -> None:
    shown = page(verdict, places)
    assert titles(shown) == [
        "What the model left out",
        "Where the model fails",
        "What was measured, and what the model says",
        "How sure the diagnosis is",
        "Before and after",
    ]
    said = words_of(shown)
    assert not [word for word in TECHNICAL if word in said]
    # a named effect has its place without maps too
    assert ("unrolled" in said) == ((places and verdict != "none") or verdict == "named")


def test_a_named_effect_has_place_size_and_probability() -> None:
    said = words_of(page("named"))
    assert "mass 57.0 g (90 % interval 53.0 … 62.0)" in said or "mass 57 g (90 % interval 53 … 62)" in said
    assert "at 100° ± 3.3° around the axis (or, equally possible: 280°)" in said
    assert "60 ± 7 mm above the lower end" in said
    assert "probability 97 %" in said
    assert "exclude 280°" in said
    assert "held out: not seen by the fit" in said
    assert re.search(
        r"absorbed by lamination: Young’s modulus .{3,40} \(step stack\) : it changes by \+2.6 %", said
    )


def test_what_to_measure_next_and_what_passed() -> None:
    said = words_of(page("ambiguous"))
    assert "Measure the phase between the two end planes." in said
    assert "This tells attached mass from local stiffness." in said
    assert "the decision would be safe" in said
    unknown = page("unknown")
    assert '<span class="warning">no</span>' in unknown and '<span class="good">yes</span>' in unknown


def test_what_it_may_be_is_told_with_place_and_size() -> None:
    said = words_of(page("ambiguous"))
    assert "Whichever it is, it concerns the back of the core." in said
    assert "not in the model. It would be in step stack, lamination; at 100° ± 3.3° around the axis" in said
    assert (
        "It would be in step stack, lamination; at 95° ± 4.9° around the axis; stiffness ratio 0.70" in said
    )
    assert "at 40° ± 3.3° around the axis; harmonic 2;" in said
    open_part = example_details("ambiguous").model_copy(update={"part": ()})
    assert "Whichever it is" not in words_of(
        render_html(diagnosis_document(example_diagnosis("ambiguous"), open_part))
    )


def test_every_rule_is_told_with_what_it_asked() -> None:
    said = words_of(page("named"))
    assert "Its trace in the data is no accident chance 1 in 4 000 below 1 in 100 yes" in said
    assert "The data prefer it to “nothing” odds over a billion : 1 over 150 : 1 yes" in said
    assert "something else that moves each mode by chance odds over a billion : 1 over 1 : 1 yes" in said
    assert "predicted better error 94 % smaller 25 % smaller yes" in said
    assert (
        "Its size is possible, not at an end of what was searched, and not one that may as well be none yes yes yes"
        in said
    )


def test_of_two_effects_the_second_is_asked_for_by_itself() -> None:
    told = example_diagnosis("ambiguous")
    alone = example_details("ambiguous")
    failed = RuleRow(rule="confirmed", found=None, needed=None, passed=False)
    both = alone.model_copy(update={"rules": (*alone.rules, failed)})
    asked = "… and better with both effects than with one"
    assert asked not in words_of(render_html(diagnosis_document(told, alone)))
    said = words_of(render_html(diagnosis_document(told, both)))
    assert f"{asked} too few modes show it yes no" in said


@pytest.mark.parametrize("verdict", ["named", "ambiguous", "unknown"])
def test_a_declared_model_that_meets_everything_is_not_said_to_fail(verdict: Verdict) -> None:
    """A winding so soft that the mesh is sure of none of its modes meets all of them."""

    def said(chance: float) -> str:
        details = example_details(verdict).model_copy(update={"nothing_adequacy": chance})
        return words_of(render_html(diagnosis_document(example_diagnosis(verdict), details)))

    assert "cannot meet them with any constants" in said(1e-4)
    assert "cannot meet them with any constants" not in said(0.99)
    assert "only with constants that are unlikely" in said(0.99)


def test_results_that_do_not_tell_the_rules_are_still_shown() -> None:
    old = example_details("named").model_copy(update={"rules": ()})
    said = words_of(render_html(diagnosis_document(example_diagnosis("named"), old)))
    assert "How sure the diagnosis is" in said
    assert "passes every one of these tests" not in said


@pytest.mark.parametrize(
    ("kind", "values", "said"),
    [
        ("loss", (-4.471, -4.637, -4.5), "loss factor 0.0114 0.0097 0.0111"),
        ("level", (-0.01, 0.0, -0.009), "frequency above that of the lowest force -1.00 % +0.00 % -0.90 %"),
        (
            "level_loss",
            (0.1, 0.0, 0.09),
            "loss factor above that of the lowest force +10.52 % +0.00 % +9.42 %",
        ),
        ("density", (7680.4, 7640.0, 7681.0), "density of the sheets 7680 kg/m³ 7640 kg/m³ 7681 kg/m³"),
    ],
)
def test_features_are_told_in_units_that_people_use(
    kind: str, values: tuple[float, float, float], said: str
) -> None:
    measured, before, after = values
    row = FeatureRow(
        stage="stack", test="t", mode=(2, 0), kind=kind, measured=measured, before=before, after=after, sd=0.1
    )
    details = example_details("named").model_copy(update={"features": (row,)})
    assert said in words_of(render_html(diagnosis_document(example_diagnosis("named"), details)))


def test_a_lean_is_told_in_percent() -> None:
    lean = FeatureRow(
        stage="stack",
        test="stack-free",
        mode=(2, 0),
        kind="lean",
        measured=0.0291,
        before=0.0,
        after=0.028,
        sd=0.007,
    )
    details = example_details("named").model_copy(update={"features": (lean,)})
    said = words_of(render_html(diagnosis_document(example_diagnosis("named"), details)))
    assert "how far the shape leans to one end +2.91 % +0.00 % +2.80 %" in said


def test_one_report_holds_identification_and_diagnosis(tmp_path: Path) -> None:
    folder = write_example(tmp_path / "both")
    write_report(folder)
    identified = titles((folder / "report.html").read_text(encoding="utf-8"))
    study = example_results().study
    write_diagnosis(example_diagnosis("named", study), example_details("named"), folder)
    write_report(folder)
    both = titles((folder / "report.html").read_text(encoding="utf-8"))
    assert [t for t in both if t in identified] == identified
    assert both[:2] == [identified[0], "What the model left out"]
    assert (folder / "report.pdf").read_bytes().startswith(b"%PDF-")
    alone = tmp_path / "alone"
    alone.mkdir()
    for name in ("diagnosis.json", "diagnosis-details.json"):
        shutil.copy(folder / name, alone)
    write_report(alone)
    assert titles((alone / "report.html").read_text(encoding="utf-8"))[0] == "What the model left out"


def test_results_of_two_studies_are_not_mixed(tmp_path: Path) -> None:
    write_results(example_results(), tmp_path)
    write_diagnosis(example_diagnosis("none", "another"), example_details("none"), tmp_path)
    with pytest.raises(ResultsError, match="move one of them"):
        write_report(tmp_path)


def test_names_from_files_are_escaped() -> None:
    evil = "<script>alert(1)</script> $x_2$ \u202e"
    shown = render_html(
        diagnosis_document(example_diagnosis("named", evil, evil), example_details("named", evil))
    )
    assert "<script" not in shown and "\u202e" not in shown
    assert "&lt;script&gt;" in shown


def test_quantities_in_units_that_people_use() -> None:
    assert quantity("normal_stiffness_n_per_m2", 1.013e10) == "normal stiffness 1.01·10¹⁰ N/m²"
    assert (
        quantity("temperature_k", Estimated(value=20.0, ci90=(15.0, 25.0)))
        == "temperature 20.0 K (90 % interval 15.0 … 25.0)"
    )
    assert quantity("G_rz_pa", 3.7e10).endswith("37.0 GPa")
    assert sizes_words({"input": "mass_kg", "value": 3.055}).startswith("mass_kg should be 3.0")
    assert sizes_words({"input": "mass_kg", "value": 3.055}).endswith("kg")
    assert figure(0.0) == "0.00" and figure(2.5e-7) == "2.50·10⁻⁷"


def test_features_of_one_kind_count_together() -> None:
    common = {
        "stage": "s",
        "test": "t",
        "mode": (2, 0),
        "kind": "split",
        "measured": 0.0,
        "after": 0.0,
        "sd": 1.0,
    }
    (one,) = misses([FeatureRow(before=3.0, **common), FeatureRow(before=4.0, **common)])  # type: ignore[arg-type]
    assert one.before == pytest.approx((12.5) ** 0.5) and one.after == 0.0


def test_what_is_met_before_and_after_takes_no_room() -> None:
    def row(mode: tuple[int, int], kind: str, before: float) -> FeatureRow:
        return FeatureRow(
            stage="s", test="free", mode=mode, kind=kind, measured=0.0, sd=1.0, before=before, after=0.01
        )  # type: ignore[arg-type]

    rows = [row((2, 0), "frequency", 4.0), row((2, 1), "frequency", 0.5), row((2, 0), "loss", 0.02)]
    picture = fingerprint_figure(rows, changed=True)
    assert "Left out: 1 that" in str(picture.caption)
    assert "Left out" not in str(fingerprint_figure(rows[:2], changed=True).caption)
    # where nothing is missed, all is shown
    assert "Left out" not in str(fingerprint_figure(rows[2:], changed=True).caption)
