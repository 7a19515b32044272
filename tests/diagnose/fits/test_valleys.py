"""How long optima in wide valleys are looked for."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.fits import valleys as module
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.valleys import wide_optima, with_other_sides

ROWS = 20


def followed(monkeypatch: pytest.MonkeyPatch, misfits: list[float], starts: int, most: int | None) -> int:
    """Number of the points that are refitted, which end at these misfits."""
    seen: list[float] = []

    def refitted(_: Any, z: np.ndarray, worth: float) -> Any:
        seen.append(worth)
        misfit = misfits[int(z[0]) // 10]
        return SimpleNamespace(z=z, objective=misfit, misfit=misfit, jacobian=np.zeros((ROWS, 1)))

    monkeypatch.setattr(module, "refit_objective", lambda _, z: float(z[0]))
    monkeypatch.setattr(module, "refitted", refitted)
    blank: Any = Hypothesis(SimpleNamespace())  # type: ignore[arg-type]
    wide_optima(blank, [np.array([10.0 * i]) for i in range(len(misfits))], starts, most)
    return len(seen)


def test_more_points_are_followed_while_none_fits(monkeypatch: pytest.MonkeyPatch) -> None:
    poor, good = 0.9 * ROWS, 0.05 * ROWS
    assert followed(monkeypatch, [poor] * 4 + [good] + [poor] * 5, 3, 8) == 5
    assert followed(monkeypatch, [poor] * 10, 3, 8) == 8
    assert followed(monkeypatch, [poor, good] + [poor] * 8, 3, 8) == 3
    assert followed(monkeypatch, [poor] * 10, 3, None) == 3


def test_a_deeper_valley_on_another_side_of_a_vague_constant_is_found(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of a bent valley: the first constant has to leave first before the second gains anything."""
    starts: list[np.ndarray] = []

    def refitted(_: Any, z: np.ndarray, worth: float) -> Any:
        assert worth == 41.0  # of the best so far
        starts.append(z.copy())
        # whoever starts at a positive second constant ends in the deeper valley
        found = np.array([3.0, 2.0, 0.0]) if z[1] > 1 else np.array([0.0, 0.0, 0.0])
        return SimpleNamespace(z=found, objective=29.0 if z[1] > 1 else 41.0)

    monkeypatch.setattr(module, "refitted", refitted)
    items = [
        SimpleNamespace(log=log, sd=sd) for log, sd in ((True, 1.2), (True, 1.5), (False, 2.0), (True, 0.3))
    ]
    blank: Any = Hypothesis(
        SimpleNamespace(constants=SimpleNamespace(items=items), files=None, stages=(), effects=())
    )  # type: ignore[arg-type]
    found: Any = [SimpleNamespace(z=np.zeros(3), objective=41.0)]
    assert [r.objective for r in with_other_sides(blank, found, [0, 1, 2, 3])] == [29.0, 41.0]
    # a ratio and what is known are left where they are
    assert [np.flatnonzero(z).tolist() for z in starts] == [[0], [0], [1], [1]]
    assert with_other_sides(blank, found, [0]) == found


def test_of_two_optima_in_one_wide_valley_both_are_kept() -> None:
    """Of a soft end winding: a third of the stiffness on three times the modulus leaves as much in wide valleys."""
    found: Any = [
        SimpleNamespace(z=np.array(z), objective=objective)
        for z, objective in (
            ([0.0, 0.0], 15.9),
            ([0.55, 0.4], 15.2),
            ([0.56, 0.41], 15.3),
            ([3.0, 0.0], 40.0),
        )
    ]
    assert [r.objective for r in module.different(found)] == [15.2, 15.9, 40.0]
