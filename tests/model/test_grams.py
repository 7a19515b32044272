"""Products of pieces between waves are kept as long as there is room."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.model.broken import grams as module

ONE = module.Gram(np.zeros((4, 4), complex), np.zeros((4, 4), complex))


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Groups whose products were made."""
    found: list[int] = []

    def gram(group: np.ndarray, *_: Any) -> module.Gram:
        found.append(int(group[0]))
        return ONE

    monkeypatch.setattr(module, "_gram", gram)
    return found


def ask(cache: module.GramCache, *groups: int) -> None:
    pieces: Any = PIECES
    for group in groups:
        cache.gram(pieces, np.array([group]), WAVES, WAVES)


PIECES = SimpleNamespace(take=lambda group: group)
WAVES: Any = SimpleNamespace()


def test_products_are_made_once(made: list[int]) -> None:
    ask(module.GramCache(), 1, 2, 1, 2)
    assert made == [1, 2]


def test_the_oldest_make_room(made: list[int], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "KEPT_BYTES", 2 * ONE.size)
    cache = module.GramCache()
    ask(cache, 1, 2, 3, 2, 3, 1)
    assert made == [1, 2, 3, 1]
    assert sum(gram.size for _, gram in cache.known.values()) == 2 * ONE.size


def test_what_is_needed_now_is_kept_whatever_its_size(
    made: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "KEPT_BYTES", 1)
    ask(module.GramCache(), 1, 1)
    assert made == [1]
