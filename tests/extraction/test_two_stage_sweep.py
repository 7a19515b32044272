"""A ground vibration test from time records: a wide sweep finds the modes, a slow one around them measures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from scipy import signal

from statorhom.extraction.measured_modes import measured_modes
from statorhom.extraction.second_sweep import second_sweeps, segment_s
from statorhom.modes.mac_table import mac_table
from statorhom.recordings.dof import Dof
from statorhom.recordings.estimation.settings import SweepSettings
from statorhom.recordings.estimation.sweep_plan import SweepStage, sweep_signal
from statorhom.recordings.hit import Hit
from statorhom.recordings.recording import Recording

RATE_HZ = 1000.0
POLES = ((50.3, 0.006), (111.9, 0.008), (125.0, 0.007))
STATIONS = np.linspace(-1.0, 1.0, 9)
WIDE = SweepStage(35.0, 150.0, 5.0)


def wing() -> tuple[list[Dof], np.ndarray]:
    """Sensors at both edges of a swept wing, and its mass-normalised shapes: two bend, one twists."""
    points, rows = [], []
    for edge in (-1.0, 1.0):
        for i, span in enumerate(STATIONS):
            width = 0.3 - 0.15 * abs(span)
            place = (0.95 * float(span), float(0.3 * abs(span) + edge * width / 2), 0.0)
            points.append(Dof(100 + 10 * i + (edge > 0), place, (0.0, 0.0, 1.0)))
            bend = 1.6 * span**2 - 0.45
            second = 2.2 * span**4 - 1.9 * span**2 + 0.22
            rows.append((bend, second, 0.8 * edge * np.sin(np.pi * span / 2)))
    return points, np.array(rows)


POINTS, SHAPES = wing()
SHAKER = 16


def responses(force: np.ndarray) -> np.ndarray:
    """Accelerations of all points to a force at the shaker, exact for one that is linear between samples."""
    modal = []
    for (frequency, ratio), at_shaker in zip(POLES, SHAPES[SHAKER], strict=True):
        natural = 2 * np.pi * frequency
        system = ([at_shaker, 0.0, 0.0], [1.0, 2 * ratio * natural, natural**2])
        numerator, denominator, _ = signal.cont2discrete(system, 1 / RATE_HZ, method="foh")
        modal.append(signal.lfilter(np.ravel(numerator), denominator, force))
    return SHAPES @ np.array(modal)


def records(stage: SweepStage, rest_s: float) -> tuple[Hit, ...]:
    """One record per place of the roving sensor, 3 % noise in either channel."""
    rng = np.random.default_rng(round(stage.start_hz))
    quiet = np.zeros(round(rest_s * RATE_HZ))
    force = np.concatenate([quiet[:500], sweep_signal([stage], RATE_HZ), quiet])
    accelerations = responses(force)

    def noisy(values: np.ndarray) -> np.ndarray:
        return values + 0.03 * values.std() * rng.standard_normal(values.shape)

    reference = Dof(POINTS[SHAKER].node, POINTS[SHAKER].position, (0.0, 0.0, 1.0))
    return tuple(
        Hit(i, RATE_HZ, noisy(force), noisy(row)[None], reference, (point,), "sweep")
        for i, (point, row) in enumerate(zip(POINTS, accelerations, strict=True), start=1)
    )


def measured(hits: Sequence[Hit], sweep: SweepSettings, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(
        "statorhom.extraction.measured_modes.read_recording", lambda *_: Recording("sweep", hits=tuple(hits))
    )
    return measured_modes([Path("sweep.uff")], sweep=sweep)


@dataclass(frozen=True)
class Mode:
    frequency_hz: float
    shape: np.ndarray


def errors(found) -> np.ndarray:
    """Relative errors of frequency and damping ratio of every true mode, (modes, 2)."""
    rows = []
    for frequency, ratio in POLES:
        near = min(found, key=lambda mode: abs(mode.frequency_hz - frequency))
        rows.append((near.frequency_hz / frequency - 1, near.damping_ratio / ratio - 1))
    return np.abs(rows)


def test_the_first_stage_finds_and_the_second_measures(monkeypatch: pytest.MonkeyPatch) -> None:
    first = measured(records(WIDE, 3.0), SweepSettings(40.0, 145.0, 4.0), monkeypatch)
    assert len(first.modes) == 3
    (frfs,) = first.frf_sets
    assert len(frfs) == len(POINTS) and frfs.coherence is not None
    coarse = errors([one.mode for one in first.modes])
    assert np.all(coarse[:, 0] < 5e-3)
    found = [one.mode for one in first.modes]
    plan = second_sweeps(found)
    assert all(any(s.start_hz < f < s.stop_hz for s in plan) for f, _ in POLES)
    assert sum(remark.startswith("second stage: sweep") for remark in first.remarks) == len(plan)
    fine = []
    for stage in plan:
        length = segment_s(stage, found)
        margin = 0.05 * (stage.stop_hz - stage.start_hz)
        settings = SweepSettings(stage.start_hz + margin, stage.stop_hz - margin, length)
        second = measured(records(stage, length), settings, monkeypatch)
        (frfs,) = second.frf_sets
        for one in second.modes:
            at_mode = np.argmin(np.abs(frfs.frequency_hz - one.mode.frequency_hz))
            moving = np.abs(one.mode.shape) > 0.3
            assert frfs.coherence is not None and frfs.coherence[moving, at_mode].min() > 0.95
        fine += [one.mode for one in second.modes]
    assert len(fine) == 3
    measured_errors = errors(fine)
    assert np.all(measured_errors[:, 0] < 3e-4)
    assert np.all(measured_errors[:, 1] < 0.03)
    assert np.all(measured_errors[:, 1].max() < coarse[:, 1].max())


def test_the_shapes_are_named_and_paired(monkeypatch: pytest.MonkeyPatch) -> None:
    found = measured(records(WIDE, 3.0), SweepSettings(40.0, 145.0, 4.0), monkeypatch)
    names = [one.plan_form for one in found.modes]
    assert [(n.kind, n.span_nodes, n.symmetry) for n in names if n is not None] == [
        ("bending", 2, "symmetric"),
        ("bending", 4, "symmetric"),
        ("torsion", 1, "antisymmetric"),
    ]
    assert all(one.order is None and one.shape is None for one in found.modes)
    assert any("mode 3: 1st torsion" in remark for remark in found.remarks)
    truth = [Mode(f, row) for (f, _), row in zip(((60.4, 0), (97.8, 0), (138.0, 0)), SHAPES.T, strict=True)]
    rows = mac_table([one.mode for one in found.modes], truth)
    assert [(row.measured, row.simulated) for row in rows] == [(0, 0), (1, 1), (2, 2)]
    assert all(row.mac is not None and row.mac > 0.98 for row in rows)
    percent = [row.difference_percent for row in rows]
    assert percent == pytest.approx([20.1, 12.6, 10.4], abs=0.3)
