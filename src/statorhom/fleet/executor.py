"""Who fits the machines: the same call for processes of this computer and for a cluster."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from typing import Protocol, TypeVar

Task = TypeVar("Task")
Result = TypeVar("Result")

ATTEMPTS = 3  # a task whose worker died so often is not tried again


@dataclass(frozen=True)
class Lost:
    """A task without an answer.

    Parameters
    ----------
    reason : what became of its workers.
    """

    reason: str


class Executor(Protocol):
    """Runs independent tasks, and again those whose worker died."""

    def run(
        self, function: Callable[[Task], Result], tasks: Sequence[Task]
    ) -> Generator[tuple[int, Result | Lost]]:
        """Yield the number and the result of every task once, in the order in which they end.

        Closing the generator ends the work.

        Parameters
        ----------
        function : importable by name; it raises nothing, and doing a task twice does no harm.
        tasks : picklable.

        Raises
        ------
        StatorhomError
            Where there is nobody to do the work.
        """
        ...
