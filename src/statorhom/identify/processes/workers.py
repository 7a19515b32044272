"""A few processes that work on independent tasks, or the same work inline."""

from __future__ import annotations

import multiprocessing
import signal
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_EXCEPTION, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from types import TracebackType
from typing import Any, TypeVar

from threadpoolctl import threadpool_limits

from statorhom.errors import IdentificationError
from statorhom.identify.processes.announce import Progress

Task = TypeVar("Task")
Result = TypeVar("Result")
Tick = Callable[[], None]

POLL_S = 0.1


class Stopped(Exception):  # noqa: N818
    """Ends a task in a worker whose parent has given up."""


class Workers:
    """Runs tasks in `jobs` processes; with one job in this process, with exactly the same results.

    Use as a context manager; processes start with the first tasks and serve all that follow. They
    are started afresh (forkserver or spawn), never forked from a parent with running threads.

    Parameters
    ----------
    jobs : int
        Number of processes, at least 1.

    Raises
    ------
    IdentificationError
        Fewer than one job.
    """

    def __init__(self, jobs: int = 1) -> None:
        if jobs < 1:
            raise IdentificationError(f"jobs = {jobs}: give at least one")
        self.jobs = jobs
        self._pool: ProcessPoolExecutor | None = None
        self._context = multiprocessing.get_context(start_method())
        self._count: Any = None
        self._stop: Any = None

    def __enter__(self) -> Workers:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """End the processes; tasks that still run are told to stop."""
        if self._pool is not None:
            self._stop.set()
            self._pool.shutdown(wait=True, cancel_futures=True)
            self._pool = None

    def map(
        self,
        function: Callable[[Task, Tick], Result],
        tasks: Sequence[Task],
        *,
        progress: Progress | None = None,
    ) -> list[Result]:
        """Apply `function` to every task and return the results in their order.

        Parameters
        ----------
        function : callable
            Takes a task and a tick, to be called after every unit of work. Importable by name.
        tasks : sequence
            Picklable.
        progress : callable or None
            Called now and then, in this process, with the number of ticks of all tasks so far.

        Raises
        ------
        IdentificationError
            Where the processes cannot start or die.
        """
        if self.jobs == 1 or len(tasks) == 1:
            return _inline(function, tasks, progress)
        try:
            return self._parallel(function, tasks, progress)
        except BrokenProcessPool:
            self.close()
            raise IdentificationError(
                "the worker processes ended unexpectedly: use jobs = 1, or put your script's calls under "
                "if __name__ == '__main__'"
            ) from None
        except BaseException:
            self.close()
            raise

    def _parallel(
        self, function: Callable[[Task, Tick], Result], tasks: Sequence[Task], progress: Progress | None
    ) -> list[Result]:
        pool = self._started()
        self._count.value = 0
        futures = [pool.submit(_run, function, task) for task in tasks]
        pending: set[Future[Result]] = set(futures)
        while pending:
            done, pending = wait(pending, timeout=POLL_S, return_when=FIRST_EXCEPTION)
            for future in done:
                future.result()
            if progress is not None:
                progress(self._count.value)
        return [future.result() for future in futures]

    def _started(self) -> ProcessPoolExecutor:
        if self._pool is None:
            self._count, self._stop = self._context.Value("q", 0), self._context.Event()
            self._pool = ProcessPoolExecutor(
                self.jobs, self._context, initializer=_initialize, initargs=(self._count, self._stop)
            )
        return self._pool


def start_method() -> str:
    """How processes begin: afresh, by a server where there is one."""
    return "forkserver" if "forkserver" in multiprocessing.get_all_start_methods() else "spawn"


def _inline(
    function: Callable[[Task, Tick], Result], tasks: Sequence[Task], progress: Progress | None
) -> list[Result]:
    ticks = 0

    def tick() -> None:
        nonlocal ticks
        ticks += 1
        if progress is not None:
            progress(ticks)

    with threadpool_limits(limits=1):
        return [function(task, tick) for task in tasks]


_shared: dict[str, Any] = {}


def _initialize(count: Any, stop: Any) -> None:
    # Ctrl-C reaches the whole group of processes; the parent alone decides what follows from it
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _shared.update(count=count, stop=stop)


def _tick() -> None:
    with _shared["count"].get_lock():
        _shared["count"].value += 1
    if _shared["stop"].is_set():
        raise Stopped


def _run(function: Callable[[Task, Tick], Result], task: Task) -> Result:
    # the limit reaches only libraries that are loaded, and loading the task has loaded them
    with threadpool_limits(limits=1):
        return function(task, _tick)
