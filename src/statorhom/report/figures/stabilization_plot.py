"""Stabilization diagram: poles over the order of the model that found them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from statorhom.report.figures.canvas import FAINT, FONT_PT, INK, PREDICTED, SIMULATED, new_figure, tidy

WIDTH_MM, _HEIGHT_MM = 160.0, 84.0
_BACKGROUND = "#aab4bd"


def stabilization_plot(
    pole_hz: np.ndarray,
    model_order: np.ndarray,
    stable: np.ndarray,
    axis_hz: np.ndarray | None = None,
    indicator: np.ndarray | None = None,
    chosen_hz: Sequence[float] = (),
) -> Figure:
    """Poles of rising model orders before a mode indicator.

    Parameters
    ----------
    pole_hz, model_order : ndarray, shape (poles,)
        Frequency of every pole (Hz), and the order of its model.
    stable : ndarray of bool, shape (poles,)
        Whether frequency and damping stay when the order rises.
    axis_hz, indicator : ndarray, shape (lines,), optional
        A curve that peaks at modes, such as the largest singular value, drawn behind on a logarithmic scale.
    chosen_hz : sequence of float
        Modes that were taken (Hz).
    """
    figure = new_figure(WIDTH_MM, _HEIGHT_MM)
    axes = figure.subplots()
    if axis_hz is not None and indicator is not None:
        behind = axes.twinx()
        behind.plot(axis_hz, indicator, color=_BACKGROUND, linewidth=0.9)
        behind.set_yscale("log")
        behind.axis("off")
        axes.set_zorder(behind.get_zorder() + 1)
        axes.patch.set_visible(False)
        axes.set_xlim(float(axis_hz[0]), float(axis_hz[-1]))
    for frequency in chosen_hz:
        axes.axvline(frequency, color=PREDICTED, linewidth=0.8, alpha=0.7)
    axes.plot(
        pole_hz[~stable],
        model_order[~stable],
        "+",
        color=FAINT,
        markersize=3.5,
        markeredgewidth=0.6,
        label="not stable",
    )
    axes.plot(pole_hz[stable], model_order[stable], "o", color=SIMULATED, markersize=2.6, label="stable")
    if len(chosen_hz):
        axes.plot([], [], color=PREDICTED, linewidth=0.8, label="taken")
    tidy(axes)
    axes.set_xlabel("frequency in Hz")
    axes.set_ylabel("order of the model")
    axes.legend(
        fontsize=FONT_PT - 0.5, frameon=False, labelcolor=INK, ncols=3, loc="lower right",
        bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2,
    )  # fmt: skip
    return figure
