"""Local processes: every task answered once, whoever dies."""

from __future__ import annotations

import multiprocessing
import os
import signal
import time
from contextlib import closing
from pathlib import Path

from statorhom.fleet.executor import ATTEMPTS, Lost
from statorhom.fleet.local import LocalProcesses


def double(task: int) -> int:
    return 2 * task


def die_once(marker: Path) -> str:
    """Kill the process that does the task, the first time."""
    if marker.suffix == ".once" and not marker.exists():
        marker.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return marker.name


def die(task: int) -> int:
    if task == 1:
        os.kill(os.getpid(), signal.SIGKILL)
    return task


def sleep(task: Path) -> None:
    try:
        # within: whoever waits for the file may end the process as soon as it is there
        task.touch()
        time.sleep(60)
    finally:
        task.unlink()


def test_every_task_is_answered_once() -> None:
    answers = list(LocalProcesses(2).run(double, range(7)))
    assert sorted(answers) == [(i, 2 * i) for i in range(7)]
    assert multiprocessing.active_children() == []


def test_nothing_to_do_starts_nothing() -> None:
    assert list(LocalProcesses(2).run(double, [])) == []


def test_the_task_of_a_killed_process_is_done_again(tmp_path: Path) -> None:
    tasks = [tmp_path / name for name in ("a", "b.once", "c", "d")]
    answers = list(LocalProcesses(2).run(die_once, tasks))
    assert sorted(answers) == [(i, task.name) for i, task in enumerate(tasks)]
    assert (tmp_path / "b.once").exists()


def test_a_task_that_kills_every_process_is_given_up_and_costs_no_other() -> None:
    answers = dict(LocalProcesses(1).run(die, range(3)))
    assert answers[0] == 0 and answers[2] == 2
    lost = answers[1]
    assert isinstance(lost, Lost) and f"{ATTEMPTS} times" in lost.reason


def test_processes_killed_from_outside_are_replaced() -> None:
    with closing(LocalProcesses(2).run(double, range(6))) as answers:
        found = [next(answers)]
        for child in multiprocessing.active_children():
            assert child.pid is not None
            os.kill(child.pid, signal.SIGKILL)
        found += answers
    assert sorted(found) == [(i, 2 * i) for i in range(6)]


def test_closing_ends_the_work_and_tidies_up(tmp_path: Path) -> None:
    """A process is told to leave by an exception, so that what it began is undone."""
    running = LocalProcesses(2)
    answers = running.run(touch_or_sleep, [tmp_path / "quick", tmp_path / "slow"])
    assert next(answers)[0] == 0
    deadline = time.monotonic() + 60
    while not (tmp_path / "slow").exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    answers.close()
    assert not (tmp_path / "slow").exists()
    assert multiprocessing.active_children() == []


def touch_or_sleep(task: Path) -> None:
    if task.name == "slow":
        sleep(task)
