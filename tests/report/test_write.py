"""The whole report: what it must contain, and what it must never do with names from files."""

import html
import json
import re
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import typst
from markupsafe import escape

from statorhom.errors import ResultsError
from statorhom.report import write_report
from statorhom.results import Results, read_results, write_results

sys.path.insert(0, str(Path(__file__).resolve().parent))

from example_results import example_results, write_example


def words_of(page: str) -> str:
    """What a reader of the page sees, on one line."""
    body = page[page.index("<body>") :]
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]+>", " ", body)))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = write_example(tmp_path_factory.mktemp("results"))
    write_report(folder)
    return folder


@pytest.fixture(scope="module")
def page(folder: Path) -> str:
    return (folder / "report.html").read_text(encoding="utf-8")


def test_both_files_stand_in_the_folder(folder: Path) -> None:
    assert (folder / "report.pdf").read_bytes().startswith(b"%PDF-")
    assert sorted(p.name for p in folder.iterdir()) == ["report.html", "report.pdf", "results.json", "shapes"]


def test_sections_stand_in_the_order_in_which_a_reader_asks(page: str) -> None:
    titles = [html.unescape(t) for t in re.findall(r'<h2><span class="number">\d+</span>([^<]+)', page)]
    assert titles == [
        "In short",
        "Masses and densities",
        "Materials",
        "Measured and simulated modes",
        "Mode shapes",
        "Order spectra",
        "Mesh and its error",
        "Sensitivity: what the modes can tell",
        "Damping",
        "What was assumed",
        "Words used",
    ]


@pytest.mark.parametrize(
    "statement",
    [
        "four could be determined by the measurements",
        "stack (lamination stack). Weight 3.080 kg; density: lamination 7810 ± 13 kg/m³.",
        "191.5 GPa (187.7 … 195.3 GPa)",
        "Not determined, with what remains possible: lamination E z = ",
        "Two measured modes found no simulated partner.",
        "2076 kg/m³ lies below every usual frame material",
        "uncertain pair",
        "Predicted: held out or not used in the fit",
        "Measured without a simulated partner",
        "Simulated without a measured partner",
        "The shapes of this step were not stored.",
        "No modes were measured after: framed.",
        "No elastic constants were determined in: framed.",
        "Hooke’s matrix of the lamination",
        "2 distinct optima of the fit",
        "As found in the step before: lamination.",
        "Even (2, 0) , which depends on it most, changes by only 0.019 %",
        "The clamp “clamped” is rigid on two axial lines.",
        "71 388 DOF",
        "would have given lamination E p = 187.3 GPa instead of 191.5 GPa",
        "stack, wound: Every region is homogeneous.",
        "Seed 1",
    ],
)
def test_what_was_found_is_said(statement: str, page: str) -> None:
    assert statement.replace(" ,", ",") in words_of(page).replace(" ,", ",")


def test_page_needs_nothing_else(page: str) -> None:
    assert not re.search(r"<(script|link|iframe|object)\b", page)
    assert not re.search(r'(src|href)="(?!data:|#)', page)
    assert "url(" not in page
    assert page.count("<img") > 20


def test_every_picture_has_words_for_who_cannot_see_it(page: str) -> None:
    assert all(re.search(r'alt="[^"]{5,}"', tag) for tag in re.findall(r"<img[^>]*>", page))


def test_same_results_give_the_same_bytes(folder: Path) -> None:
    before = [(folder / name).read_bytes() for name in ("report.html", "report.pdf")]
    write_report(folder)
    assert [(folder / name).read_bytes() for name in ("report.html", "report.pdf")] == before


def test_a_report_is_made_in_seconds(folder: Path) -> None:
    start = time.process_time()
    write_report(folder)
    # about 3 s on an idle core; a core shared with other work counts several times that
    assert time.process_time() - start < 20.0


HOSTILE = [
    "<script>alert(1)</script>",
    '#read("/etc/passwd")',
    "{{ 7 * 7 }} {% raw %}",
    '$x^2$ \\frac{1}{2} #image("a.png") *strong* @label <label> `raw`',
    "back\\slash \"quoted\" 'single' & ]]> </title></style>",
    "line\nbreak \u202eevil \x07 日本語",
    "n" * 300,
]


