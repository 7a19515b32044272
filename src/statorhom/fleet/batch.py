"""Fit a fleet: what is done already stays, what is left goes to the executor, all of it into one table."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path

import pandas as pd

from statorhom.errors import IdentificationError, StatorhomError
from statorhom.fleet.executor import Executor, Lost
from statorhom.fleet.load import load_fleet
from statorhom.fleet.machine import Ending, Machine, fit_machine
from statorhom.fleet.table import fleet_table, write_table
from statorhom.identify.fits.stage_run import Announce
from statorhom.identify.processes.announce import silent
from statorhom.identify.stages.settings import Settings
from statorhom.results.files import check_folder
from statorhom.results.schema import Results
from statorhom.study.message import one_line, quoted

UNSEEN = (
    "was fitted, but its results are not in {folder}: workers need this folder under the same path, and the same "
    "version of the program"
)


@dataclass(frozen=True)
class FleetResults:
    """A fitted fleet.

    Parameters
    ----------
    table : a row per machine and step, as in the files.
    files : that hold it.
    errors : machine → why it has no results.
    """

    table: pd.DataFrame
    files: tuple[Path, ...]
    errors: Mapping[str, str]

    def check(self) -> None:
        """Refuse a fleet that is not whole.

        Raises
        ------
        IdentificationError
            If a machine has no results.
        """
        if self.errors:
            name, error = next(iter(self.errors.items()))
            more = f" (and {len(self.errors) - 1} more)" if len(self.errors) > 1 else ""
            raise IdentificationError(
                one_line(
                    f"{self.files[0]}: {quoted(name)}{more} has no results: {error}; the others are complete"
                )
            )


def fit_fleet(
    studies: Sequence[str | os.PathLike[str]],
    out: str | os.PathLike[str],
    executor: Executor,
    *,
    seed: int = 1,
    announce: Announce = silent,
) -> FleetResults:
    """Identify all machines of a fleet; what a machine's results are does not depend on the others.

    Parameters
    ----------
    studies : study files of one geometry with equal steps, each with a name of its own.
    out : folder; machines that are done there already are not fitted again.
    executor : who does the work.
    seed : of every machine's search.
    announce : told how many machines there are and are done.

    Raises
    ------
    StatorhomError
        Before anything is fitted, if a study is faulty or not of the fleet's geometry.
    RuntimeError
        At the end, if the program itself is at fault with one of the machines.
    """
    folder = Path(out).absolute()
    machines = load_fleet(
        studies, folder, replace(Settings(seed=seed), shared_bases=True), executor, announce
    )
    check_folder(folder)
    done: dict[str, Results] = {}
    endings: dict[str, Ending] = {}
    try:
        _fit(machines, executor, announce, done, endings)
    finally:
        errors = {name: ending.error for name, ending in endings.items() if ending.error}
        table = fleet_table([m.name for m in machines], done, errors)
        files = write_table(table, folder)
    for name, ending in endings.items():
        if ending.fault:
            raise RuntimeError(f"machine {name!r}: {ending.fault}")
    return FleetResults(table, files, errors)


def _fit(
    machines: Sequence[Machine],
    executor: Executor,
    announce: Announce,
    done: dict[str, Results],
    endings: dict[str, Ending],
) -> None:
    """Fit what is left; `done` and `endings` are filled on the way, whatever interrupts it."""
    progress = announce("machines", len(machines))
    for machine in machines:
        if (results := machine.finished()) is not None:
            done[machine.name] = results
    progress(len(done))
    left = [machine for machine in machines if machine.name not in done]
    if not left:
        return
    with closing(executor.run(fit_machine, left)) as answers:
        for number, answer in answers:
            machine = left[number]
            endings[machine.name], results = _checked(machine, answer)
            if results is not None:
                done[machine.name] = results
            progress(len(done) + sum(bool(e.error) for e in endings.values()))


def _checked(machine: Machine, answer: Ending | Lost) -> tuple[Ending, Results | None]:
    """What a worker says of a machine, held against what the folder holds."""
    if isinstance(answer, Lost):
        return Ending(answer.reason), None
    if answer.error:
        return answer, None
    try:
        results = machine.finished()
    except StatorhomError as error:
        return Ending(str(error)), None
    return (Ending(UNSEEN.format(folder=machine.folder)), None) if results is None else (answer, results)
