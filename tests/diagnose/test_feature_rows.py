"""What was measured against what is predicted of it, before and after."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.report_rows import feature_rows

TEST = "wound-free"


def line(rank: int, measured: float, predicted: float, *rows: str) -> Feature:
    return Feature("frequency", TEST, (3, 0, rank), measured, predicted, 1e-3, rows=rows)


def fit(*features: Feature) -> Any:
    study = SimpleNamespace(stages=[SimpleNamespace(name="wound", tests=[SimpleNamespace(name=TEST)])])
    return SimpleNamespace(hypothesis=SimpleNamespace(study=study, features=lambda _: list(features)), z=())


def told(base: Any, best: Any) -> list[tuple[float, float, float]]:
    return [(row.measured, row.before, row.after) for row in feature_rows(base, best)]


def test_a_line_that_is_another_mode_of_its_name_afterwards_is_the_same_line() -> None:
    """Lines at 2150 and 2308 Hz were modes 1 and 2 of a name, and are 3 and 4 beside a softer winding."""
    base = fit(line(1, 7.67, 7.65, "4"), line(2, 7.74, 7.72, "5"))
    best = fit(line(2, 7.67, 7.67, "4"), line(4, 7.74, 7.73, "5"))
    assert told(base, best) == [(7.67, 7.65, 7.67), (7.74, 7.72, 7.73)]


def test_two_lines_of_one_mode_that_are_two_modes_afterwards_are_not_compared() -> None:
    base = fit(line(1, 7.65, 7.65, "2", "3"))
    best = fit(line(1, 7.63, 7.63, "2"), line(2, 7.67, 7.67, "3"))
    assert told(base, best) == []


def test_what_has_no_lines_is_told_by_its_mode() -> None:
    assert told(fit(line(0, 7.0, 7.1)), fit(line(0, 7.0, 7.02))) == [(7.0, 7.1, 7.02)]
