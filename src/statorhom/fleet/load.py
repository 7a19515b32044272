"""A fleet's studies, read and checked before the first machine is fitted."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path

from statorhom.errors import InputFileError
from statorhom.fleet.machine import Machine
from statorhom.identify.recorded_tests import with_recorded_tables
from statorhom.identify.settings import Settings
from statorhom.study.message import one_line, quoted
from statorhom.study.study import StudyFiles, load_study

MACHINES, BASES = "machines", "bases"


def load_fleet(
    studies: Sequence[str | os.PathLike[str]], out: Path, settings: Settings
) -> tuple[Machine, ...]:
    """Machines of one geometry.

    Parameters
    ----------
    studies : the study files, one a machine.
    out : folder of the fleet's results.
    settings : of the run.

    Raises
    ------
    StatorhomError
        If there is no study, one of them is faulty, two have the same name or two are of different machines.
    """
    if not studies:
        raise InputFileError("no study is given; name one study file per machine")
    machines = []
    for path in studies:
        files = load_study(path)
        folder = out / MACHINES / files.study.name
        recorded = with_recorded_tables(files, folder)
        machine = Machine(recorded.files, folder, out / BASES, settings, recorded.shapes)
        machine.chain.check()
        machines.append(machine)
    _check_names(machines)
    for machine in machines[1:]:
        _check_alike(machines[0].files, machine.files)
    return tuple(machines)


def _check_names(machines: Sequence[Machine]) -> None:
    """Every machine needs its own folder and its own rows in the table; some file systems ignore case."""
    seen: dict[str, Path] = {}
    for machine in machines:
        path = machine.files.path
        first = seen.setdefault(machine.name.casefold(), path)
        if first is path:
            continue
        if os.path.samefile(first, path):
            raise InputFileError(one_line(f"{path}: is given twice; name every machine once"))
        raise InputFileError(
            one_line(
                f"{path}: name: {first} is named {quoted(machine.name)} as well; give each machine its own name, "
                "such as its serial number"
            )
        )


def _geometry(files: StudyFiles) -> object:
    return files.drawing.model_dump(exclude={"name"})


def _steps(files: StudyFiles) -> object:
    return [(stage.name, stage.kind) for stage in files.study.stages]


def _models(files: StudyFiles) -> object:
    return [stage.model for stage in files.study.stages]


# what machines must share, the file that says it, and what is asked for
ALIKE: tuple[tuple[Callable[[StudyFiles], object], Callable[[StudyFiles], Path], str], ...] = (
    (_geometry, lambda files: files.geometry_path, "the dimensions differ; a fleet is of one geometry"),
    (_steps, lambda files: files.path, "names or kinds of the stages differ; a fleet has the same steps"),
    (_models, lambda files: files.path, "stages.model differs; a fleet has the same symmetries"),
)


def _check_alike(first: StudyFiles, other: StudyFiles) -> None:
    for content, file, problem in ALIKE:
        if content(first) != content(other):
            raise InputFileError(
                one_line(
                    f"{file(other)} and {file(first)}: {problem}; fit the others in a batch of their own"
                )
            )
