"""Which of two loads that explain a recording in the median is taken."""

from __future__ import annotations

from importlib import import_module
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.extraction.set_up_shifts import SetUps

MODULE = import_module("statorhom.extraction.roving.find_load")


def taken(monkeypatch: pytest.MonkeyPatch, *misfits: tuple[float, ...]) -> Any:
    """The misfit of the load that is found where start poles of either kind lead to loads of these."""
    loads = [None if not m else SimpleNamespace(misfit=np.array(m)) for m in misfits]
    monkeypatch.setattr(MODULE, "rings", lambda _: "rings")
    monkeypatch.setattr(MODULE, "_start", lambda _: np.zeros(2, dtype=complex))
    monkeypatch.setattr(MODULE, "plane_starts", lambda *_: np.zeros((4, 2), dtype=complex))
    monkeypatch.setattr(MODULE, "_from", lambda *_: loads.pop(0))
    grid = SimpleNamespace(hammer_roved=False, points=(), references=(SimpleNamespace(position=(0, 0, 0)),))
    search: Any = SimpleNamespace(grid=grid, set_ups=SetUps.POINTS)
    found = MODULE.find_load(search, [])
    return None if found is None else tuple(found.misfit.tolist())


def test_a_load_that_lacks_a_mode_is_left_for_one_that_has_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Doublets at 6046 and 6067 Hz were one to the first look: 7.4 times the noise was left around it."""
    lacks = 0.87, 0.92, 0.99, 1.02, 1.01, 7.36, 1.04
    has = 0.87, 0.93, 1.0, 1.03, 1.01, 1.04, 1.04, 1.02
    assert np.median(lacks) < np.median(has)
    assert taken(monkeypatch, lacks, has) == has
    # and the other way round
    assert taken(monkeypatch, lacks, (1.2, 9.0, 9.0, 1.0)) == lacks


def test_what_explains_every_mode_is_taken_without_another_look(monkeypatch: pytest.MonkeyPatch) -> None:
    assert taken(monkeypatch, (1.2, 1.4), (0.9, 0.9)) == (1.2, 1.4)
    assert taken(monkeypatch, (), (1.2, 2.4)) == (1.2, 2.4)
    assert taken(monkeypatch, (), ()) is None
