"""What is said first: where the declared model and a test differ, in words that do not belittle it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.report_rows import mismatch


def said(*residuals: float, density: float = 7650.0) -> str:
    """Of frequencies of one test that are off by so many standard deviations, and of a density (kg/m³)."""
    features = [
        Feature("frequency", "free", (r, 0, 0), 7.0 + 1e-3 * off, 7.0, 1e-3)
        for r, off in enumerate(residuals, start=2)
    ]
    features.append(Feature("density", "", None, density, 7650.0, 50.0))
    stage = SimpleNamespace(name="stack", tests=(SimpleNamespace(name="free"),))
    hypothesis = SimpleNamespace(features=lambda _: features, study=SimpleNamespace(stages=(stage,)))
    base: Any = SimpleNamespace(hypothesis=hypothesis, z=None)
    found = mismatch(base)
    assert found is not None
    return found.statement


@pytest.mark.parametrize(
    ("residuals", "words"),
    [
        ((0.5, -1.0, 1.2, 0.8), "meets every measured mode"),
        (
            (2.0, -2.1, 2.4, 1.9),
            "no mode is far off, but all together are, frequencies by 2.1 standard deviations",
        ),
        ((0.5, -1.0, 5.0, 0.8), "1 frequencies are off, (4, 0) by -0.50 % (5 standard deviations)"),
    ],
)
def test_many_modes_that_are_a_little_off_are_not_met(residuals: tuple[float, ...], words: str) -> None:
    assert words in said(*residuals)


def test_an_impossible_density_is_told_where_modes_are_met() -> None:
    """Of a wrong length constants make up for what the modes say; the volume stays wrong."""
    assert "weights and volumes give 8415 kg/m³ where 7650 is usual" in said(0.5, -1.0, 1.2, density=8415.0)
    assert "frequencies are off" in said(0.5, -1.0, 5.0, density=8415.0)
