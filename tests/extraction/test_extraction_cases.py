"""Extraction from the development cases, whose true modes are known, and from the real beam's recording."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from statorhom.extraction import ExtractedMode, Extraction, extract
from statorhom.modes.naming import name_shape
from statorhom.recordings.read import read_recording

SHARED = Path(__file__).resolve().parents[2].parent / "shared"
# modes damped more than this have no peak of their own; the cases' tables leave them out as well
LARGEST_LOSS = 0.12
CASES = (
    "p1-clean-stack/stack-free",
    "p3-attached-mass/stack-free",
    "p4-support-compliance/stack-free",
    "p4-support-compliance/stack-clamped",
    "p7-clean-chain/stack-free",
    "p7-clean-chain/wound-free",
    "p7-clean-chain/impregnated-free",
)
BEAM_HZ = (177.0, 477.4, 933.1, 1535.5, 2286.9, 3162.5, 4181.9)
BEAM_PERCENT = (0.87, 0.16, 0.15, 0.19, 0.28, 0.24, 0.15)
BEAM_FURTHER_HZ = (5324.0, 6599.0, 7965.0, 9442.0)


def extracted(path: Path) -> Extraction:
    if not path.exists():
        pytest.skip(f"{path.name} is not beside the repository")
    return extract(read_recording([path]).frf_sets)


def name(mode: ExtractedMode, extraction: Extraction) -> tuple[int | None, int | None]:
    angles = np.array([point.angle for point in extraction.points], dtype=float).round(6)
    heights = np.array([point.position[2] for point in extraction.points if point.position]).round(9)
    columns, rows = np.unique(angles), np.unique(heights)
    grid = np.full((len(rows), len(columns)), np.nan, dtype=complex)
    grid[np.searchsorted(rows, heights), np.searchsorted(columns, angles)] = mode.shape
    found = name_shape(grid, columns, rows)
    return found.order, found.axial


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_true_modes_are_found_and_none_is_invented(case: str) -> None:
    path = SHARED / "cases" / f"{case}.uff"
    extraction = extracted(path)
    every = json.loads((path.parent / "truth.json").read_text(encoding="utf-8"))["modes"]
    truth = [mode for mode in every if mode["test"] == path.stem]
    listed = [mode for mode in extraction.modes if mode.loss_factor < LARGEST_LOSS]
    assert listed
    matched = set()
    for mode in listed:
        nearest = min(truth, key=lambda true: abs(true["frequency_hz"] - mode.frequency_hz))
        assert mode.frequency_hz == pytest.approx(nearest["frequency_hz"], rel=5e-4)
        assert mode.loss_factor == pytest.approx(nearest["loss_factor"], rel=0.08)
        assert name(mode, extraction) == (nearest["order"], nearest["axial"])
        matched.add((nearest["order"], nearest["axial"], round(nearest["frequency_hz"], -2)))
    # one reference shows one of two modes at the same frequency, so names are counted, not doublets
    radial = {
        (true["order"], true["axial"], round(true["frequency_hz"], -2))
        for true in truth
        if true["kind"] == "radial" and true["loss_factor"] < LARGEST_LOSS
    }
    assert radial <= matched


@pytest.mark.slow
def test_the_real_beam_s_published_modes() -> None:
    extraction = extracted(SHARED / "recordings" / "beam-hammer.uff")
    found = np.array([mode.frequency_hz for mode in extraction.modes])
    for frequency, percent in zip(BEAM_HZ, BEAM_PERCENT, strict=True):
        mode = extraction.modes[int(np.argmin(np.abs(found - frequency)))]
        assert mode.frequency_hz == pytest.approx(frequency, rel=2e-3)
        # the poles move from hammer point to hammer point, and the damping with who averages them
        assert 100 * mode.damping_ratio == pytest.approx(percent, rel=0.25)
    for frequency in BEAM_FURTHER_HZ:
        assert np.min(np.abs(found - frequency)) < 2e-3 * frequency
