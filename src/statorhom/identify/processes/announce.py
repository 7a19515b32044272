"""How long work tells that it begins and how far it is."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[int], None]
"""Called with how much is done."""

Announce = Callable[[str, int], Progress]
"""Called with what begins and how many units of work it has; returns what counts them."""


def silent(_what: str, _count: int) -> Progress:
    """Announce nothing."""
    return lambda _done: None
