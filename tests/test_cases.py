"""Public cases with known truth, made by a generator that shares nothing with the program."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from statorhom import Study
from statorhom.results.schema import Constant, Results

CASES = Path(__file__).resolve().parents[1].parent / "shared" / "cases"
CLEAN = ("p1-clean-stack", "p7-clean-chain")
NEAR = 0.03  # of the truth: where an identified constant must lie
COVERED = 0.85  # of all truths: what the 90 % intervals must hold

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not CASES.is_dir(), reason="the shared cases are not beside the repository"),
]


@dataclass(frozen=True)
class Found:
    """An identified constant beside its truth."""

    name: str
    constant: Constant
    truth: float

    @property
    def error(self) -> float:
        """Relative error of the value."""
        return self.constant.value / self.truth - 1.0

    @property
    def covered(self) -> bool:
        """Whether the truth lies inside the 90 % interval."""
        low, high = self.constant.ci90
        return low <= self.truth <= high


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> list[Found]:
    """Every constant of both cases that a step identifies."""
    constants: list[Found] = []
    for case in CLEAN:
        out = tmp_path_factory.mktemp(case)
        results = Study.load(CASES / case / "study-tables.toml").fit(out)
        truth = json.loads((CASES / case / "truth.json").read_text(encoding="utf-8"))["materials"]
        constants += [Found(f"{case}: {name}", c, truth[r][k]) for name, r, k, c in _own(results, truth)]
    return constants


def _own(results: Results, truth: dict[str, dict[str, float]]) -> Iterator[tuple[str, str, str, Constant]]:
    """Constants of the regions that each stage adds or changes: (name, region in truth.json, constant, value)."""
    seen: set[str] = set()
    for stage in results.stages:
        for region, material in stage.regions.items():
            key = region if region in truth else f"{region} ({stage.name})"
            if key not in seen:
                seen.add(key)
                for name, constant in material.engineering.items():
                    yield f"{key}.{name}", key, name, constant


def test_all_constants_are_compared(found: list[Found]) -> None:
    assert len(found) == 5 * (1 + 3)  # five each: the stack of p1; stack, dry and impregnated winding of p7


def test_what_is_called_identified_is_true(found: list[Found]) -> None:
    identified = {f.name: f.error for f in found if f.constant.status == "identified"}
    assert identified
    assert {name: error for name, error in identified.items() if abs(error) > NEAR} == {}


def test_each_case_identifies_the_lamination_in_shear(found: list[Found]) -> None:
    """Physics: modes with an axial node plane give G_rz, so that calling nothing identified is no way out."""
    shear = [f for f in found if f.name.endswith("lamination.G_rz_pa")]
    assert [f.constant.status for f in shear] == ["identified"] * 2


def test_intervals_hold_the_truth(found: list[Found]) -> None:
    missed = [f.name for f in found if not f.covered]
    assert len(missed) <= (1 - COVERED) * len(found), missed
