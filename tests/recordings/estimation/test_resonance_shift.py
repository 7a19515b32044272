"""Trends with the force level, against FRFs whose poles were moved by known amounts."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from statorhom.errors import RecordingError
from statorhom.recordings.dof import Dof
from statorhom.recordings.estimation.resonance_shift import resonance_shift
from statorhom.recordings.frf_set import FrfSet

LINES = np.arange(1300.0, 1560.0, 0.5)
NATURAL, DAMPING = 1432.0, 0.004
DOFS = tuple(Dof(node) for node in range(1, 7))
CONSTANTS = np.linspace(-0.6, 0.9, 6)
LEVELS = (5.0, 20.0, 80.0)


def frfs(natural_hz: float, damping: float, noise: float = 0.0, seed: int = 0) -> FrfSet:
    ratio = LINES / natural_hz
    values = -CONSTANTS[:, np.newaxis] * ratio**2 / (1 - ratio**2 + 2j * damping * ratio)
    rng = np.random.default_rng(seed)
    size = noise * np.abs(values).max()
    values = values + size * (rng.standard_normal(values.shape) + 1j * rng.standard_normal(values.shape))
    return FrfSet(LINES, DOFS, (Dof(901),) * 6, values)


def series(of_frequency: float, of_damping: float, noise: float = 0.0, seed: int = 0) -> list[FrfSet]:
    """FRFs at the levels, from slopes per factor of ten."""
    decades = np.log10(np.array(LEVELS) / LEVELS[0])
    return [
        frfs(NATURAL * (1 + of_frequency * d), DAMPING + of_damping * d, noise, seed + i)
        for i, d in enumerate(decades)
    ]


@given(of_frequency=st.floats(-5e-4, 5e-4), of_damping=st.floats(0.0, 5e-4))
def test_slopes_of_frequency_and_damping_are_recovered(of_frequency: float, of_damping: float) -> None:
    trend = resonance_shift(series(of_frequency, of_damping), LEVELS, NATURAL, 40.0)
    assert trend.frequency_slope == pytest.approx(of_frequency, rel=0.1, abs=3e-5)
    assert trend.damping_slope == pytest.approx(of_damping, rel=0.1, abs=3e-5)


def test_a_linear_structure_has_no_trend_beyond_its_sd() -> None:
    trends = [resonance_shift(series(0.0, 0.0, 0.01, 10 * seed), LEVELS, NATURAL, 40.0) for seed in range(60)]
    normalized = np.array([[t.frequency_slope / t.slope_sd, t.damping_slope / t.slope_sd] for t in trends])
    assert np.abs(normalized.mean()) < 0.3
    assert normalized.std() == pytest.approx(1.0, rel=0.25)


def test_a_trend_is_seen_through_noise_whatever_the_order_of_levels() -> None:
    sets = series(-5e-4, 3e-4, 0.01)
    up = resonance_shift(sets, LEVELS, NATURAL, 40.0)
    down = resonance_shift(sets[::-1], LEVELS[::-1], NATURAL, 40.0)
    assert up.frequency_slope < -5 * up.slope_sd
    assert up.damping_slope > 5 * up.slope_sd
    assert down.frequency_slope == pytest.approx(up.frequency_slope)
    assert down.frequency_shift == pytest.approx(up.frequency_shift[::-1])


def test_series_that_do_not_match_are_refused() -> None:
    sets = series(0.0, 0.0)
    other = FrfSet(LINES + 1.0, DOFS, sets[0].references, sets[0].accelerance.copy(), source="b.uff")
    for wrong, levels in (
        ([sets[0]], [5.0]),
        (sets, [5.0, 5.0, 5.0]),
        (sets, [5.0, 10.0]),
        (sets, [-5.0, 1.0, 2.0]),
    ):
        with pytest.raises(RecordingError, match="level series needs"):
            resonance_shift(wrong, levels, NATURAL, 40.0)
    with pytest.raises(RecordingError, match=r"b\.uff: the levels"):
        resonance_shift([sets[0], other], [1.0, 2.0], NATURAL, 40.0)
    with pytest.raises(RecordingError, match="lines lie within"):
        resonance_shift(sets, LEVELS, 99.0, 40.0)
