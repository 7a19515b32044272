"""Which constants are sought again beside an effect: those of the steps after its own, one step after the other."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.searches import best_refit
from statorhom.diagnose.searches import searched_starts as module
from statorhom.diagnose.searches.searched_starts import of_later_steps, searched_starts
from statorhom.errors import IdentificationError

NAMES = ("stack", "wound", "impregnated")


@dataclass(frozen=True)
class Model:
    candidates: tuple[Any, ...]
    study: Any
    held: Any = "pairs"
    trained: bool = True

    def limits(self) -> tuple[np.ndarray, np.ndarray]:
        return np.full(7, -1.0), np.full(7, 1.0)


@dataclass(frozen=True)
class Constants:
    items: list[Any]

    def __len__(self) -> int:
        return len(self.items)


def found(stage: str) -> Any:
    items = [SimpleNamespace(name=f"{name}:material.{k}", fixed=False) for name in NAMES for k in ("E", "G")]
    setups = [SimpleNamespace(name=name) for name in NAMES]
    files = SimpleNamespace(study=SimpleNamespace(stages=[SimpleNamespace(name=name) for name in NAMES]))
    study = SimpleNamespace(stages=setups, files=files, constants=Constants(items))
    return SimpleNamespace(hypothesis=Model((SimpleNamespace(stage=stage),), study), z=np.zeros(7))


def sought(monkeypatch: pytest.MonkeyPatch, stage: str) -> tuple[list[set[int]], list[Any]]:
    """Places that vary in every search, and the optima that come back."""
    varied: list[set[int]] = []

    def wide_optima(hypothesis: Model, points: list[np.ndarray], most: int) -> list[Any]:
        assert hypothesis.held is None and not hypothesis.trained and most == module.REFITTED
        assert all(np.abs(p).max() <= 1.0 for p in points)
        varied.append(set(np.flatnonzero(np.ptp(points, axis=0)).tolist()))
        return [SimpleNamespace(z=points[0] + 0.1 * len(varied))]

    monkeypatch.setattr(module, "wide_optima", wide_optima)
    return varied, of_later_steps(found(stage))


def test_steps_after_a_wrong_mass_of_the_first_are_sought_one_by_one(monkeypatch: pytest.MonkeyPatch) -> None:
    varied, optima = sought(monkeypatch, "stack")
    assert varied == [{2, 3}, {4, 5}]
    # the last search began where the one before it had ended
    np.testing.assert_allclose(optima[0].z, 0.1 + 0.2)


def test_what_an_effect_is_added_to_stays_until_an_optimum_is_sought(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Another place of a lump costs a solution, and where it is, is known."""
    varied: list[set[int]] = []

    def wide_optima(_: Any, points: list[np.ndarray], most: int) -> list[Any]:
        del most
        varied.append(set(np.flatnonzero(np.ptp(points, axis=0)).tolist()))
        return []

    monkeypatch.setattr(module, "wide_optima", wide_optima)
    monkeypatch.setattr(Model, "actions", lambda *_: [], raising=False)
    model = found("stack").hypothesis
    lump, shear = (SimpleNamespace(stage="stack", parameters=range(count)) for count in (2, 1))
    limits = np.full(9, 5.0)
    monkeypatch.setattr(Model, "limits", lambda _: (-limits, limits))
    searched_starts(replace(model, candidates=(lump, shear)), np.zeros(9))
    # the stack's own two constants, and the last effect's magnitude: not the lump's two
    assert varied == [{0, 1, 8}]


def test_supports_are_also_tried_beside_the_known_materials(monkeypatch: pytest.MonkeyPatch) -> None:
    """Springs of 2.3 GN/m² under a table's stack: eight supports with materials from everywhere led to no valley."""
    tried: list[np.ndarray] = []
    monkeypatch.setattr(module, "wide_optima", lambda _, points, *__: tried.extend(points) or [])
    monkeypatch.setattr(
        Model, "actions", lambda *_: [SimpleNamespace(supports={"clamped": 1})], raising=False
    )
    monkeypatch.setattr(Model, "limits", lambda _: (np.full(8, -5.0), np.full(8, 5.0)))
    springs = SimpleNamespace(stage="stack", parameters=range(2))
    known = np.full(8, 0.3)
    searched_starts(replace(found("stack").hypothesis, candidates=(springs,)), known)
    beside = {tuple(z[6:]) for z in tried if np.array_equal(z[:6], known[:6])}
    elsewhere = {tuple(z[6:]) for z in tried if not np.array_equal(z[:6], known[:6])}
    assert len(beside) >= module.ALONE
    assert len(elsewhere) <= module.SUPPORTS


def test_after_the_last_step_nothing_is_left_to_be_sought(monkeypatch: pytest.MonkeyPatch) -> None:
    assert sought(monkeypatch, "impregnated") == ([], [])


def test_where_nothing_fits_there_are_no_other_optima(monkeypatch: pytest.MonkeyPatch) -> None:
    def nothing(*_: Any) -> None:
        raise IdentificationError("none")

    monkeypatch.setattr(module, "wide_optima", nothing)
    assert of_later_steps(found("wound")) == []


def best_of(monkeypatch: pytest.MonkeyPatch, adequacy: float, worth: float, *, far: bool = True) -> float:
    """Objective of a candidate's best refit, of which other constants of later steps would leave 5 of 50."""
    one, other = (SimpleNamespace(objective=o, misfit=o, jacobian=np.zeros((30, 1))) for o in (50.0, 5.0))
    rough: Any = SimpleNamespace(z=np.zeros(1))
    for name, value in {
        "explained": lambda *_: SimpleNamespace(adequacy_but_one=adequacy),
        "price": lambda _: best_refit.CHEAP,
        "shared_by": lambda _: [],
        "refitted": lambda *_: one,
        "_rival": lambda *_: one,
        "_through": lambda _: one,
        "of_later_steps": lambda _: [rough],
        "through_wide_valleys": lambda *_: other,
        "at_fitting_height": lambda best, _: best,
        "at_fitting_angle": lambda best, _: best,
        "_whole": lambda best, _: best,
    }.items():
        monkeypatch.setattr(best_refit, name, value)
    one.hypothesis = None
    start: Any = SimpleNamespace(hypothesis=None, z=np.zeros(1))
    best: Any = best_refit.best_refit([start], worth, far=far)
    return float(best.objective)


def test_later_steps_are_sought_again_only_where_much_is_left_and_nothing_leads(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert best_of(monkeypatch, 1e-9, np.inf) == 5.0
    assert best_of(monkeypatch, 0.5, np.inf) == 50.0
    assert best_of(monkeypatch, 1e-9, 80.0) == 50.0
    assert best_of(monkeypatch, 1e-9, np.inf, far=False) == 50.0
