"""The yardstick methods on a linear model whose answers are known."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from statorhom.diagnose.evidence import simpler
from statorhom.diagnose.evidence.simpler import by_criterion, fitted_alone, in_plane_moduli
from statorhom.diagnose.located.scan import Scan, Signature
from statorhom.physics.candidate import Candidate

SLOPES = np.array([[2.0, 0.3], [0.0, 1.0], [1.0, -1.0]])
OFFSET = np.array([4.0, 1.0, -0.5])


class Linear:
    """Residuals that follow two constants linearly."""

    study = SimpleNamespace(
        constants=SimpleNamespace(names=("stack:lamination.E_p_pa", "stack:lamination.E_z_pa", "stack:mesh"))
    )

    def residuals(self, z: np.ndarray) -> np.ndarray:
        return OFFSET + SLOPES @ z

    def limits(self) -> tuple[np.ndarray, np.ndarray]:
        return np.full(2, -9.0), np.full(2, 9.0)


def test_the_modulus_alone_is_fitted_and_all_else_left(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(simpler, "jacobian", lambda *_: SLOPES)
    found = fitted_alone(Linear(), np.array([0.3, 0.7]), [0])  # type: ignore[arg-type]
    assert found == pytest.approx([-(2.0 * 4.0 + 1.0 * -0.5) / (1.0 + 5.0), 0.0])


def test_the_modulus_along_the_stack_is_no_in_plane_one() -> None:
    assert in_plane_moduli(Linear()) == [0]  # type: ignore[arg-type]


def test_the_criterion_prices_parameters_and_projects_nothing() -> None:
    residuals = np.array([3.0, 0.0, 0.0, 0.0])

    def signature(effect: str, whole: list[float], parameters: int) -> Signature:
        candidate = Candidate(effect, "stack", (SimpleNamespace(),) * parameters)  # type: ignore[arg-type]
        return Signature(candidate, np.zeros(parameters), np.zeros(4), 1.0, 0.0, np.array(whole))

    found = Scan(
        (
            signature("right", [-2.0, 0.0, 0.0, 0.0], 1),
            signature("dear", [-2.0, 0.0, 0.0, 0.0], 3),
            signature("opposite", [2.0, 0.0, 0.0, 0.0], 1),
        ),
        1.0,
    )
    base = SimpleNamespace(hypothesis=SimpleNamespace(residuals=lambda _: residuals), z=np.zeros(1))
    rows = by_criterion(found, base)  # type: ignore[arg-type]
    assert [row[0] for row in rows] == ["right", "dear", "opposite"]
    assert [row[2] for row in rows] == pytest.approx([9 - np.log(4), 9 - 3 * np.log(4), -np.log(4)])
