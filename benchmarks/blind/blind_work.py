"""Making and diagnosing the cases: a folder per case, what is done stays done, two interruptions change nothing.

WORK/templates/…, WORK/cases/NAME (what a diagnosis sees), WORK/truth/NAME.json, WORK/runs/NAME/diagnosis.json and
WORK/runs/NAME/run.json (seconds, exit code, message).
"""

from __future__ import annotations

import json
import multiprocessing
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import asdict, dataclass
from functools import cache, partial
from pathlib import Path

from blind_cases import BlindCase
from blind_machines import write_template

from statorhom.conceal.conceal_study import Wish, conceal_study
from statorhom.conceal.folder import TRUTH
from statorhom.errors import StatorhomError
from statorhom.study.atomic import write_text

PATIENCE_S = 600.0


@dataclass(frozen=True)
class Work:
    """Folder of one benchmark.

    Parameters
    ----------
    folder : of everything.
    patience_s : a diagnosis that takes longer counts as failed.
    """

    folder: Path
    patience_s: float = PATIENCE_S

    def case(self, case: BlindCase) -> Path:
        """What the diagnosis sees."""
        return self.folder / "cases" / case.name

    def truth(self, case: BlindCase) -> Path:
        """What it does not."""
        return self.folder / "truth" / f"{case.name}.json"

    def refusal(self, case: BlindCase) -> Path:
        """Why it cannot be concealed, which may take a quarter of an hour to find."""
        return self.folder / "refused" / f"{case.name}.txt"

    def refusals(self) -> list[str]:
        """Of all cases, as they were said."""
        return [
            path.read_text(encoding="utf-8").strip() for path in sorted(self.folder.glob("refused/*.txt"))
        ]

    def run(self, case: BlindCase) -> Path:
        """What it says."""
        return self.folder / "runs" / case.name


def make(work: Work, case: BlindCase) -> str | None:
    """Make a case unless it is there; what went wrong, or None."""
    folder, truth, refusal = work.case(case), work.truth(case), work.refusal(case)
    if truth.exists():
        return None
    if refusal.exists():
        return refusal.read_text(encoding="utf-8").strip()
    shutil.rmtree(folder, ignore_errors=True)
    template = write_template(work.folder / "templates" / case.name, case.template, case.machine, case.number)
    wishes = [Wish(name, dict(case.given), case.strength) for name in case.effects]
    try:
        conceal_study(
            template,
            wishes,
            folder,
            seed=case.number,
            tables=case.tables,
            wide=case.wide,
            only=case.only,
            verdict="ambiguous" if case.group == "ambiguous" else None,
        )
    except StatorhomError as error:
        message = f"{case.name}: {error}"
        write_text(refusal, message + "\n")
        return message
    content = json.loads((folder / TRUTH).read_text(encoding="utf-8"))
    shutil.rmtree(folder / TRUTH.parent)
    write_text(truth, json.dumps(content | {"blind": asdict(case)}, indent=1) + "\n")
    return None


def diagnose(work: Work, case: BlindCase) -> str | None:
    """Diagnose a case unless that is done; what went wrong, or None."""
    folder = work.run(case)
    if (folder / "run.json").exists() or not work.truth(case).exists():
        return None
    command = [sys.executable, "-c", "from statorhom.cli import main; main()"]
    options = ["diagnose", str(work.case(case) / "study.toml"), "--out", str(folder), "--jobs", "1"]
    begin = time.perf_counter()
    try:
        done = subprocess.run(
            [*command, *options], capture_output=True, text=True, timeout=work.patience_s, check=False
        )
        code, message = done.returncode, done.stderr.strip().splitlines()[-1:]
    except subprocess.TimeoutExpired:
        code, message = -1, [f"no answer within {work.patience_s:g} s"]
    seconds = time.perf_counter() - begin
    state = {
        "seconds": seconds,
        "exit_code": code,
        # the same wherever it was run
        "message": message[0].replace(f"{work.folder}/", "") if code and message else "",
        "commit": commit(),
    }
    write_text(folder / "run.json", json.dumps(state) + "\n")
    return None if code == 0 else f"{case.name}: {state['message']}"


@cache
def commit() -> str:
    """What the answers come from: the repository's commit, marked where files of the program differ from it."""
    folder = Path(__file__).resolve().parent

    def said(*arguments: str) -> str:
        done = subprocess.run(
            ["git", "-C", str(folder), *arguments], capture_output=True, text=True, check=False
        )
        return done.stdout.strip()

    changed = said("status", "--porcelain", "--untracked-files=no", "--", ":/src")
    return (said("rev-parse", "--short", "HEAD") or "unknown") + ("+" if changed else "")


def each(
    what: str,
    function: Callable[[Work, BlindCase], str | None],
    work: Work,
    cases: Sequence[BlindCase],
    jobs: int,
) -> None:
    """Do something with all cases, some at a time."""
    with ThreadPoolExecutor(jobs) as pool:
        for number, fault in enumerate(pool.map(partial(_apart, function, work), cases), start=1):
            print(f"{what} {number}/{len(cases)}{f': {fault}' if fault else ''}", flush=True)


def _apart(function: Callable[[Work, BlindCase], str | None], work: Work, case: BlindCase) -> str | None:
    """In a process of its own: what solvers leave behind adds up to gigabytes."""
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        try:
            return pool.submit(function, work, case).result()
        except BrokenProcessPool:
            return f"{case.name}: its process was killed; is there enough memory?"
