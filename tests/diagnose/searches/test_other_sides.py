"""Constants of which little was known start on either side where a misfit is left."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.fits.valleys import ASIDE
from statorhom.diagnose.searches import sharper
from statorhom.diagnose.stages.constants import Constant

VAGUE = Constant("stack:lamination.E_z_pa", 1e10, 1.7, 1e8, 1e12, log=True)
KNOWN = Constant("stack:lamination.E_p_pa", 2e11, 0.05, 1e10, 1e12, log=True)
RATIO = Constant("stack:lamination.nu_p", 0.3, 2.0, 0.0, 5.0)


@dataclass(frozen=True)
class Hypothetical:
    study: Any
    held: Any = None
    changes: Any = None
    candidates: tuple[Any, ...] = ()

    def actions(self, _z: np.ndarray) -> tuple[Any, ...]:
        return (SimpleNamespace(changes=self.changes),)


def found_at(z: np.ndarray, objective: float) -> Any:
    study = SimpleNamespace(constants=SimpleNamespace(items=(KNOWN, VAGUE, RATIO)), stages=())
    return SimpleNamespace(hypothesis=Hypothetical(study), z=z, objective=objective, cost=objective)


@pytest.mark.parametrize(("there", "objective"), [(40.0, 40.0), (99.0, 100.0)])
def test_a_valley_on_the_other_side_is_taken_where_it_is_deeper(
    monkeypatch: pytest.MonkeyPatch, there: float, objective: float
) -> None:
    starts = []

    def refitted(_hypothesis: Any, z: np.ndarray, worth: float) -> Any:
        starts.append(z.copy())
        assert worth in (100.0, there)
        return found_at(z, there if z[1] > 0 else 120.0)

    monkeypatch.setattr(sharper, "refitted", refitted)
    best = sharper._on_other_sides(found_at(np.array([0.2, -0.7, 0.1]), 100.0))
    assert best.objective == objective
    # the one that is vague, both sides, and nothing else moved; and where that led to, with its models
    assert [s[1] for s in starts] == [-ASIDE, ASIDE, *([ASIDE] if there < 98.0 else [])]
    assert all(s[0] == 0.2 and s[2] == 0.1 for s in starts)


def test_what_breaks_the_symmetry_is_solved_on_the_other_side(monkeypatch: pytest.MonkeyPatch) -> None:
    """Splits follow an axial modulus only if the reference does: a refit at the old one would not find it."""
    references = []

    def broken(z: np.ndarray, objective: float) -> Any:
        refit = found_at(z, objective)
        refit.hypothesis = replace(refit.hypothesis, changes=lambda *_: ())
        return refit

    def own_model(hypothesis: Any, z: np.ndarray, *, quick: bool) -> Any:
        # where the mesh is wrong by about as much, a look at the other side does not solve finer meshes
        assert quick
        references.append(z[1])
        return hypothesis

    def refit(_hypothesis: Any, z: np.ndarray, rounds: int, worth: float) -> Any:
        # the first steps from so far promise too little
        assert (rounds, worth) == (1, 100.0 + sharper.HOPELESS)
        return broken(z, 20.0 if z[1] > 0 else 190.0)

    monkeypatch.setattr(sharper, "in_its_own_model", own_model)
    monkeypatch.setattr(sharper, "refit", refit)
    assert sharper._on_other_sides(broken(np.array([0.2, -0.7, 0.1]), 100.0)).objective == 20.0
    assert references == [-ASIDE, ASIDE, ASIDE]
