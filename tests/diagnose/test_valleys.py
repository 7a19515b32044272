"""How long optima in wide valleys are looked for."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose import valleys as module
from statorhom.diagnose.hypothesis import Hypothesis
from statorhom.diagnose.valleys import wide_optima

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
