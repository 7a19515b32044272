"""The commands: what they write, print and leave with."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from cheap_fleet import Inline, write_fleet
from cheap_study import coarse, edit, write_study
from command import statorhom
from statorhom.fleet.executor import Lost
from statorhom.identify.fits.stage_run import Announce
from statorhom.results.files import read_results

PROGRAM = [sys.executable, "-c", "from statorhom.cli import main; main()"]


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Meshes whose accuracy does not matter here."""
    monkeypatch.setattr("statorhom.api.Settings", coarse)
    monkeypatch.setattr("statorhom.simulate.Settings", coarse)


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A study that has been run, in a folder with its results in `out`."""
    root = tmp_path_factory.mktemp("done")
    study = write_study(root)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("statorhom.api.Settings", coarse)
        outcome = statorhom("run", study, "--out", root / "out")
    assert outcome.code == 0
    (root / "run.txt").write_text(outcome.stdout + outcome.stderr, encoding="utf-8")
    return root


def test_run_writes_results_and_report(done: Path) -> None:
    out = done / "out"
    assert {path.name for path in out.iterdir()} == {
        "results.json",
        "report.html",
        "report.pdf",
        "shapes",
        "bases",
    }
    printed = (done / "run.txt").read_text(encoding="utf-8")
    assert str(out / "report.html") in printed
    # a table row of every constant, in engineers' units
    for stage in read_results(out).stages:
        for region, material in stage.regions.items():
            for name, constant in material.engineering.items():
                assert f"{region}" in printed and name in printed and constant.status in printed
    assert "GPa" in printed


def test_json_is_the_whole_of_standard_output(done: Path) -> None:
    outcome = statorhom("run", done / "study.toml", "--out", done / "out", "--json")
    assert outcome.code == 0
    assert outcome.stderr == ""
    printed = json.loads(outcome.stdout)
    assert printed == json.loads((done / "out" / "results.json").read_text())
    assert printed["schema"] == 1
    assert printed["stages"][0]["regions"]["lamination"]["symmetry"] == "isotropic"


def test_fit_of_one_stage_as_json(done: Path) -> None:
    outcome = statorhom("fit", done / "study.toml", "--out", done / "out", "--stage", "stack", "--json")
    assert outcome.code == 0
    assert [stage["name"] for stage in json.loads(outcome.stdout)["stages"]] == ["stack"]
    assert len(read_results(done / "out").stages) == 2


def test_report_is_written_again_the_same(done: Path) -> None:
    out = done / "out"
    page = (out / "report.html").read_bytes()
    (out / "report.html").unlink()
    outcome = statorhom("report", out)
    assert outcome.code == 0
    assert outcome.stdout.split() == ["wrote", str(out / "report.html"), "wrote", str(out / "report.pdf")]
    assert (out / "report.html").read_bytes() == page


def test_results_go_beside_the_study_by_default(tmp_path: Path) -> None:
    study = write_study(tmp_path)
    assert statorhom("fit", study, "--stage", "stack").code == 0
    assert [stage.name for stage in read_results(tmp_path / "ring-results").stages] == ["stack"]


def test_seed_is_that_of_the_results(tmp_path: Path) -> None:
    study = write_study(tmp_path)
    assert statorhom("fit", study, "--stage", "stack", "--seed", 7).code == 0
    assert read_results(tmp_path / "ring-results").seed == 7


def test_interruption_keeps_what_is_done(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    study = write_study(tmp_path)
    out = tmp_path / "out"

    @contextmanager
    def interrupted(quiet: bool = False) -> Iterator[Announce]:  # noqa: ARG001
        def announce(_what: str, _count: int):  # type: ignore[no-untyped-def]
            if (out / "results.json").exists():
                raise KeyboardInterrupt
            return lambda _done: None

        yield announce

    monkeypatch.setattr("statorhom.cli.progress_bars", interrupted)
    outcome = statorhom("run", study, "--out", out)
    assert outcome.code == 130
    assert outcome.stdout == ""
    assert outcome.stderr.splitlines() == [
        "statorhom: interrupted; the steps that are done stay in the results folder"
    ]
    assert [stage.name for stage in read_results(out).stages] == ["stack"]
    assert not (out / "report.html").exists()


@pytest.fixture
def fleet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """Studies of a fleet; no process is started to fit them."""
    monkeypatch.setattr("statorhom.fleet.batch.Settings", coarse)
    monkeypatch.setattr("statorhom.fleet.local.LocalProcesses", lambda _jobs: Inline())
    return write_fleet(tmp_path / "studies", 2)


def test_batch_writes_one_table_of_all_machines(fleet: list[Path], tmp_path: Path) -> None:
    outcome = statorhom("batch", *fleet, "--out", tmp_path / "out")
    assert outcome.code == 0
    assert "lamination.E_pa" in outcome.stdout and "GPa" in outcome.stdout and "2 machines" in outcome.stdout
    table = tmp_path / "out" / "fleet.csv"
    assert f"wrote {table}" in outcome.stderr.splitlines()
    assert [line.split(",")[0] for line in table.read_text().splitlines()] == [
        "study",
        "ring-000",
        "ring-001",
    ]
    printed = json.loads(statorhom("batch", *fleet, "--out", tmp_path / "out", "--json").stdout)
    assert [row["study"] for row in printed] == ["ring-000", "ring-001"]


def test_a_batch_that_is_not_whole_ends_with_one_line(fleet: list[Path], tmp_path: Path) -> None:
    def lost(_self: object, _function: object, tasks: list[object]) -> Iterator[tuple[int, Lost]]:
        yield from ((i, Lost("its worker died")) for i in range(len(tasks)))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Inline, "run", lost)
        outcome = statorhom("batch", *fleet, "--out", tmp_path / "out", "--json")
    assert outcome.code == 2
    assert [row["state"] for row in json.loads(outcome.stdout)] == ["failed", "failed"]
    assert len(outcome.stderr.splitlines()) == 1
    assert '"ring-000" (and 1 more) has no results: its worker died' in outcome.stderr


def test_a_faulty_batch_is_refused_in_one_line(fleet: list[Path], tmp_path: Path) -> None:
    for words in (
        [],
        [tmp_path / "gone.toml"],
        [fleet[0], fleet[0]],
        [fleet[0], "--scheduler", "ftp://nowhere"],
    ):
        outcome = statorhom("batch", *words, "--out", tmp_path / "out")
        assert outcome.code == 2
        assert len(outcome.stderr.splitlines()) == 1
    assert not (tmp_path / "out" / "machines").exists()


@pytest.mark.slow
def test_ctrl_c_ends_a_batch_and_leaves_what_is_done(tmp_path: Path) -> None:
    studies = write_fleet(tmp_path / "studies", 40)
    out = tmp_path / "out"
    process = subprocess.Popen(
        [*PROGRAM, "batch", *studies, "--out", out, "--jobs", "2"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    try:
        deadline = time.monotonic() + 300
        while len(list(out.glob("machines/*/results.json"))) < 3 and time.monotonic() < deadline:
            time.sleep(0.1)
        # as a terminal does it: to the workers too
        os.killpg(process.pid, signal.SIGINT)
        text, error = process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == 130
    assert text == "" and len(error.splitlines()) == 1 and "interrupted" in error
    states = [line.split(",")[2] for line in (out / "fleet.csv").read_text().splitlines()[1:]]
    assert len(states) == 40 and set(states) == {"fitted", "open"}


@pytest.mark.slow
def test_ctrl_c_ends_processes_and_program(tmp_path: Path) -> None:
    """The signal itself, at whatever the program is doing: annealing replaces the handler on its way."""
    study = write_study(tmp_path)
    edit(study, "evaluations = 60", "evaluations = 1000000", 1)
    process = subprocess.Popen(
        [*PROGRAM, "fit", study, "--out", tmp_path / "out", "--jobs", "2"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # a shell lets what it runs in the background ignore the signal
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    try:
        deadline = time.monotonic() + 120
        while not (tmp_path / "out" / "results.json").exists() and time.monotonic() < deadline:
            time.sleep(0.1)
        time.sleep(1.0)
        process.send_signal(signal.SIGINT)
        out, error = process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == 130
    assert out == "" and len(error.splitlines()) == 1 and "interrupted" in error
    assert [stage.name for stage in read_results(tmp_path / "out").stages] == ["stack"]


def test_help_names_every_command() -> None:
    outcome = statorhom("--help")
    assert outcome.code == 0
    for command in ("init", "simulate", "fit", "run", "batch", "report"):
        assert command in outcome.stdout


def test_no_command_is_a_usage_error_with_the_help() -> None:
    outcome = statorhom()
    assert outcome.code == 2
    assert "Usage" in outcome.stdout
    assert outcome.stderr == "statorhom: no command given; see statorhom --help\n"


def test_an_own_fault_is_not_hidden(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """What is no fault of the user's must not look like one."""

    def broken(_path: Path) -> None:
        raise ZeroDivisionError

    monkeypatch.setattr("statorhom.api.load_study", broken)
    with pytest.raises(ZeroDivisionError):
        statorhom("fit", tmp_path / "study.toml")


