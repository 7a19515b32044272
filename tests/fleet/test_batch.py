"""A fleet: the results of single fits, in one table, whoever dies on the way."""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest

import cheap_study
from cheap_fleet import Inline, modulus_ratios, write_fleet, write_machine
from cheap_study import coarse, edit
from statorhom.errors import IdentificationError, ResultsError
from statorhom.fleet.batch import FleetResults, fit_fleet
from statorhom.fleet.local import LocalProcesses
from statorhom.identify.chain import chain
from statorhom.model.basis_store import BasisStore
from statorhom.results.files import read_results
from statorhom.study.study import load_study

COUNT = 4


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Meshes whose accuracy does not matter here."""
    monkeypatch.setattr("statorhom.fleet.batch.Settings", coarse)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> tuple[list[Path], Path]:
    """Studies of a fleet, and the folder in which they have been fitted one after the other."""
    root = tmp_path_factory.mktemp("fleet")
    studies = write_fleet(root / "studies", COUNT)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("statorhom.fleet.batch.Settings", coarse)
        fit_fleet(studies, root / "out", Inline())
    return studies, root / "out"


def machine_results(out: Path) -> dict[str, str]:
    """results.json of every machine without what depends on the clock."""
    found = {}
    for folder in sorted((out / "machines").iterdir()):
        results = read_results(folder)
        stages = tuple(stage.model_copy(update={"seconds": 0.0}) for stage in results.stages)
        found[folder.name] = results.model_copy(update={"stages": stages}).model_dump_json()
    return found


def killer(after: int, killed: list[int]) -> Callable[[str, int], Callable[[int], None]]:
    """Announces to nobody, and kills a working process when so many machines are done."""

    def announce(_what: str, _count: int) -> Callable[[int], None]:
        def progress(done: int) -> None:
            if done == after and not killed:
                pid = multiprocessing.active_children()[0].pid
                assert pid is not None
                os.kill(pid, signal.SIGKILL)
                killed.append(pid)

        return progress

    return announce


def fleet_survives(studies: list[Path], out: Path, reference: Path, after: int) -> FleetResults:
    """Fit with a process killed on the way and hold it against a fit without."""
    killed: list[int] = []
    fleet = fit_fleet(studies, out, LocalProcesses(2), announce=killer(after, killed))
    assert len(killed) == 1
    assert fleet.errors == {}
    assert machine_results(out) == machine_results(reference)
    assert (out / "fleet.csv").read_bytes() == (reference / "fleet.csv").read_bytes()
    return fleet


def test_a_killed_process_changes_nothing(whole: tuple[list[Path], Path], tmp_path: Path) -> None:
    studies, reference = whole
    fleet = fleet_survives(studies, tmp_path / "out", reference, COUNT // 2)
    assert list(fleet.table["study"]) == [f"ring-{i:03}" for i in range(COUNT)]


def test_a_machine_has_the_results_of_its_own_fit(whole: tuple[list[Path], Path], tmp_path: Path) -> None:
    studies, out = whole
    settings = replace(coarse(), shared_bases=True)
    chain(load_study(studies[1]), tmp_path / "machines" / "ring-001", settings).run()
    assert machine_results(tmp_path)["ring-001"] == machine_results(out)["ring-001"]


def test_moduli_scatter_as_they_were_made_to(whole: tuple[list[Path], Path]) -> None:
    table = pd.read_csv(whole[1] / "fleet.csv")
    found, true = table["lamination.E_pa"].to_numpy(), modulus_ratios(COUNT)
    # the prior pulls a little
    assert found / found[0] - 1 == pytest.approx(true / true[0] - 1, rel=0.1)


def test_machines_share_their_bases(whole: tuple[list[Path], Path], tmp_path: Path) -> None:
    """Masses and frequencies scatter, the basis stays: at most one more where a rounded band ends."""
    studies, out = whole
    fit_fleet(studies[:1], tmp_path / "out", Inline())
    single = len(list((tmp_path / "out" / "bases").iterdir()))
    assert single <= len(list((out / "bases").iterdir())) <= 2 * single


def test_later_steps_share_theirs_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever the first step has told of each machine."""
    studies = [cheap_study.write_study(tmp_path / name) for name in ("a", "b")]
    for path, frequency in zip(studies, ("3090", "3060"), strict=True):
        edit(path, 'name = "ring"', f'name = "{path.parent.name}"')
        edit(path.parent / "stack.csv", "3090", frequency)
    built: list[str] = []
    write = BasisStore.write
    monkeypatch.setattr(BasisStore, "write", lambda *a: (built.append(a[1]), write(*a)))
    fit_fleet(studies[:1], tmp_path / "out", Inline())
    first = list(built)
    fleet = fit_fleet(studies, tmp_path / "out", Inline())
    assert first and built == first
    moduli = fleet.table.set_index(["study", "stage"])["lamination.E_pa"]
    assert moduli["a", "framed"] != moduli["b", "framed"]


