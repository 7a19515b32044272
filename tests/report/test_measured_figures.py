"""Figures of measured modes show what they were given, and bear gaps."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from measured_points import cylinder, radial_values
from statorhom.modes.measured_name import name_measured
from statorhom.modes.measured_shape import measured_shapes
from statorhom.modes.point_layout import lay_out
from statorhom.report.figures.canvas import png
from statorhom.report.figures.cmif_plot import cmif_plot
from statorhom.report.figures.frf_plot import frf_plot
from statorhom.report.figures.measured_spectrum import measured_spectrum_plot
from statorhom.report.figures.nyquist_plot import display_unit, nyquist_plot
from statorhom.report.figures.pole_shift_plot import pole_shift_plot
from statorhom.report.figures.stabilization_plot import stabilization_plot

AXIS = np.linspace(10.0, 2000.0, 300)
FRF = 1 / ((2 * np.pi) ** 2 * (1000.0**2 * (1 + 0.02j) - AXIS**2))


def texts(figure: Figure) -> str:
    figure.draw_without_rendering()
    parts = [t.get_text() for axes in figure.axes for t in axes.findobj(lambda a: hasattr(a, "get_text"))]
    return " ".join(parts)


def lines(figure: Figure, row: int) -> list[np.ndarray]:
    return [np.asarray(line.get_ydata(), dtype=float) for line in figure.axes[row].get_lines()]


def test_frf_with_fit_and_coherence():
    measured = FRF.copy()
    measured[5] = np.nan
    figure = frf_plot(AXIS, measured, FRF, np.ones(AXIS.size), [1000.0], "a$b")
    assert len(figure.axes) == 3
    drawn = lines(figure, 0)
    np.testing.assert_array_equal(drawn[1], np.abs(measured))
    np.testing.assert_array_equal(drawn[2], np.abs(FRF))
    assert "regenerated" in texts(figure)
    assert len(frf_plot(AXIS, FRF).axes) == 2
    assert len(frf_plot(AXIS, FRF, coherence=np.full(AXIS.size, np.nan)).axes) == 2


def test_nyquist_points_lie_on_their_circle():
    mobility_like = 1 / (1 + 1j * (AXIS - 1000.0) / 10)
    figure = nyquist_plot(AXIS, 1e-7 * mobility_like, 0.5e-7, 0.5e-7, 0j, 1000.0, "p = 0.4")
    np.testing.assert_allclose(lines(figure, 1)[1], 0.0, atol=1e-9)
    assert "nm/N" in texts(figure) and "p = 0.4" in texts(figure)


@pytest.mark.parametrize(
    ("size", "letters"), [(2e-6, "µm/N"), (9e-10, "pm/N"), (0.5, "mm/N"), (1e-15, "pm/N")]
)
def test_units_fit_the_size(size, letters):
    assert display_unit(size)[1] == letters


def test_cmif_shows_four_values_at_most_and_marks_the_modes():
    figure = cmif_plot(AXIS, np.abs(FRF) / np.arange(1, 7)[:, None], [1000.0])
    assert len(lines(figure, 0)) == 5
    assert "modes found" in texts(figure)


def test_stabilization_tells_stable_poles():
    stable = np.array([True, False, True])
    figure = stabilization_plot(
        np.array([900.0, 950.0, 1000.0]), np.array([4, 4, 6]), stable, AXIS, np.abs(FRF), [1000.0]
    )
    unstable, kept = lines(figure, 0)[1:3]
    assert unstable.tolist() == [4.0] and kept.tolist() == [4.0, 6.0]


def test_pole_shifts_in_millionths():
    x = np.linspace(0, 345, 24)
    shift = 1e-4 * np.cos(np.radians(2 * x))
    figure = pole_shift_plot(x, shift, np.full(24, 1e-5), 1 - shift, 0.9 * shift, "4.0 g (3.9 … 4.1 g)")
    np.testing.assert_allclose(lines(figure, 0)[-1], 0.9e6 * shift)


def test_spectrum_of_an_incomplete_shape():
    dofs = cylinder(2 * np.pi * np.arange(16) / 16)
    values = radial_values(dofs, lambda a, z: np.cos(2 * a) + 0.3 * np.cos(3 * a) + 0j * z)
    values[[3, 20]] = np.nan
    (shape,) = measured_shapes(lay_out(dofs), values)
    found = name_measured(shape)
    figure = measured_spectrum_plot(found.spectrum, shape.z_m, "(2, 0) at 1432 Hz", found.statement)
    shown = texts(figure)
    assert "92" in shown and "8" in shown  # 1 : 0.3² in per cent
    assert "16 equidistant angles" in shown
    bars = [patch.get_height() for patch in figure.axes[0].patches]
    assert bars[2] == pytest.approx(100 / 1.09) and bars[3] == pytest.approx(9 / 1.09)
    assert png(figure, dpi=40).startswith(b"\x89PNG")
