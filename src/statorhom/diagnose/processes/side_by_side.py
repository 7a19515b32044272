"""Independent parts of a diagnosis in forked processes: they see the models as they are and send back what they found.

Models hold factors and memories that no process can send to another. A forked one has them already; what it sends
back names what both have instead of copying it. Where a system cannot fork, and for what a child could not do or
send, the parts are done here: answers are the same with any number of processes.
"""

from __future__ import annotations

import gc
import io
import multiprocessing
import os
import pickle
import sys
import warnings
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from itertools import chain
from multiprocessing.connection import Connection
from typing import Any, Generic, TypeVar

_T = TypeVar("_T")
_R = TypeVar("_R")

_PROCESSES: ContextVar[int] = ContextVar("processes", default=1)
# elsewhere system libraries do not survive it
CAN_FORK = sys.platform == "linux"
FORK: Any = multiprocessing.get_context("fork") if CAN_FORK else None


@contextmanager
def processes(jobs: int) -> Iterator[None]:
    """Use up to so many processes within."""
    token = _PROCESSES.set(jobs)
    try:
        yield
    finally:
        _PROCESSES.reset(token)


def workers() -> int:
    """How many threads or processes whoever asks may use now; one within parts that are done side by side."""
    return _PROCESSES.get()


def side_by_side(
    function: Callable[[_T], _R],
    items: Sequence[_T],
    shared: Sequence[object] = (),
    least: int = 2,
    here: Collection[int] = (),
) -> list[_R]:
    """`[function(item) for item in items]`; whoever is free takes the next one.

    Parameters
    ----------
    function : of an item; what it raises is raised here. What it remembers in a child is lost.
    items : worth a copy of what this process writes on meanwhile, some ten milliseconds per gigabyte at least.
    shared : objects that results may refer to; they come back as the same objects.
    least : number of items for which processes are begun.
    here : places of items that this process does, before it takes others: what it remembers of them stays.
    """
    given = [i for i in range(len(items)) if i not in here]
    count = min(_PROCESSES.get() if CAN_FORK else 1, len(items), len(given) + 1)
    if count < 2 or len(items) < least:
        return [function(item) for item in items]
    with processes(1):
        queue = _Queue(given)
        known = {id(one): one for one in shared}
        children = [_Child(function, items, queue, known) for _ in range(count - 1)]
        try:
            found = {i: function(items[i]) for i in chain(here, queue)}
            for child in children:
                found |= child.results()
        finally:
            for child in children:
                child.end()
        return [found[i] if i in found else function(items[i]) for i in range(len(items))]


class _Queue:
    """Numbers in their order, each given to one process."""

    def __init__(self, numbers: Sequence[int]) -> None:
        self._numbers = numbers
        self.owner = os.getpid()
        self._next = FORK.Value("l", 0)

    def __iter__(self) -> Iterator[int]:
        while True:
            with self._next.get_lock():
                place = self._next.value
                self._next.value += 1
            if place >= len(self._numbers):
                return
            yield self._numbers[place]


class _Child(Generic[_T, _R]):
    """A forked process that does what it finds in the queue."""

    def __init__(
        self, function: Callable[[_T], _R], items: Sequence[_T], queue: _Queue, known: dict[int, object]
    ) -> None:
        self._known = known
        self._end, theirs = FORK.Pipe(duplex=False)
        task = function, items, queue, known
        self._process = FORK.Process(target=_work, args=(*task, theirs, self._end), daemon=True)
        with warnings.catch_warnings():
            # no thread holds anything that the child asks for: it computes, and writes nowhere
            warnings.simplefilter("ignore", DeprecationWarning)
            self._process.start()
        theirs.close()

    def results(self) -> dict[int, _R]:
        """By number, as far as they came."""
        try:
            return {i: _Reader(text, self._known).load() for i, text in self._end.recv()}
        except (EOFError, OSError):
            return {}

    def end(self) -> None:
        """Give it up where it still works."""
        self._end.close()
        self._process.terminate()
        self._process.join()


def _work(
    function: Callable[[_T], _R],
    items: Sequence[_T],
    queue: _Queue,
    known: dict[int, object],
    end: Connection,
    parents: Connection,
) -> None:
    """Do items until one fails, which is for the parent, and send what was found; stop when the parent is gone."""
    gc.disable()  # it would touch, and so copy, all that is shared
    parents.close()  # or what nobody reads any more would still have a reader
    found: list[tuple[int, bytes]] = []
    with suppress(Exception):
        for number in queue:
            found.append((number, _written(function(items[number]), known)))
            if os.getppid() != queue.owner:
                return
    with suppress(OSError):
        end.send(found)


def _written(result: object, known: dict[int, object]) -> bytes:
    text = io.BytesIO()
    _Writer(text, known).dump(result)
    return text.getvalue()


class _Writer(pickle.Pickler):
    def __init__(self, file: io.BytesIO, known: dict[int, object]) -> None:
        super().__init__(file, pickle.HIGHEST_PROTOCOL)
        self._known = known

    def persistent_id(self, obj: object) -> int | None:
        """The place of what both processes have."""
        return id(obj) if id(obj) in self._known and self._known[id(obj)] is obj else None


class _Reader(pickle.Unpickler):
    def __init__(self, text: bytes, known: dict[int, object]) -> None:
        super().__init__(io.BytesIO(text))
        self._known = known

    def persistent_load(self, pid: Any) -> object:
        return self._known[pid]
