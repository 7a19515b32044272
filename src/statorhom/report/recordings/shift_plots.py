"""Plots of the poles that a roving sensor's mass moves."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.figure import Figure

from statorhom.extraction.measured_modes import MeasuredModes
from statorhom.report.figures.pole_shift_plot import pole_shift_plot


def shift_plots(measured: MeasuredModes) -> Iterator[tuple[str, Figure]]:
    """Shifts of every mode over the places of the sensor, and what its mass explains of them."""
    trend = measured.sensor
    if trend is None:
        return
    angles = np.degrees([point.angle or 0.0 for point in measured.extraction.points])
    joint = trend.shifts.joint
    low, high = (1000 * one for one in joint.ci90_kg)
    for i, number in enumerate(trend.modes):
        note = f"sensor {1000 * joint.mass_kg:.3g} g ({low:.3g} … {high:.3g} g); without it {trend.bare_hz[i]:.2f} Hz"
        figure = pole_shift_plot(
            angles,
            trend.shifts.observed[:, i],
            trend.relative_sd[:, i],
            trend.amplitude_squared[:, i],
            trend.shifts.predicted[:, i],
            note,
        )
        yield f"shift-{1 + number:02d}.png", figure