@pytest.mark.parametrize("name", HOSTILE)
def test_names_are_shown_as_they_are(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_results(named(example_results(), name), tmp_path)
    headings = headings_of_pdf(monkeypatch)
    write_report(tmp_path)
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    visible = "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in name)
    assert page.count(str(escape(visible))) > 10
    assert "<script" not in page
    assert "\u202e" not in page
    assert f"Step {visible}, test {visible}" in headings


def named(results: Results, name: str) -> Results:
    """The first two steps with every name that a user chooses set to `name`."""
    stages = []
    for stage in results.stages[:2]:
        modes = tuple(m.model_copy(update={"test": name, "label": name, "kind": name}) for m in stage.modes)
        regions = {f"{name}{i}": region for i, region in enumerate(stage.regions.values())}
        more = {"name": name, "modes": modes, "regions": regions, "warnings": (name,), "assumptions": (name,)}
        if stage.sensitivity is not None:
            table = stage.sensitivity
            more["sensitivity"] = table.model_copy(
                update={
                    "modes": (name,) * len(table.modes),
                    "constants": (f"{name}.E_pa",) * len(table.constants),
                }
            )
        stages.append(stage.model_copy(update=more))
    geometry = {name: name}
    return results.model_copy(
        update={"study": name, "program": name, "stages": tuple(stages), "geometry": geometry}
    )


def headings_of_pdf(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Filled, when a PDF is made, with the headings that typst sets, as the text elements it understood."""
    found: list[str] = []
    compile_pdf: Callable[..., bytes] = typst.compile

    def watched(source: str, **options: Any) -> bytes:
        headings = json.loads(typst.query(source, "heading", **options))
        found.extend(literal(heading["body"]).replace("\u200b", "") for heading in headings)
        return compile_pdf(source, **options)

    monkeypatch.setattr(typst, "compile", watched)
    return found


def literal(content: dict[str, Any]) -> str:
    """The letters of typst content that is text and nothing else."""
    if content["func"] == "space":
        return " "
    if content["func"] == "sequence":
        return "".join(literal(part) for part in content["children"])
    assert content["func"] == "text", content
    return str(content["text"])


def test_missing_results(tmp_path: Path) -> None:
    with pytest.raises(ResultsError, match=r"results\.json"):
        write_report(tmp_path)


def test_a_damaged_shape_file_leaves_the_old_report(folder: Path, tmp_path: Path) -> None:
    write_results(read_results(folder), tmp_path)
    (tmp_path / "shapes").mkdir()
    (tmp_path / "shapes" / "stack.npz").write_bytes(b"damaged")
    (tmp_path / "report.html").write_text("old")
    with pytest.raises(ResultsError, match=r"stack\.npz: the file is damaged"):
        write_report(tmp_path)
    assert (tmp_path / "report.html").read_text() == "old"
    assert not (tmp_path / "report.pdf").exists()


@pytest.mark.parametrize("path", ["../outside.npz", "/etc/passwd", "shapes/../../outside.npz"])
def test_shape_files_outside_the_folder_are_not_opened(path: str, tmp_path: Path) -> None:
    results = example_results()
    stage = results.stages[0].model_copy(update={"shapes": path})
    write_results(results.model_copy(update={"stages": (stage,)}), tmp_path / "results")
    with pytest.raises(ResultsError, match="not a file of the results folder"):
        write_report(tmp_path / "results")


def test_a_study_without_any_step_has_a_report(tmp_path: Path) -> None:
    write_results(Results(study="new", seed=3), tmp_path)
    page = write_report(tmp_path)[0].read_text(encoding="utf-8")
    assert "No fabrication step has been fitted yet" in page


def test_figures_that_no_run_can_have_written(tmp_path: Path) -> None:
    results = example_results()
    stage = results.stages[0].model_copy(update={"mass_kg": float("inf")})
    path = write_results(results.model_copy(update={"stages": (stage,)}), tmp_path)
    path.write_text(path.read_text().replace('"mass_kg": null', '"mass_kg": Infinity'))
    with pytest.raises(ResultsError, match=r"results\.json: stages\.0\.mass_kg"):
        write_report(tmp_path)
