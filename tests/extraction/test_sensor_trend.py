"""A roving sensor's mass: one mode per doublet that moves, the mass, and the frequencies without it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from roving_sensor import MASS_KG, POLES, loaded_frfs
from statorhom.extraction import Extraction, extract
from statorhom.extraction.doublet_motion import whole_doublets
from statorhom.extraction.sensor_trend import SensorTrend, sensor_trend
from synthetic_frfs import ring_points

POINTS = ring_points(12, 4)


@pytest.fixture(scope="module")
def loaded() -> Extraction:
    return extract(loaded_frfs(POINTS))


def whole_trend(found: Extraction) -> SensorTrend | None:
    assert found.loaded is not None
    moving, _ = whole_doublets(found.modes, found.loaded)
    return sensor_trend(moving, {0: (2, 0), 1: (2, 1)}, found.points, found.references[0])


def test_a_doublet_under_a_roving_sensor_is_one_mode_that_moves(loaded: Extraction) -> None:
    assert len(loaded.modes) == 2
    for mode, (frequency, loss) in zip(loaded.modes, POLES, strict=True):
        assert mode.frequency_hz < frequency * (1 - 5e-4)
        assert mode.loss_factor == pytest.approx(loss, rel=0.02)
        assert mode.shift is not None and mode.shift.shape == (len(POINTS), 1)
        assert mode.misfit < 1.2


def test_the_mass_and_the_frequencies_without_it(loaded: Extraction) -> None:
    trend = whole_trend(loaded)
    assert trend is not None and trend.significant
    assert trend.shifts.joint.mass_kg == pytest.approx(MASS_KG, rel=0.05)
    np.testing.assert_allclose(trend.bare_hz, [pole[0] for pole in POLES], rtol=5e-4)
    assert np.all(np.abs(trend.bare_hz - [pole[0] for pole in POLES]) < 2 * trend.bare_sd_hz)
    assert f"{1000 * trend.shifts.joint.mass_kg:.3g} g" in trend.statement


def test_without_a_mass_nothing_moves() -> None:
    found = extract(loaded_frfs(POINTS, mass_kg=0.0))
    assert all(mode.shift is None for mode in found.modes)
    assert sensor_trend(found.modes, {0: (2, 0), 1: (2, 1)}, found.points, found.references[0]) is None


def test_axial_motion_of_antisymmetric_modes_counts(
    loaded: Extraction, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The axial motion carries the mass though no accelerometer saw it: without it (2, 1) is 0.2 % too low."""
    from statorhom.extraction import sensor_trend as module
    from statorhom.modes.axial_motion import AxialLever

    monkeypatch.setattr(module, "axial_lever", lambda *_: AxialLever(0.0, 0.0))
    trend = whole_trend(loaded)
    assert trend is not None
    assert trend.bare_hz[1] < POLES[1][0] * (1 - 1e-3)


def test_the_table_has_the_frequencies_without_the_sensor(tmp_path: Path) -> None:
    from statorhom.extraction.measured_modes import measured_modes
    from statorhom.extraction.modal_table_text import modal_table, table_text
    from statorhom.recordings.recording import Recording
    from statorhom.recordings.uff.writer import write_uff
    from statorhom.study.modal_table import read_modal_table

    write_uff(tmp_path / "ring.uff", Recording("ring", frf_sets=(loaded_frfs(POINTS),)))
    measured = measured_modes([tmp_path / "ring.uff"])
    path = tmp_path / "modes.csv"
    path.write_text(table_text(modal_table(measured, path)), encoding="utf-8")
    modes = read_modal_table(path).modes
    for mode, (frequency, _) in zip(modes, POLES, strict=True):
        assert mode.frequency_without_sensor_hz == pytest.approx(frequency, rel=5e-4)
        assert 0.0 < (mode.frequency_without_sensor_sd_hz or 0.0) < 1e-3 * frequency
        assert mode.frequency_hz < frequency * (1 - 5e-4)
        assert mode.loss_factor_sd is not None


def test_a_mass_of_nothing_has_no_uncertain_axial_part(
    loaded: Extraction, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where nothing is known of the axial motion; a product of zero and infinity would be a warning, an error here."""
    from dataclasses import replace

    from statorhom.extraction import sensor_trend as module

    trend_of, square_sd = module.pole_shift_trend, module._square_sd

    def without(*args: object) -> object:
        found = trend_of(*args)  # type: ignore[arg-type]
        return replace(found, joint=replace(found.joint, mass_kg=0.0))

    monkeypatch.setattr(module, "pole_shift_trend", without)
    monkeypatch.setattr(module, "_square_sd", lambda *args: square_sd(*args) + np.inf)
    trend = whole_trend(loaded)
    assert trend is not None and np.all(np.isfinite(trend.bare_sd_hz))
