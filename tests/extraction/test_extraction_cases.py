"""Extraction from the development cases, whose true modes are known, and from the real beam's recording."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from statorhom.extraction.extraction import ExtractedMode
from statorhom.extraction.measured_modes import MeasuredModes, measured_modes

SHARED = Path(__file__).resolve().parents[2].parent / "shared"
# modes damped more than this have no peak of their own; the cases' tables leave them out as well
LARGEST_LOSS = 0.12
CASES = (
    "p1-clean-stack/stack-free",
    "p3-attached-mass/stack-free",
    "p4-support-compliance/stack-free",
    "p4-support-compliance/stack-clamped",
    "p5-sensor-mass/stack-free",
    "p7-clean-chain/stack-free",
    "p7-clean-chain/wound-free",
    "p7-clean-chain/impregnated-free",
)
FREQUENCY, LOSS, RECALL, PRECISION, NAMES = 5e-4, 0.08, 0.95, 0.95, 0.98
BEAM_HZ = (177.0, 477.4, 933.1, 1535.5, 2286.9, 3162.5, 4181.9)
BEAM_PERCENT = (0.87, 0.16, 0.15, 0.19, 0.28, 0.24, 0.15)
BEAM_FURTHER_HZ = (5324.0, 6599.0, 7965.0, 9442.0)


@dataclass(frozen=True)
class Score:
    """Counts of one recording: what was there, found, listed, true and rightly named."""

    there: int
    found: int
    listed: int
    true: int
    named: int


def measured(path: Path) -> MeasuredModes:
    if not path.exists():
        pytest.skip(f"{path.name} is not beside the repository")
    return measured_modes([path])


def name(mode: dict) -> tuple:
    return mode["order"], mode["axial"], mode["kind"]


def groups(truth: Sequence[dict]) -> list[list[dict]]:
    """Doublets together: one reference shows one of two modes at the same frequency."""
    every: list[list[dict]] = []
    for mode in truth:
        twin = [one for one in every if name(one[0]) == name(mode)
                and abs(one[0]["frequency_hz"] / mode["frequency_hz"] - 1) < FREQUENCY]  # fmt: skip
        if twin:
            twin[0].append(mode)
        else:
            every.append([mode])
    return every


@cache
def score(case: str) -> Score:
    path = SHARED / "cases" / f"{case}.uff"
    result = measured(path)
    truth = json.loads((path.parent / "truth.json").read_text(encoding="utf-8"))["modes"]
    every = groups([mode for mode in truth if mode["test"] == path.stem])
    listed = [
        (one, frequency)
        for one, frequency in zip(result.modes, result.bare_hz, strict=True)
        if one.mode.loss_factor < LARGEST_LOSS
    ]
    found, true, named = set(), 0, 0
    for one, frequency in listed:
        near = [g for g in every if min(abs(frequency / t["frequency_hz"] - 1) for t in g) < FREQUENCY
                and one.mode.loss_factor == pytest.approx(g[0]["loss_factor"], rel=LOSS)]  # fmt: skip
        true += bool(near)
        named += any((one.order, one.axial) == (g[0]["order"], g[0]["axial"]) for g in near)
        found |= {id(g) for g in near if (one.order, one.axial) == (g[0]["order"], g[0]["axial"])}
    there = [g for g in every if g[0]["kind"] == "radial" and g[0]["loss_factor"] < LARGEST_LOSS]
    return Score(len(there), sum(id(g) in found for g in there), len(listed), true, named)


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_true_modes_are_found_and_none_is_invented(case: str) -> None:
    counts = score(case)
    assert counts.found >= RECALL * counts.there
    assert counts.true >= PRECISION * counts.listed
    assert counts.named >= NAMES * counts.listed


@pytest.mark.slow
def test_the_sensor_s_mass_is_found() -> None:
    path = SHARED / "cases" / "p5-sensor-mass" / "stack-free.uff"
    result = measured(path)
    truth = json.loads((path.parent / "truth.json").read_text(encoding="utf-8"))["effects"][0]
    assert result.sensor is not None
    mass = result.sensor.shifts.joint.mass_kg
    assert mass == pytest.approx(truth["parameters"]["mass_kg"], rel=0.05)


@pytest.fixture(scope="module")
def beam() -> MeasuredModes:
    return measured(SHARED / "recordings" / "beam-hammer.uff")


def nearest(beam: MeasuredModes, frequency_hz: float) -> ExtractedMode:
    return min((one.mode for one in beam.modes), key=lambda mode: abs(mode.frequency_hz - frequency_hz))


@pytest.mark.slow
def test_the_real_beam_s_published_modes(beam: MeasuredModes) -> None:
    for frequency in BEAM_HZ:
        assert nearest(beam, frequency).frequency_hz == pytest.approx(frequency, rel=2e-3)
    for frequency in BEAM_FURTHER_HZ:
        assert nearest(beam, frequency).frequency_hz == pytest.approx(frequency, rel=2e-3)
    # one further peak, in 62 % of the receptance at 1377 Hz
    assert len(beam.modes) <= len(BEAM_HZ) + len(BEAM_FURTHER_HZ) + 1


@pytest.mark.slow
def test_the_real_beam_s_damping(beam: MeasuredModes) -> None:
    """Within 15 % of what was published, but for two modes where no single FRF has the published damping.

    At 477 Hz the 42 FRFs say 0.186 … 0.214 % one by one, at 3162 Hz 0.176 … 0.204 %, whether a resonance with
    residual terms is fitted or a circle.
    """
    contradicted = {477.4: (0.186, 0.214), 3162.5: (0.176, 0.204)}
    for frequency, percent in zip(BEAM_HZ, BEAM_PERCENT, strict=True):
        found = 100 * nearest(beam, frequency).damping_ratio
        low, high = contradicted.get(frequency, (0.85 * percent, 1.15 * percent))
        assert low <= found <= high


@pytest.mark.slow
def test_circles_of_single_frfs_contradict_two_published_dampings() -> None:
    """Evidence for the exceptions above that rests on nothing but equation [5] on each FRF."""
    from statorhom.extraction import circle_fit
    from statorhom.recordings.read import read_recording

    path = SHARED / "recordings" / "beam-hammer.uff"
    if not path.exists():
        pytest.skip(f"{path.name} is not beside the repository")
    frfs = read_recording([path]).frf_sets[0]
    for frequency, percent in ((477.4, 0.16), (3162.5, 0.24)):
        reach = max(0.02 * percent * frequency, 2.6)
        lines = np.abs(frfs.frequency_hz - frequency) < reach
        fits = [circle_fit(frfs.frequency_hz[lines], row[lines]) for row in frfs.receptance]
        damping = np.array([50 * fit.loss_factor for fit in fits])
        assert np.all(np.abs(damping / percent - 1) > 0.14)
        assert np.median(np.abs(damping / percent - 1)) > 0.19
