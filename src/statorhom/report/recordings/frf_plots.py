"""Plots of a test's FRFs: measured and regenerated, stabilization, circles."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.figure import Figure

from statorhom.errors import IdentificationError
from statorhom.extraction.cmif import cmif
from statorhom.extraction.measured_modes import MeasuredModes
from statorhom.extraction.point_grid import point_grid
from statorhom.modes.nonlinearity.circle_distortion import circle_distortion
from statorhom.modes.nonlinearity.mode_lines import lines_around
from statorhom.recordings.dof import Dof
from statorhom.report.figures.cmif_plot import cmif_plot
from statorhom.report.figures.frf_plot import frf_plot
from statorhom.report.figures.nyquist_plot import nyquist_plot
from statorhom.report.figures.stabilization_plot import stabilization_plot


def frf_plots(measured: MeasuredModes) -> Iterator[tuple[str, Figure]]:
    """The strongest FRF of every reference with its regenerated one and its coherence."""
    frfs = measured.frf_sets[0]
    regenerated = measured.extraction.regenerate(frfs.frequency_hz)[: len(frfs)]
    level = np.nanmedian(np.abs(frfs.accelerance), axis=1)
    poles = [one.mode.frequency_hz for one in measured.modes]
    low, high = measured.extraction.band_hz
    shown = (frfs.frequency_hz >= low) & (frfs.frequency_hz <= high)
    for number, reference in enumerate(dict.fromkeys(frfs.references), start=1):
        rows = [i for i, one in enumerate(frfs.references) if one == reference]
        row = rows[int(np.argmax(level[rows]))]
        title = f"{_place(frfs.responses[row])} over force at {_place(reference)}"
        coherence = None if frfs.coherence is None else frfs.coherence[row, shown]
        yield (
            f"frf-{number:02d}.png",
            frf_plot(
                frfs.frequency_hz[shown],
                frfs.receptance[row, shown],
                regenerated[row, shown],
                coherence,
                poles,
                title,
            ),
        )


def stabilization(measured: MeasuredModes) -> Figure:
    """Poles of rising model orders over the sum of all FRFs."""
    diagram, frfs = measured.extraction.stabilization, measured.frf_sets[0]
    low, high = measured.extraction.band_hz
    shown = (frfs.frequency_hz >= low) & (frfs.frequency_hz <= high)
    total = np.sqrt(np.nansum(np.abs(frfs.accelerance[:, shown]) ** 2, axis=0))
    chosen = [one.mode.frequency_hz for one in measured.modes]
    return stabilization_plot(
        diagram.frequency_hz, diagram.order, diagram.stable, frfs.frequency_hz[shown], total, chosen
    )


def indicator(measured: MeasuredModes) -> Figure:
    """Complex mode indication function."""
    grid = point_grid(measured.frf_sets)
    poles = [one.mode.frequency_hz for one in measured.modes]
    return cmif_plot(grid.omega / (2 * np.pi), cmif(grid), poles)


def nyquist_plots(measured: MeasuredModes) -> Iterator[tuple[str, Figure]]:
    """The circle of every mode in the FRF that shows it best."""
    frfs = measured.frf_sets[0]
    receptance = frfs.receptance
    poles = [(one.mode.frequency_hz, one.mode.loss_factor) for one in measured.modes]
    for number, (frequency, loss) in enumerate(poles, start=1):
        row = int(np.nanargmax(np.abs(receptance[:, np.argmin(np.abs(frfs.frequency_hz - frequency))])))
        neighbours = [pole for i, pole in enumerate(poles, start=1) if i != number]
        try:
            near = lines_around(frfs.frequency_hz, receptance[row], frequency, loss)
            circle = circle_distortion(frfs.frequency_hz, receptance[row], frequency, loss)
        except IdentificationError:
            continue  # too few lines for a circle
        note = f"node {frfs.responses[row].node}: {100 * circle.distortion:.1f} % beyond noise"
        if _close(frequency, loss, neighbours):
            note += "; another mode is close"
        yield (
            f"circle-{number:02d}.png",
            nyquist_plot(
                near.axis_hz,
                near.frf,
                circle.centre,
                circle.radius,
                circle.drift / (loss * frequency),
                frequency,
                note,
            ),
        )


def _close(frequency: float, loss: float, others: list[tuple[float, float]]) -> bool:
    return any(abs(other - frequency) < 3 * loss * frequency for other, _ in others)


def _place(dof: Dof) -> str:
    if dof.position is None or dof.angle is None:
        return f"node {dof.node}"
    return f"node {dof.node} ({np.degrees(dof.angle):.0f}°, z = {1000 * dof.position[2]:.0f} mm)"
