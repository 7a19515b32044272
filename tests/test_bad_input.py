"""Whatever is wrong with what the user typed: one line that says where and what to do, and nothing is touched."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from cheap_study import append, coarse, edit, write_study
from command import statorhom
from statorhom.identify.chain import chain
from statorhom.results.files import write_results
from statorhom.results.schema import Results, StageResult
from statorhom.study.study import load_study

Spoil = Callable[[Path], None]

# (what the study's folder suffers, what the message names)
FAULTS: dict[str, tuple[Spoil, list[str]]] = {
    "unknown key": (
        lambda f: edit(f / "study.toml", "mass_kg", "mass_kgs"),
        ["study.toml: stages[stack]: ", 'unknown key "mass_kgs"', 'did you mean "mass_kg"?'],
    ),
    "missing column": (
        lambda f: write(f / "stack.csv", "order,axial\n2,0\n"),
        ["stack.csv: ", "frequency_hz", "add"],
    ),
    "unknown column": (
        lambda f: edit(f / "stack.csv", "frequency_hz", "frequenzy_hz"),
        ["stack.csv: line 1: ", '"frequenzy_hz"', "frequency_hz"],
    ),
    "NaN in a table": (
        lambda f: edit(f / "stack.csv", "3090", "nan"),
        ["stack.csv: line 2, column frequency_hz: ", '"nan" is not a number', "type a number"],
    ),
    "NaN in the study": (
        lambda f: edit(f / "study.toml", "2.313", "nan"),
        ["study.toml: stages[stack].mass_kg: ", "finite", "type the number"],
    ),
    "negative mass": (
        lambda f: edit(f / "study.toml", "2.313", "-2.313"),
        ["study.toml: stages[stack].mass_kg: ", "-2.313", "correct the number"],
    ),
    "frequencies in kHz": (
        lambda f: write(f / "stack.csv", "frequency_hz,order,axial\n3.09,2,0\n4.59,2,1\n"),
        ["stack.csv: column frequency_hz: ", "kHz", "multiply the column by 1000"],
    ),
    "duplicate modes": (
        lambda f: write(f / "stack.csv", "frequency_hz,order,axial\n3090,2,0\n3090,2,0\n"),
        ["stack.csv: rows 1 and 2: ", "duplicate mode", "delete one"],
    ),
    "a recording that does not exist": (
        lambda f: edit(f / "study.toml", 'modal_table = "framed.csv"', 'frf = "framed.uff"'),
        ["study.toml: stages[framed].tests[framed-free].frf: ", "framed.uff", "correct the path"],
    ),
    "hits that do not exist": (
        lambda f: edit(f / "study.toml", 'modal_table = "framed.csv"', 'hits = ["hit-1.csv"]'),
        ["study.toml: stages[framed].tests[framed-free].hits: ", "hit-1.csv", "correct the path"],
    ),
    "a recording that holds nothing": (
        lambda f: (
            write(f / "framed.uff", "    -1\n"),
            edit(f / "study.toml", 'modal_table = "framed.csv"', 'frf = "framed.uff"'),
        )[-1],
        ["framed.uff: "],
    ),
    "a table that does not exist": (
        lambda f: (f / "framed.csv").unlink(),
        ["study.toml: stages[framed].tests[framed-free].modal_table: ", "framed.csv", "correct the path"],
    ),
    "no geometry file": (
        lambda f: (f / "ring.toml").unlink(),
        ["study.toml: geometry: ", "ring.toml", "correct the path"],
    ),
    "a step that loses mass": (
        lambda f: edit(f / "study.toml", "2.565", "2.165"),
        ["study.toml: mass_kg: ", "2.165 kg after 'framed'", "2.313 kg after 'stack'", "0.148 kg", "correct"],
    ),
    "a step that adds no mass": (
        lambda f: edit(f / "study.toml", "2.565", "2.313"),
        ["study.toml: mass_kg: ", "2.313 kg after 'framed'", "region frame", "correct"],
    ),
    "a step without tests and dimensions that loses mass": (
        lambda f: append(f / "study.toml", '[[stages]]\nname = "done"\nkind = "machine"\nmass_kg = 2.5\n'),
        ["study.toml: mass_kg: ", "2.5 kg after 'done'", "2.565 kg after 'framed'", "0.065 kg", "correct"],
    ),
    "a bore wider than the core": (
        lambda f: edit(f / "ring.toml", "bore_diameter_mm = 90.0", "bore_diameter_mm = 130.0"),
        ["ring.toml: ", "core.bore_diameter_mm = 130", "smaller than core.outer_diameter_mm = 120"],
    ),
    "a frame smaller than the core": (
        lambda f: edit(f / "ring.toml", "inner_diameter_mm = 120.0", "inner_diameter_mm = 110.0"),
        ["ring.toml: ", "frame.inner_diameter_mm = 110", "core.outer_diameter_mm = 120"],
    ),
    "nothing left to fit": (
        lambda f: append(f / "study.toml", "hold_out = [1, 2]\n"),
        ["study.toml: stages[framed]: ", "no mode is left to fit", "not held out"],
    ),
    "too few evaluations": (
        lambda f: edit(f / "study.toml", "evaluations = 60", "evaluations = 10", 1),
        ["study.toml: stages[framed].identify.evaluations: ", "10", "at least 50"],
    ),
    "no [frame] for a framed test": (
        lambda f: write(f / "ring.toml", (f / "ring.toml").read_text().split("[frame]")[0]),
        ["study.toml: stages[framed]: ", "[frame]", "add"],
    ),
    "an empty study": (lambda f: write(f / "study.toml", ""), ["study.toml: ", "schema", "add this key"]),
    "a study that is no text": (
        lambda f: (f / "study.toml").write_bytes(b"\xff\xfe\x00") and None,
        ["study.toml: ", "UTF-8", "save the file"],
    ),
}


def write(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8")


def results_of_before(folder: Path) -> dict[Path, bytes]:
    """A results folder with everything a run leaves behind; contents by path."""
    write_results(
        Results(schema=1, study="ring", seed=1, stages=()),
        folder,
    )
    for name in ("report.html", "report.pdf", "modes.csv", "shapes/1-stack.npz"):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_bytes(b"as it was")
    return contents(folder)


def contents(folder: Path) -> dict[Path, bytes]:
    return {path: path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def refused(*arguments: object) -> str:
    """The one line that a refused command writes."""
    outcome = statorhom(*arguments)
    assert outcome.code == 2
    assert outcome.stdout == ""
    lines = outcome.stderr.splitlines()
    assert len(lines) == 1 and outcome.stderr.endswith("\n"), outcome.stderr
    assert "Traceback" not in lines[0]
    return lines[0]


@pytest.mark.parametrize("command", ["fit", "run", "simulate"])
@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_of_the_files_is_one_line_and_touches_nothing(
    fault: str, command: str, tmp_path: Path
) -> None:
    if command == "simulate" and fault in SIMULATED_ALL_THE_SAME:
        pytest.skip("simulation does not need what is missing")
    study = write_study(tmp_path)
    spoil, fragments = FAULTS[fault]
    before = results_of_before(tmp_path / "out")
    spoil(tmp_path)
    line = refused(command, study, "--out", tmp_path / "out")
    for fragment in fragments:
        assert fragment in line
    assert contents(tmp_path / "out") == before


SIMULATED_ALL_THE_SAME = {
    "a recording that holds nothing",
    "nothing left to fit",
    "too few evaluations",
}


@pytest.mark.parametrize("fault", ["unknown key", "no geometry file"])
def test_the_program_itself_leaves_with_2_and_one_line(fault: str, tmp_path: Path) -> None:
    study = write_study(tmp_path)
    spoil, fragments = FAULTS[fault]
    spoil(tmp_path)
    program = [sys.executable, "-c", "from statorhom.cli import main; main()"]
    done = subprocess.run([*program, "fit", study], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stdout == ""
    assert len(done.stderr.splitlines()) == 1
    for fragment in fragments:
        assert fragment in done.stderr
    assert not (tmp_path / "ring-results").exists()


@pytest.mark.parametrize(
    ("arguments", "fragments"),
    [
        (["--stage", "wound"], ["study.toml", "no stage 'wound'", "stack, framed"]),
        (["--frobnicate"], ["--frobnicate", "statorhom --help"]),
        (["--jobs", "-1"], ["--jobs", "statorhom --help"]),
        (["--jobs", "two"], ["--jobs", "statorhom --help"]),
        (["--seed", "-1"], ["--seed", "statorhom --help"]),
    ],
)
def test_a_fault_of_the_command_is_one_line(
    arguments: list[str], fragments: list[str], tmp_path: Path
) -> None:
    study = write_study(tmp_path)
    before = results_of_before(tmp_path / "out")
    line = refused("fit", study, "--out", tmp_path / "out", *arguments)
    for fragment in fragments:
        assert fragment in line
    assert contents(tmp_path / "out") == before


def test_an_unknown_stage_is_not_simulated(tmp_path: Path) -> None:
    study = write_study(tmp_path)
    line = refused("simulate", study, "--stage", "wound")
    assert "no stage 'wound'" in line and "stack, framed" in line
    assert not (tmp_path / "ring-results").exists()


def test_a_stage_without_tests_has_nothing_to_simulate(tmp_path: Path) -> None:
    study = write_study(tmp_path)
    append(study, '[[stages]]\nname = "done"\nkind = "machine"\nmass_kg = 3.0\n')
    assert "'done' has no tests" in refused("simulate", study, "--stage", "done")


@pytest.mark.parametrize(
    ("command", "fragment"),
    [(["frob"], "frob"), (["fit"], "STUDY"), (["report"], "DIR"), (["init"], "DIR")],
)
def test_a_wrong_command_is_one_line(command: list[str], fragment: str) -> None:
    assert fragment in refused(*command)


@pytest.mark.parametrize("command", ["fit", "run", "simulate"])
def test_a_study_that_is_a_folder_or_missing(command: str, tmp_path: Path) -> None:
    assert "is a folder; name the file in it" in refused(command, tmp_path)
    line = refused(command, tmp_path / "gone.toml")
    assert "gone.toml: there is no such file; correct the path" in line


@pytest.mark.parametrize("command", ["fit", "run", "simulate"])
def test_results_cannot_go_into_a_file(command: str, tmp_path: Path) -> None:
    study = write_study(tmp_path)
    line = refused(command, study, "--out", tmp_path / "ring.toml")
    assert "ring.toml: is a file; name a folder" in line
    line = refused(command, study, "--out", tmp_path / "ring.toml" / "out")
    assert "cannot be made (Not a directory); name another folder" in line


@pytest.mark.parametrize("command", ["fit", "run", "simulate"])
def test_results_of_another_study_stay(command: str, tmp_path: Path) -> None:
    study = write_study(tmp_path)
    before = results_of_before(tmp_path / "out")
    edit(study, 'name = "ring"', 'name = "other"')
    line = refused(command, study, "--out", tmp_path / "out")
    assert "results.json: belongs to the study 'ring', not to 'other'; choose another --out" in line
    assert contents(tmp_path / "out") == before


DAMAGED = {
    "cut": '{"schema": 1, "study": "ring", "se',
    "of another kind": '{"schema": 2, "study": "ring", "seed": 1}',
    "empty": "",
    "no text": "\x00\x01",
    "hostile": '{"schema": 1, "study": "ring", "seed": 1, "stages": [{"na\\nme": "x"}]}',
}


@pytest.mark.parametrize("damage", DAMAGED)
@pytest.mark.parametrize("command", ["fit", "run", "simulate", "report"])
def test_damaged_results_stay_for_the_user_to_look_at(damage: str, command: str, tmp_path: Path) -> None:
    study = write_study(tmp_path)
    results_of_before(tmp_path / "out")
    write(tmp_path / "out" / "results.json", DAMAGED[damage])
    before = contents(tmp_path / "out")
    place = [tmp_path / "out"] if command == "report" else [study, "--out", tmp_path / "out"]
    line = refused(command, *place)
    assert "results.json: " in line and "delete the file and run the study again" in line
    assert contents(tmp_path / "out") == before


def test_a_folder_without_results_has_no_report(tmp_path: Path) -> None:
    line = refused("report", tmp_path)
    assert "results.json: there is no such file; run `statorhom run STUDY --out" in line


def test_a_fault_of_a_later_step_shows_before_the_first_is_fitted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fitted(*_: object) -> StageResult:
        raise AssertionError("a step was fitted")

    monkeypatch.setattr("statorhom.identify.chain.run_stage", fitted)
    study = write_study(tmp_path)
    with pytest.raises(AssertionError, match="a step was fitted"):
        chain(load_study(study), tmp_path / "out", coarse()).run()
    edit(study, "2.565", "2.165")
    assert "a loss of 0.148 kg" in refused("fit", study, "--out", tmp_path / "out")
