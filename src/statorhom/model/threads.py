"""Independent parts of a solution one after the other, or by threads."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Any

Mapper = Callable[..., Any]


@contextmanager
def mapper(jobs: int) -> Iterator[Mapper]:
    """`map` over so many threads.

    One job begins no thread: what SuperLU allocates in one thread is not given back where another one drops the
    factors (SciPy's issue 15921), which costs a fleet's process gigabytes after a hundred machines.
    """
    if jobs <= 1:
        yield map
        return
    with ThreadPoolExecutor(jobs) as pool:
        yield pool.map
