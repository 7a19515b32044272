"""Nyquist plot of a mode with its best circle, and the distances from it."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from statorhom.report.figures.canvas import (
    FAINT,
    FONT_PT,
    INK,
    MEASURED,
    PREDICTED,
    SIMULATED,
    new_figure,
    tidy,
)

WIDTH_MM, _HEIGHT_MM = 150.0, 72.0
_UNITS = ((1e-3, "mm/N"), (1e-6, "µm/N"), (1e-9, "nm/N"), (1e-12, "pm/N"))


def nyquist_plot(
    axis_hz: np.ndarray,
    receptance: np.ndarray,
    centre: complex,
    radius: float,
    drift_per_hz: complex,
    frequency_hz: float,
    note: str = "",
) -> Figure:
    """Receptance around one mode in the complex plane, and each line's distance from the circle.

    Parameters
    ----------
    axis_hz, receptance : ndarray, shape (lines,)
        Lines that were fitted (Hz, m/N).
    centre, radius : complex, float
        The circle at the natural frequency (m/N).
    drift_per_hz : complex
        Change of its centre with frequency (m/N/Hz), which other modes cause; it is taken off the points.
    frequency_hz : float
        Natural frequency (Hz).
    note : str
        What the fit says, in one line under the distances' title.
    """
    figure = new_figure(WIDTH_MM, _HEIGHT_MM)
    left, right = figure.subplots(1, 2, width_ratios=[1, 1.25])
    unit, letters = display_unit(radius)
    points = (receptance - drift_per_hz * (axis_hz - frequency_hz)) / unit
    _circle(left, axis_hz, points, centre / unit, radius / unit, frequency_hz)
    left.set_xlabel(f"real part in {letters}")
    left.set_ylabel(f"imaginary part in {letters}")
    distance = 100 * (np.abs(points - centre / unit) * unit / radius - 1)
    right.axhline(0, color=SIMULATED, linewidth=1)
    right.plot(axis_hz, distance, "o-", color=MEASURED, markersize=2.5, linewidth=0.6)
    right.axvline(frequency_hz, color=FAINT, linewidth=0.6, linestyle=(0, (4, 2)))
    tidy(right, grid="y")
    right.set_xlabel("frequency in Hz")
    right.set_ylabel("distance from the circle\nin % of its radius")
    right.set_title(note, size=FONT_PT - 0.5, color=INK, loc="left")
    return figure


def display_unit(size: float) -> tuple[float, str]:
    """Unit in which a receptance has one to four digits before the point."""
    return next(((unit, letters) for unit, letters in _UNITS if abs(size) >= unit), _UNITS[-1])


def _circle(
    axes: Axes, axis_hz: np.ndarray, points: np.ndarray, centre: complex, radius: float, frequency_hz: float
) -> None:
    turn = np.linspace(0, 2 * np.pi, 181)
    circle = centre + radius * np.exp(1j * turn)
    axes.plot(circle.real, circle.imag, color=SIMULATED, linewidth=1, label="circle")
    axes.plot(points.real, points.imag, "o", color=MEASURED, markersize=2.5, label="measured")
    nearest = points[int(np.argmin(np.abs(axis_hz - frequency_hz)))]
    axes.plot(
        nearest.real, nearest.imag, "D", color=PREDICTED, markersize=4.5, label=f"{frequency_hz:.1f} Hz"
    )
    axes.axhline(0, color=FAINT, linewidth=0.5)
    axes.axvline(0, color=FAINT, linewidth=0.5)
    axes.set_aspect("equal", adjustable="datalim")
    axes.locator_params(nbins=5)
    tidy(axes)
    axes.legend(
        fontsize=FONT_PT - 1, frameon=False, labelcolor=INK, ncols=3, loc="lower center",
        bbox_to_anchor=(0.5, 1.0), handletextpad=0.3, columnspacing=1.0,
    )  # fmt: skip
