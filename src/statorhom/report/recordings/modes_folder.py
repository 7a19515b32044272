"""Write the modes of a test into a folder: modal table, shapes and plots."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from statorhom.extraction.measured_modes import MeasuredModes, NamedMode
from statorhom.extraction.modal_table_text import modal_table, table_text
from statorhom.recordings.mode_shape import ModeShape
from statorhom.recordings.recording import Node, Recording
from statorhom.recordings.uff.writer import write_uff
from statorhom.report.figures.canvas import png
from statorhom.report.figures.measured_spectrum import measured_spectrum_plot
from statorhom.report.figures.shape_animation import animate_shape
from statorhom.report.recordings.frf_plots import frf_plots, indicator, nyquist_plots, stabilization
from statorhom.report.recordings.shift_plots import shift_plots
from statorhom.results.files import check_folder
from statorhom.study.atomic import write_bytes, write_text

TABLE, SHAPES, PLOTS = "modes.csv", "shapes.uff", "plots"
DPI = 150

Progress = Callable[[int], None]


def write_modes(measured: MeasuredModes, folder: Path, progress: Progress | None = None) -> tuple[Path, ...]:
    """Write modes.csv, shapes.uff and plots/ into a folder.

    Parameters
    ----------
    measured : MeasuredModes
    folder : Path
        Made where missing; files of earlier runs are replaced one by one.
    progress : callable, optional
        Told how many pictures are drawn.

    Returns
    -------
    tuple of Path
        The table, the shapes and the folder of plots.

    Raises
    ------
    StatorhomError
        Where something cannot be written.
    """
    check_folder(folder)
    table, shapes, plots = folder / TABLE, folder / SHAPES, folder / PLOTS
    write_text(table, table_text(modal_table(measured, table), measured.remarks))
    write_uff(shapes, _shapes(measured))
    for number, (name, content) in enumerate(_pictures(measured), start=1):
        write_bytes(plots / name, content)
        if progress is not None:
            progress(number)
    return table, shapes, plots


def picture_count(measured: MeasuredModes) -> int:
    """How many pictures `write_modes` draws at most."""
    shown = sum(one.shape is not None for one in measured.modes)
    moved = 0 if measured.sensor is None else len(measured.sensor.modes)
    return len(measured.extraction.references) + 2 + len(measured.modes) + 2 * shown + moved


def mode_title(one: NamedMode) -> str:
    """Name and frequency of a mode, as pictures are headed."""
    frequency = f"{one.mode.frequency_hz:.2f} Hz, loss factor {100 * one.mode.loss_factor:.2g} %"
    return frequency if one.order is None else f"({one.order}, {_figure(one.axial)}) at {frequency}"


def _figure(axial: int | None) -> str:
    return "?" if axial is None else str(axial)


def _pictures(measured: MeasuredModes) -> Iterator[tuple[str, bytes]]:
    for name, figure in frf_plots(measured):
        yield name, png(figure, DPI)
    yield "stabilization.png", png(stabilization(measured), DPI)
    yield "cmif.png", png(indicator(measured), DPI)
    for name, figure in nyquist_plots(measured):
        yield name, png(figure, DPI)
    for name, figure in shift_plots(measured):
        yield name, png(figure, DPI)
    for number, one in enumerate(measured.modes, start=1):
        if one.shape is None or one.name is None or one.name.spectrum is None:
            continue
        title = mode_title(one)
        spectrum = measured_spectrum_plot(one.name.spectrum, one.shape.z_m, title, one.name.statement)
        yield f"orders-{number:02d}.png", png(spectrum, DPI)
        yield f"shape-{number:02d}.gif", animate_shape(one.shape, title)


def _shapes(measured: MeasuredModes) -> Recording:
    """Shapes per node; a node's directions add up to its displacement."""
    points = measured.extraction.points
    numbers = tuple(sorted({point.node for point in points}))
    row = {number: i for i, number in enumerate(numbers)}
    nodes = {p.node: Node(p.node, p.position) for p in points if p.position is not None}
    shapes = []
    for one in measured.modes:
        displacement = np.zeros((len(numbers), 3), dtype=complex)
        for point, value in zip(points, one.mode.shape, strict=True):
            if point.direction is not None:
                displacement[row[point.node]] += value * np.asarray(point.direction)
        shapes.append(ModeShape(one.mode.frequency_hz, one.mode.damping_ratio, numbers, displacement))
    return Recording("statorhom modes", shapes=tuple(shapes), nodes=tuple(nodes.values()))
