"""What is dear and made once: remembered, and handed on where a forked process made it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Mapping, Sequence
from typing import Any, TypeVar

from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.model.kept import Kept

_T = TypeVar("_T")
_R = TypeVar("_R")
News = list[Mapping[Hashable, Any]]


class Memory(Kept):
    """All results, and what others made."""

    def __init__(self) -> None:
        super().__init__()

    @property
    def marks(self) -> frozenset[Hashable]:
        """Of all that is there."""
        return frozenset(self._known)

    def beyond(self, marks: frozenset[Hashable]) -> Mapping[Hashable, Any]:
        """What is there beside some marks."""
        return {mark: result for mark, result in self._known.items() if mark not in marks}

    def learn(self, news: Mapping[Hashable, Any]) -> None:
        """Keep what was made elsewhere, but where it is there already."""
        for mark, result in news.items():
            self._known.setdefault(mark, result)


def remembering(
    function: Callable[[_T], _R],
    items: Sequence[_T],
    memories: Sequence[Memory],
    shared: Sequence[object] = (),
    here: Collection[int] = (),
) -> list[_R]:
    """`[function(item) for item in items]` side by side; what the memories learn meanwhile stays in them.

    Parameters
    ----------
    function, items, shared, here : as of `side_by_side`.
    memories : of what the function asks.
    """

    def told(item: _T) -> tuple[_R, News]:
        before = [memory.marks for memory in memories]
        result = function(item)
        return result, [memory.beyond(marks) for memory, marks in zip(memories, before, strict=True)]

    results = []
    for result, news in side_by_side(told, items, shared, here=here):
        for memory, made in zip(memories, news, strict=True):
            memory.learn(made)
        results.append(result)
    return results
