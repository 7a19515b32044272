"""Progress bars of long work, on standard error."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from statorhom.identify.processes.announce import Announce, silent


@contextmanager
def progress_bars(quiet: bool = False) -> Iterator[Announce]:
    """Bars that appear as work is announced; nothing where `quiet` or where nobody watches."""
    console = Console(stderr=True)
    if quiet or not console.is_terminal:
        yield silent
        return
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console) as bars:

        def announce(what: str, count: int):  # type: ignore[no-untyped-def]
            task = bars.add_task(what, total=count)
            return lambda done: bars.update(task, completed=done)

        yield announce