def test_what_is_done_is_not_done_again(whole: tuple[list[Path], Path]) -> None:
    studies, out = whole
    before = (out / "fleet.csv").read_bytes()
    executor = Inline()
    fleet = fit_fleet(studies, out, executor)
    assert executor.did == []
    assert (out / "fleet.csv").read_bytes() == before
    assert len(fleet.table) == COUNT


def test_an_interrupted_fleet_continues(whole: tuple[list[Path], Path], tmp_path: Path) -> None:
    studies, reference = whole

    def interrupting(_what: str, _count: int) -> Callable[[int], None]:
        def progress(done: int) -> None:
            if done == 2:
                raise KeyboardInterrupt

        return progress

    with pytest.raises(KeyboardInterrupt):
        fit_fleet(studies, tmp_path, Inline(), announce=interrupting)
    assert list(pd.read_csv(tmp_path / "fleet.csv")["state"]) == ["fitted", "fitted", "open", "open"]
    executor = Inline()
    fit_fleet(studies, tmp_path, executor)
    assert [machine.name for machine in executor.did] == ["ring-002", "ring-003"]
    assert (tmp_path / "fleet.csv").read_bytes() == (reference / "fleet.csv").read_bytes()


def test_a_machine_that_cannot_be_fitted_costs_no_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    studies = write_fleet(tmp_path / "studies", 1)
    studies.append(write_machine(tmp_path / "studies" / "bad", "bad", 1.0, 1.0))
    refuse(monkeypatch, IdentificationError("no set of constants\nmeets its modes"))
    fleet = fit_fleet(studies, tmp_path / "out", Inline())
    assert list(fleet.table["state"]) == ["fitted", "failed"]
    assert fleet.errors == {"bad": "no set of constants\nmeets its modes"}
    with pytest.raises(IdentificationError, match=r"^[^\n]*fleet\.csv: \"bad\" has no results: [^\n]*$"):
        fleet.check()


def refuse(monkeypatch: pytest.MonkeyPatch, error: Exception) -> None:
    """Let the fit of the machine "bad" end with an error."""
    run = chain.__globals__["Chain"].run

    def refusing(self, *rest):  # type: ignore[no-untyped-def]
        if self.files.study.name == "bad":
            raise error
        return run(self, *rest)

    monkeypatch.setattr("statorhom.identify.chain.Chain.run", refusing)


def test_a_fault_of_the_program_is_not_hidden(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    studies = write_fleet(tmp_path / "studies", 1)
    studies.insert(0, write_machine(tmp_path / "studies" / "bad", "bad", 1.0, 1.0))
    refuse(monkeypatch, ZeroDivisionError("a figure"))
    with pytest.raises(RuntimeError, match=r"machine 'bad': Traceback[^$]*ZeroDivisionError: a figure"):
        fit_fleet(studies, tmp_path / "out", Inline())
    # only after the others are done
    assert list(pd.read_csv(tmp_path / "out" / "fleet.csv")["state"]) == ["failed", "fitted"]


def test_results_of_another_study_are_not_overwritten(tmp_path: Path) -> None:
    studies = write_fleet(tmp_path / "studies", 1)
    folder = tmp_path / "out" / "machines" / "ring-000"
    folder.mkdir(parents=True)
    (folder / "results.json").write_text("{", encoding="utf-8")
    with pytest.raises(ResultsError, match=r"results\.json: "):
        fit_fleet(studies, tmp_path / "out", Inline())
    edit(folder / "results.json", "{", '{"schema": 1, "study": "other", "seed": 1}')
    with pytest.raises(ResultsError, match="belongs to the study 'other'"):
        fit_fleet(studies, tmp_path / "out", Inline())


@pytest.mark.slow
def test_two_hundred_machines_and_a_killed_process(tmp_path: Path) -> None:
    studies = write_fleet(tmp_path / "studies", 200)
    fit_fleet(studies, tmp_path / "reference", LocalProcesses(2))
    fleet = fleet_survives(studies, tmp_path / "out", tmp_path / "reference", 100)
    assert len(fleet.table) == 200
    assert fleet.table["study"].is_unique
