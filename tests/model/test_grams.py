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

    def images(group: np.ndarray, _: Any) -> tuple[np.ndarray, None]:
        found.append(int(group[0]))
        return group, None

    monkeypatch.setattr(module, "_images", images)
    monkeypatch.setattr(module, "_gram", lambda *_: ONE)
    return found


def ask(cache: module.GramCache, *groups: int) -> None:
    pieces: Any = PIECES
    for group in groups:
        cache.grams(pieces, np.array([group]), [WAVES], WAVES)


PIECES = SimpleNamespace(take=lambda group: group)
WAVES: Any = SimpleNamespace(shapes=np.zeros(9))


def test_products_are_made_once(made: list[int]) -> None:
    ask(module.GramCache(), 1, 2, 1, 2)
    assert made == [1, 2]


def test_the_oldest_make_room(made: list[int]) -> None:
    cache = module.GramCache(2 * ONE.size)
    ask(cache, 1, 2, 3, 2, 3, 1)
    assert made == [1, 2, 3, 1]
    assert sum(gram.size for _, gram in cache.known.values()) == 2 * ONE.size


def test_what_is_needed_now_is_kept_whatever_its_size(made: list[int]) -> None:
    ask(module.GramCache(1), 1, 1)
    assert made == [1]


def test_images_of_the_columns_serve_all_rows(made: list[int]) -> None:
    cache, others = module.GramCache(), SimpleNamespace(shapes=np.zeros(9))
    pieces, rows = SimpleNamespace(take=lambda group: group), [WAVES, others]
    for _ in range(2):
        cache.grams(pieces, np.array([1]), rows, WAVES)  # type: ignore[arg-type]
    assert made == [1]
