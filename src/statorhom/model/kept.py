"""The latest results, so that what is asked for again is not made again."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Any, TypeVar

_R = TypeVar("_R")


class Kept:
    """Results by marks; equal marks stand for equal results.

    Parameters
    ----------
    most : results that are kept, those that were asked for last; all by default.
    """

    def __init__(self, most: int | None = None) -> None:
        self._most = most
        self._known: OrderedDict[Hashable, Any] = OrderedDict()

    def __len__(self) -> int:
        return len(self._known)

    def __contains__(self, mark: Hashable) -> bool:
        return mark in self._known

    def once(self, mark: Hashable, make: Callable[[], _R]) -> _R:
        """What stands for the mark, made now if it is not there."""
        if mark not in self._known:
            return self.put(mark, make())
        self._known.move_to_end(mark)
        found: _R = self._known[mark]
        return found

    def put(self, mark: Hashable, result: _R) -> _R:
        """The result, which stands for the mark from now on."""
        self._known[mark] = result
        self._known.move_to_end(mark)
        if self._most is not None and len(self._known) > self._most:
            self._known.popitem(last=False)
        return result
