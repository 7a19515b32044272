"""Public cases with FRFs and known modes, made by a generator that shares nothing with the program."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from statorhom.extraction.measured_modes import MeasuredModes, NamedMode, measured_modes

CASES = Path(__file__).resolve().parents[1].parent / "shared" / "cases"
RECORDINGS = sorted(CASES.glob("p*/*.uff"))
SAME = 2e-4  # of the frequency: doublets closer than this are one mode to a single hammer point

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not RECORDINGS, reason="the shared cases are not beside the repository"),
]


@dataclass(frozen=True)
class Case:
    """A recording's modes beside the true ones."""

    name: str
    found: MeasuredModes
    truth: tuple[dict[str, float], ...]

    def partner(self, true: dict[str, float]) -> NamedMode | None:
        """The mode found at a true one: within half of its bandwidth."""
        f, loss = true["frequency_hz"], true["loss_factor"]
        near = [one for one in self.found.modes if abs(one.mode.frequency_hz - f) < 0.5 * loss * f]
        return min(near, key=lambda one: abs(one.mode.frequency_hz - f), default=None)


def true_modes(path: Path, band: tuple[float, float]) -> tuple[dict[str, float], ...]:
    """Radial modes inside the band, those that no single hammer point can tell apart once."""
    modes = json.loads((path.parent / "truth.json").read_text(encoding="utf-8"))["modes"]
    mine = [m for m in modes if m["test"] == path.stem and m["order"] is not None]
    mine = [m for m in mine if band[0] * 1.02 < m["frequency_hz"] < band[1] * 0.98]
    kept: list[dict[str, float]] = []
    for mode in sorted(mine, key=lambda m: m["frequency_hz"]):
        if not kept or mode["frequency_hz"] > kept[-1]["frequency_hz"] * (1 + SAME):
            kept.append(mode)
    return tuple(kept)


@pytest.fixture(scope="module")
def cases() -> list[Case]:
    read = [(path, measured_modes([path])) for path in RECORDINGS]
    return [
        Case(f"{path.parent.name}/{path.stem}", found, true_modes(path, found.extraction.band_hz))
        for path, found in read
    ]


def test_true_modes_are_found(cases: list[Case]) -> None:
    missed = [(c.name, t["frequency_hz"]) for c in cases for t in c.truth if c.partner(t) is None]
    total = sum(len(c.truth) for c in cases)
    print(f"missed {len(missed)} of {total}: {missed}")
    assert len(missed) <= 0.05 * total


def test_modes_found_are_true(cases: list[Case]) -> None:
    invented, total = [], 0
    for case in cases:
        modes = json.loads((CASES / case.name.split("/")[0] / "truth.json").read_text(encoding="utf-8"))[
            "modes"
        ]
        true = np.array([m["frequency_hz"] for m in modes if m["test"] == case.name.split("/")[1]])
        for one in case.found.modes:
            total += 1
            width = 0.5 * one.mode.bandwidth_hz
            if np.abs(true - one.mode.frequency_hz).min() > width:
                invented.append((case.name, round(one.mode.frequency_hz, 1)))
    print(f"invented {len(invented)} of {total}: {invented}")
    assert len(invented) <= 0.05 * total


def test_frequency_damping_and_name_are_right(cases: list[Case]) -> None:
    pairs = [(c.name, t, c.partner(t)) for c in cases if "sensor-mass" not in c.name for t in c.truth]
    found = [(name, t, one) for name, t, one in pairs if one is not None]
    frequency = [abs(one.mode.frequency_hz / t["frequency_hz"] - 1) for _, t, one in found]
    damping = [abs(one.mode.loss_factor / t["loss_factor"] - 1) for _, t, one in found]
    named = [one.order == t["order"] and one.axial == t["axial"] for _, t, one in found]
    for (name, t, one), f, d, right in zip(found, frequency, damping, named, strict=True):
        if f > 5e-4 or d > 0.08 or not right:
            print(name, t, one.mode.frequency_hz, one.mode.loss_factor, one.order, one.axial)
    print(f"frequency {max(frequency):.1e}, damping {max(damping):.1e}, named {np.mean(named):.3f}")
    assert np.mean(np.array(frequency) < 5e-4) >= 0.98
    assert np.mean(np.array(damping) < 0.08) >= 0.98
    assert np.mean(named) >= 0.98
