"""A mapping that cannot be changed (unlike dict) and can be pickled (unlike MappingProxyType)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, TypeVar

Value = TypeVar("Value")


class FrozenMap(Mapping[str, Value]):
    """Read-only mapping with text keys.

    Parameters
    ----------
    items : mapping
        What it holds; nested mappings are frozen as well.
    """

    __slots__ = ("_items",)
    _items: dict[str, Value]

    def __init__(self, items: Mapping[str, Value]) -> None:
        frozen = {
            key: FrozenMap(value) if isinstance(value, Mapping) else value for key, value in items.items()
        }
        object.__setattr__(self, "_items", frozen)

    def __getitem__(self, key: str) -> Value:
        return self._items[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a FrozenMap cannot be changed: {name}")

    def __hash__(self) -> int:
        return hash(frozenset(self._items.items()))

    def __reduce__(self) -> tuple[type, tuple[dict[str, Value]]]:
        return (FrozenMap, (self._items,))

    def plain(self) -> dict[str, Any]:
        """A dict of the same content, nested maps likewise."""
        return {key: value.plain() if isinstance(value, FrozenMap) else value for key, value in self.items()}

    def __repr__(self) -> str:
        return f"FrozenMap({self._items!r})"