def test_init_writes_a_study_that_can_be_fitted(tmp_path: Path) -> None:
    folder = tmp_path / "new"
    outcome = statorhom("init", folder)
    assert outcome.code == 0
    written = [folder / name for name in ("geometry.toml", "study.toml", "stack-free.csv")]
    assert outcome.stdout.splitlines() == [f"wrote {path}" for path in written]
    study = folder / "study.toml"
    edit(study, "[[stages.tests]]", "[stages.identify]\nevaluations = 60\nchains = 1\n[[stages.tests]]")
    assert statorhom("fit", study).code == 0
    (stack,) = read_results(folder / "my-study-results").stages
    assert stack.regions["lamination"].symmetry == "transversely_isotropic"
    assert all(mode.role == "fitted" for mode in stage_modes(stack))


def stage_modes(stage):  # type: ignore[no-untyped-def]
    return [mode for mode in stage.modes if mode.measured_hz is not None]


def test_init_overwrites_nothing(tmp_path: Path) -> None:
    (tmp_path / "stack-free.csv").write_text("mine", encoding="utf-8")
    outcome = statorhom("init", tmp_path)
    assert outcome.code == 2
    assert outcome.stderr.count("\n") == 1 and "stack-free.csv: exists already" in outcome.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["stack-free.csv"]
    assert (tmp_path / "stack-free.csv").read_text(encoding="utf-8") == "mine"


def test_the_package_runs_as_a_module() -> None:
    called = [sys.executable, "-m", "statorhom", "--help"]
    shown = subprocess.run(called, capture_output=True, text=True, check=True).stdout
    assert "diagnose" in shown
