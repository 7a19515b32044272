"""A fleet is refused, in one line and before anything is fitted, where it is none."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from cheap_fleet import Inline, write_fleet
from cheap_study import coarse, edit
from ring_recording import write_recording
from statorhom.errors import GeometryError, IdentificationError, InputFileError, StatorhomError
from statorhom.fleet.executor import Lost
from statorhom.fleet.load import Recorded, extract_recordings, load_fleet
from statorhom.fleet.local import LocalProcesses
from statorhom.study.study import load_study


@pytest.fixture
def studies(tmp_path: Path) -> list[Path]:
    return write_fleet(tmp_path / "studies", 3)


def refused(studies: list[Path], kind: type[StatorhomError], *words: str) -> str:
    """The message of the refusal, which is one line and holds the words in their order."""
    out = studies[0].parents[1] / "out" if studies else Path("out")
    with pytest.raises(kind) as caught:
        load_fleet(studies, out, coarse(), Inline())
    message = str(caught.value)
    assert "\n" not in message
    assert re.search(".*".join(map(re.escape, words)), message), message
    assert not out.exists()
    return message


def test_machines_keep_their_order_and_share_their_bases(studies: list[Path], tmp_path: Path) -> None:
    machines = load_fleet(studies, tmp_path / "out", coarse(), Inline())
    assert [machine.name for machine in machines] == ["ring-000", "ring-001", "ring-002"]
    assert {machine.bases for machine in machines} == {tmp_path / "out" / "bases"}
    assert len({machine.folder for machine in machines}) == 3


def test_no_study() -> None:
    refused([], InputFileError, "name one study file per machine")


def test_a_missing_study(studies: list[Path], tmp_path: Path) -> None:
    refused([*studies, tmp_path / "gone.toml"], InputFileError, "gone.toml", "there is no such file")


def test_a_faulty_study(studies: list[Path]) -> None:
    edit(studies[2], "mass_kg", "mas_kg")
    refused(studies, InputFileError, str(studies[2]), 'unknown key "mas_kg"')


def test_what_no_fit_can_start_from(studies: list[Path]) -> None:
    edit(studies[1], "evaluations = 60", "evaluations = 6")
    refused(studies, InputFileError, str(studies[1]), "evaluations", "too few")


def test_an_impossible_machine(studies: list[Path]) -> None:
    edit(studies[0].parents[1] / "ring.toml", "bore_diameter_mm = 90.0", "bore_diameter_mm = 130.0")
    refused(studies, GeometryError, "bore_diameter_mm")


def test_two_machines_of_one_name(studies: list[Path]) -> None:
    edit(studies[2], "ring-002", "RING-000")
    refused(studies, InputFileError, str(studies[2]), str(studies[0]), "its own name")


def test_one_machine_twice(studies: list[Path]) -> None:
    refused([*studies, studies[1].parent / ".." / "001" / "study.toml"], InputFileError, "given twice")


def test_other_dimensions_under_the_same_name(studies: list[Path]) -> None:
    folder = studies[0].parents[1]
    shutil.copy(folder / "ring.toml", folder / "other.toml")
    edit(folder / "other.toml", "length_mm = 60.0", "length_mm = 60.5")
    edit(studies[1], "ring.toml", "other.toml")
    refused(studies, InputFileError, "other.toml", "ring.toml", "dimensions differ")


def test_the_name_of_a_geometry_is_no_dimension(studies: list[Path], tmp_path: Path) -> None:
    folder = studies[0].parents[1]
    shutil.copy(folder / "ring.toml", folder / "other.toml")
    edit(folder / "other.toml", 'name = "ring"', 'name = "the ring, revised"')
    edit(studies[1], "ring.toml", "other.toml")
    assert len(load_fleet(studies, tmp_path / "out", coarse(), Inline())) == 3


def test_other_steps(studies: list[Path]) -> None:
    edit(studies[2], 'name = "stack"', 'name = "core"')
    refused(studies, InputFileError, str(studies[2]), str(studies[0]), "stages differ")


def test_other_symmetries(studies: list[Path]) -> None:
    edit(studies[2], 'lamination = "isotropic"', 'lamination = "orthotropic"')
    edit(studies[2], "[stages.identify.fixed.lamination]\nnu = 0.3\n", "")
    refused(studies, InputFileError, str(studies[2]), str(studies[0]), "stages.model differs")


def test_a_supported_test_cannot_be_fitted(studies: list[Path]) -> None:
    edit(studies[1], 'support = "free"', 'support = "clamped"\nrole = "fit"')
    text = studies[1].read_text(encoding="utf-8")
    table = (
        '[[supports]]\nname = "clamped"\nkind = "lines"\ndeclared = "rigid"\nangles_deg = [0.0]\n\n[[stages]]'
    )
    studies[1].write_text(text.replace("[[stages]]", table, 1), encoding="utf-8")
    refused(studies, IdentificationError, str(studies[1]), 'role = "predict"')


def with_recordings(studies: list[Path]) -> None:
    """Each machine gets a recording instead of its table."""
    write_recording(studies[0].parent / "stack.uff")
    for path in studies:
        if path != studies[0]:
            shutil.copy(studies[0].parent / "stack.uff", path.parent)
        edit(path, 'modal_table = "stack.csv"', 'frf = "stack.uff"')


def test_the_executor_extracts_recordings(studies: list[Path], tmp_path: Path) -> None:
    with_recordings(studies)
    executor = Inline()
    machines = load_fleet(studies, tmp_path / "out", coarse(), executor)
    assert [type(task) for task in executor.did] == [Recorded] * 3
    assert [task.folder for task in executor.did] == [machine.folder for machine in machines]
    for machine in machines:
        assert len(machine.files.tables["stack-free"].modes) == 2
        assert (machine.folder / "recordings" / "stack-free.csv").exists()
    # what is kept is not extracted a second time, and a process does as this one did
    before = {m.name: (m.folder / "recordings" / "stack-free.npz").stat().st_mtime_ns for m in machines}
    again = load_fleet(studies, tmp_path / "out", coarse(), LocalProcesses(2))
    assert before == {m.name: (m.folder / "recordings" / "stack-free.npz").stat().st_mtime_ns for m in again}


def test_a_worker_that_is_lost_while_it_extracts_costs_nothing(studies: list[Path], tmp_path: Path) -> None:
    class Losing:
        def run(self, _function, tasks):
            yield from ((i, Lost("gone")) for i in range(len(tasks)))

    with_recordings(studies)
    machines = load_fleet(studies, tmp_path / "out", coarse(), Losing())
    assert all(len(machine.files.tables["stack-free"].modes) == 2 for machine in machines)


def test_a_recording_without_modes_is_refused_whoever_extracts_it(
    studies: list[Path], tmp_path: Path
) -> None:
    with_recordings(studies)
    (studies[1].parent / "stack.uff").write_text("no universal file")
    extract_recordings(Recorded(load_study(studies[1]), tmp_path / "alone"))
    with pytest.raises(StatorhomError, match=r"stack\.uff"):
        load_fleet(studies, tmp_path / "out", coarse(), LocalProcesses(2))
