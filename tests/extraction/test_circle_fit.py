"""The circle fit against the receptance that equation [7] prescribes."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from statorhom.errors import ExtractionError
from statorhom.extraction import circle_fit, regenerate, sdof_model


def receptance(frequency_hz: np.ndarray, modes: list[tuple[float, float, complex]]) -> np.ndarray:
    squared = (2 * np.pi * frequency_hz) ** 2
    total = np.zeros(len(frequency_hz), dtype=complex)
    for natural, loss, constant in modes:
        square = (2 * np.pi * natural) ** 2
        total += constant / (square - squared + 1j * loss * square)
    return total


@settings(max_examples=60, deadline=None)
@given(
    natural=st.floats(990.0, 1010.0),
    loss=st.floats(0.005, 0.05),
    size=st.floats(1e-3, 1e3),
    phase=st.floats(-3.0, 3.0),
    offset=st.floats(0.0, 1.0),
)
def test_one_mode_with_an_offset_is_found_exactly(
    natural: float, loss: float, size: float, phase: float, offset: float
) -> None:
    constant = size * np.exp(1j * phase)
    frequency = np.linspace(975.0, 1025.0, 101)
    peak = size / (loss * (2 * np.pi * natural) ** 2)
    fit = circle_fit(frequency, receptance(frequency, [(natural, loss, constant)]) + offset * peak)
    assert fit.frequency_hz == pytest.approx(natural, rel=1e-8)
    assert fit.loss_factor == pytest.approx(loss, rel=1e-5)
    # the angle at resonance is interpolated between two lines
    assert fit.modal_constant_per_kg == pytest.approx(constant, rel=2e-2)
    assert fit.distortion < 1e-9


def test_modes_and_residuals_regenerate_the_frf() -> None:
    frequency = np.arange(200.0, 2000.0, 0.5)
    exact = receptance(frequency, [(500.0, 0.01, 2.0 + 0j), (1400.0, 0.008, -1.0 + 0j)])
    exact = exact - 0.3 / (2 * np.pi * frequency) ** 2 + 2e-9
    model = sdof_model(frequency, exact, [(495.0, 505.0), (1390.0, 1410.0)])
    assert np.abs(regenerate(model, frequency) - exact).max() < 2e-3 * np.abs(exact).max()
    assert model.mass_line == pytest.approx(-0.3, rel=0.05)
    assert model.stiffness_line == pytest.approx(2e-9, rel=0.2)


@pytest.mark.parametrize("lines", [3, 40])
def test_lines_without_a_resonance_are_refused(lines: int) -> None:
    frequency = np.linspace(700.0, 720.0, lines)
    with pytest.raises(ExtractionError):
        circle_fit(frequency, receptance(frequency, [(1000.0, 0.01, 1.0 + 0j)]))
