"""A fleet's studies, read and checked before the first machine is fitted."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from contextlib import closing, suppress
from dataclasses import dataclass
from pathlib import Path

from statorhom.errors import InputFileError
from statorhom.fleet.executor import Executor
from statorhom.fleet.machine import Machine
from statorhom.identify.processes.announce import Announce, silent
from statorhom.identify.stages.recorded_tests import has_recordings, with_recorded_tables
from statorhom.identify.stages.settings import Settings
from statorhom.study.message import one_line, quoted
from statorhom.study.study import StudyFiles, load_study

MACHINES, BASES = "machines", "bases"


def load_fleet(
    studies: Sequence[str | os.PathLike[str]],
    out: Path,
    settings: Settings,
    executor: Executor,
    announce: Announce = silent,
) -> tuple[Machine, ...]:
    """Machines of one geometry; modes of their recordings are extracted.

    Parameters
    ----------
    studies : the study files, one a machine.
    out : folder of the fleet's results.
    settings : of the run.
    executor : who extracts.
    announce : told how many machines have recordings, and how many are done.

    Raises
    ------
    StatorhomError
        If there is no study, one of them is faulty, two have the same name or two are of different machines.
    """
    if not studies:
        raise InputFileError("no study is given; name one study file per machine")
    loaded = [load_study(path) for path in studies]
    _check_names(loaded)
    tasks = [Recorded(files, _folder(out, files)) for files in loaded if has_recordings(files)]
    _extract(tasks, executor, announce)
    machines = []
    for files in loaded:
        folder = _folder(out, files)
        # what the workers have extracted is kept there; what they could not is an error here too
        recorded = with_recorded_tables(files, folder)
        machine = Machine(recorded.files, folder, out / BASES, settings, recorded.shapes)
        machine.chain.check()
        machines.append(machine)
    for machine in machines[1:]:
        _check_alike(machines[0].files, machine.files)
    return tuple(machines)


@dataclass(frozen=True)
class Recorded:
    """A study with recordings, as it travels to whoever extracts their modes into its folder."""

    files: StudyFiles
    folder: Path


def extract_recordings(task: Recorded) -> None:
    """Extract a machine's recordings into its folder; never raises, for who reads the folder says what is wrong."""
    with suppress(Exception):
        with_recorded_tables(task.files, task.folder)


def _extract(tasks: Sequence[Recorded], executor: Executor, announce: Announce) -> None:
    # a single one is as soon extracted here
    if len(tasks) < 2:
        return
    progress = announce("machines with recordings", len(tasks))
    with closing(executor.run(extract_recordings, tasks)) as answers:
        for done, _ in enumerate(answers, start=1):
            progress(done)


def _folder(out: Path, files: StudyFiles) -> Path:
    return out / MACHINES / files.study.name


def _check_names(studies: Sequence[StudyFiles]) -> None:
    """Every machine needs its own folder and its own rows in the table; some file systems ignore case."""
    seen: dict[str, Path] = {}
    for files in studies:
        name, path = files.study.name, files.path
        first = seen.setdefault(name.casefold(), path)
        if first is path:
            continue
        if os.path.samefile(first, path):
            raise InputFileError(one_line(f"{path}: is given twice; name every machine once"))
        raise InputFileError(
            one_line(
                f"{path}: name: {first} is named {quoted(name)} as well; give each machine its own name, "
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
