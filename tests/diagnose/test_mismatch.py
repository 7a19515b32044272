"""What is said first: where the declared model and a test differ, in words that do not belittle it."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

import pytest

from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.mismatch import mismatch


def said(*residuals: float, density: float = 7650.0, more: Sequence[Feature] = ()) -> str:
    """Of frequencies of one test that are off by so many standard deviations, a density (kg/m³), and more."""
    features = [
        Feature("frequency", "free", (r, 0, 0), 7.0 + 1e-3 * off, 7.0, 1e-3)
        for r, off in enumerate(residuals, start=2)
    ]
    features += more
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
        ((4.5, -1.0, 5.0, 0.8), "2 frequencies are off, (4, 0) by -0.50 % (5 standard deviations)"),
        ((0.5, -1.0, 5.0, 0.8), "1 frequency is off, (4, 0) by -0.50 % (5 standard deviations)"),
    ],
)
def test_many_modes_that_are_a_little_off_are_not_met(residuals: tuple[float, ...], words: str) -> None:
    assert words in said(*residuals)


def test_an_impossible_density_is_told_where_modes_are_met() -> None:
    """Of a wrong length constants make up for what the modes say; the volume stays wrong."""
    assert "weights and volumes give 8415 kg/m³ where 7650 is usual" in said(0.5, -1.0, 1.2, density=8415.0)
    assert "frequency is off" in said(0.5, -1.0, 5.0, density=8415.0)


def off(kind: str, *orders: int) -> list[Feature]:
    """Features of modes that are five standard deviations off."""
    return [Feature(kind, "free", (r, 0, 0), 5e-3, 0.0, 1e-3) for r in orders]


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (off("split", 2), "free: 1 doublet is split otherwise than predicted"),
        (off("split", 2, 3), "free: 2 doublets are split otherwise than predicted"),
        (off("lean", 2), "free: 1 shape leans to one end otherwise than predicted"),
        (off("shape", 2, 3), "free: 2 shapes are not those of the declared body"),
        (
            off("level", 2) + off("level_loss", 2),
            "free: 1 mode changes with the force otherwise than predicted",
        ),
        (off("level_loss", 2, 3), "free: 2 modes change with the force otherwise than predicted"),
    ],
)
def test_what_is_off_beside_frequencies_is_counted_by_modes(more: Sequence[Feature], words: str) -> None:
    """Of a test whose modes slip as the force grows nothing else may be off."""
    assert said(0.5, -1.0, more=more) == words


def test_shapes_that_lean_are_said_where_every_frequency_is_met() -> None:
    leans = [Feature("lean", "free", (r, 0, 0), 1e-2 * off, 0.0, 1e-2) for r, off in ((2, 2.4), (3, 2.8))]
    assert "every frequency is met, but shapes lean to one end by 2." in said(0.5, -1.0, more=leans)
    little = [Feature("lean", "free", (2, 0, 0), 8e-3, 0.0, 1e-2)]
    assert "meets every measured mode" in said(0.5, -1.0, more=little)
