"""Where modes do not tell, the densities that recordings alone ask for do."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

import statorhom.diagnose.evidence.held_out_modes as module
from statorhom.diagnose.evidence.held_out_modes import WEIGHED, Error, held_out
from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.measured.feature import Feature

MODES = tuple(("wound-free", (r, 0, 0)) for r in range(2, 8))
KNOWN, SD = 7700.0, 90.0


def refit(density: float) -> Any:
    features = [Feature("density", "", None, density, KNOWN, SD)]
    features += [Feature("frequency", test, key, 7.0, 7.0, 1e-3) for test, key in MODES]
    study = SimpleNamespace(stages=())
    return SimpleNamespace(z=None, hypothesis=SimpleNamespace(features=lambda _: features, study=study))


def answered(
    monkeypatch: pytest.MonkeyPatch, modes: tuple[float, float], weighed: tuple[float, float], after: float
) -> Any:
    """Held-out errors (before, after) of the modes and of the densities; the density that the explanation has."""
    base, moved = refit(8600.0), refit(after)

    def errors(full: Any, fold: frozenset[Any]) -> dict[Any, Error]:
        i = 0 if full is base else 1
        known = {True: Error(weighed[i], 0.6, 0.0), False: Error(modes[i], 0.1, 0.0)}
        return {(g, False): known[g == WEIGHED] for g in fold}

    monkeypatch.setattr(module, "_errors", errors)
    return held_out(base, Explanation((), moved, 0.0))


def test_modes_that_fall_decide(monkeypatch: pytest.MonkeyPatch) -> None:
    found = answered(monkeypatch, (1.0, 0.2), (5.0, 0.5), 7720.0)
    assert found.falls
    assert found.groups == MODES


def test_densities_decide_where_modes_say_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    found = answered(monkeypatch, (0.1, 0.1), (5.0, 0.5), 7720.0)
    assert found.falls
    assert found.groups == (WEIGHED,)
    assert "densities" in found.what


def test_not_where_the_recordings_do_not_ask_for_them(monkeypatch: pytest.MonkeyPatch) -> None:
    assert not answered(monkeypatch, (0.1, 0.1), (5.0, 4.9), 7720.0).falls


def test_nor_where_modes_get_worse_or_the_explanation_says_nothing_of_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert not answered(monkeypatch, (0.1, 1.0), (5.0, 0.5), 7720.0).falls
    assert not answered(monkeypatch, (0.1, 0.1), (5.0, 0.5), 8600.0).falls
