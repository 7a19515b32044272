"""Processes of this computer, each with one task at a time, so that a death costs one task and is known to."""

from __future__ import annotations

import contextlib
import multiprocessing
import signal
from collections import Counter, deque
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any

from statorhom.fleet.executor import ATTEMPTS, Lost, Result, Task
from statorhom.identify.processes.workers import start_method

PATIENCE_S = 10.0  # for a worker that was told to leave
LOST = (
    f"its process ended {ATTEMPTS} times without an answer, killed or out of memory; use fewer --jobs (and in a script "
    "put the call under if __name__ == '__main__')"
)


@dataclass
class Worker:
    """A process and the number of the task that it does."""

    process: BaseProcess
    connection: Connection
    task: int | None = None


class LocalProcesses:
    """An `Executor` of processes; a process that dies is replaced and its task done again.

    Parameters
    ----------
    jobs : number of processes.
    """

    def __init__(self, jobs: int) -> None:
        self.jobs = jobs

    def run(
        self, function: Callable[[Task], Result], tasks: Sequence[Task]
    ) -> Generator[tuple[int, Result | Lost]]:
        """See `Executor.run`."""
        waiting = deque(range(len(tasks)))
        deaths: Counter[int] = Counter()
        crew: list[Worker] = []
        try:
            while waiting or any(worker.task is not None for worker in crew):
                _engage(crew, min(self.jobs, len(tasks)), waiting, function, tasks)
                for worker in _answering(crew):
                    number = worker.task
                    assert number is not None
                    try:
                        result: Result | Lost = worker.connection.recv()
                        worker.task = None
                    except (EOFError, OSError):
                        _end([worker])
                        crew.remove(worker)
                        deaths[number] += 1
                        if deaths[number] < ATTEMPTS:
                            waiting.appendleft(number)
                            continue
                        result = Lost(LOST)
                    yield number, result
        finally:
            _end(crew)


def _engage(
    crew: list[Worker], size: int, waiting: deque[int], function: Callable[[Any], Any], tasks: Sequence[Any]
) -> None:
    """Give every idle worker a task, and start workers for tasks that are left."""
    while waiting and (idle := _idle(crew, size, function)) is not None:
        idle.task = waiting.popleft()
        # that it is dead shows when its answer is read
        with contextlib.suppress(OSError):
            idle.connection.send(tasks[idle.task])


def _idle(crew: list[Worker], size: int, function: Callable[[Any], Any]) -> Worker | None:
    for worker in crew:
        if worker.task is None:
            return worker
    if len(crew) == size:
        return None
    crew.append(_started(function))
    return crew[-1]


def _started(function: Callable[[Any], Any]) -> Worker:
    context: Any = multiprocessing.get_context(start_method())
    ours, theirs = context.Pipe()
    process = context.Process(target=_serve, args=(theirs, function), daemon=True)
    process.start()
    # only the worker may hold its end: then the end closes with it
    theirs.close()
    return Worker(process, ours)


def _answering(crew: Sequence[Worker]) -> list[Worker]:
    ready = wait([worker.connection for worker in crew if worker.task is not None])
    return [worker for worker in crew if worker.connection in ready]


def _end(crew: Sequence[Worker]) -> None:
    for worker in crew:
        worker.connection.close()
        worker.process.terminate()
    for worker in crew:
        worker.process.join(PATIENCE_S)
        if worker.process.is_alive():
            worker.process.kill()
            worker.process.join()


def _serve(connection: Connection, function: Callable[[Any], Any]) -> None:
    # Ctrl-C reaches the whole group of processes; the parent alone decides what follows from it
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # an exception, not a sudden end: files that are half written are removed on the way out
    signal.signal(signal.SIGTERM, _leave)
    while True:
        try:
            task = connection.recv()
        except EOFError:
            return
        connection.send(function(task))


def _leave(_signal: int, _frame: object) -> None:
    raise SystemExit
