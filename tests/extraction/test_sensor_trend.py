"""A roving sensor's mass: one mode per doublet that moves, the mass, and the frequencies without it."""

from __future__ import annotations

import numpy as np
import pytest

from roving_sensor import MASS_KG, POLES, loaded_frfs
from statorhom.extraction import Extraction, extract
from statorhom.extraction.sensor_trend import sensor_trend
from synthetic_frfs import ring_points

POINTS = ring_points(12, 4)


@pytest.fixture(scope="module")
def loaded() -> Extraction:
    return extract(loaded_frfs(POINTS))


def test_a_doublet_under_a_roving_sensor_is_one_mode_that_moves(loaded: Extraction) -> None:
    assert len(loaded.modes) == 2
    for mode, (frequency, loss) in zip(loaded.modes, POLES, strict=True):
        assert mode.frequency_hz < frequency * (1 - 5e-4)
        assert mode.loss_factor == pytest.approx(loss, rel=0.02)
        assert mode.shift is not None and mode.shift.shape == (len(POINTS), 1)
        assert mode.misfit < 1.2


def test_the_mass_and_the_frequencies_without_it(loaded: Extraction) -> None:
    trend = sensor_trend(loaded.modes, {0: (2, 0), 1: (2, 1)}, loaded.points, loaded.references[0])
    assert trend is not None and trend.significant
    assert trend.shifts.joint.mass_kg == pytest.approx(MASS_KG, rel=0.05)
    np.testing.assert_allclose(trend.bare_hz, [pole[0] for pole in POLES], rtol=5e-4)
    assert f"{1000 * trend.shifts.joint.mass_kg:.3g} g" in trend.statement


def test_without_a_mass_nothing_moves() -> None:
    found = extract(loaded_frfs(POINTS, mass_kg=0.0))
    assert all(mode.shift is None for mode in found.modes)
    assert sensor_trend(found.modes, {0: (2, 0), 1: (2, 1)}, found.points, found.references[0]) is None
