"""Pole shifts from set-up to set-up, over the grid and against the local motion of the mode."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from statorhom.report.figures.canvas import FAINT, FONT_PT, INK, MEASURED, SIMULATED, new_figure, tidy

WIDTH_MM, _HEIGHT_MM = 160.0, 66.0


def pole_shift_plot(
    angle_deg: np.ndarray,
    shift: np.ndarray,
    shift_sd: np.ndarray,
    amplitude_squared: np.ndarray,
    predicted: np.ndarray,
    note: str = "",
) -> Figure:
    """Relative frequency shifts of one mode and what a sensor's mass explains of them.

    Parameters
    ----------
    angle_deg : ndarray, shape (set-ups,)
        Angle of each set-up's point (°).
    shift, shift_sd : ndarray, shape (set-ups,)
        Measured relative shifts from their mean, and their standard deviations; NaN is left out.
    amplitude_squared : ndarray, shape (set-ups,)
        Squared mass-normalised amplitude at the point (1/kg).
    predicted : ndarray, shape (set-ups,)
        Relative shifts that the mass explains.
    note : str
        The mass and its interval, or why there is none.
    """
    figure = new_figure(WIDTH_MM, _HEIGHT_MM)
    left, right = figure.subplots(1, 2, sharey=True, width_ratios=[1.4, 1])
    for axes, x in ((left, angle_deg), (right, amplitude_squared)):
        order = np.argsort(x, kind="stable")
        axes.axhline(0, color=FAINT, linewidth=0.6)
        axes.errorbar(
            x, 1e6 * shift, 1e6 * shift_sd, fmt="o", color=MEASURED, markersize=2.8, elinewidth=0.6,
            label="measured ± standard deviation",
        )  # fmt: skip
        axes.plot(
            x[order], 1e6 * predicted[order], "x", color=SIMULATED, markersize=4, markeredgewidth=1.0,
            label="from the mass",
        )  # fmt: skip
        tidy(axes, grid="y")
    left.set_ylabel("relative shift of the\nfrequency in 10⁻⁶")
    left.set_xlabel("angle of the point in °")
    left.set_xlim(-8, 368)
    left.set_xticks(range(0, 361, 60))
    right.set_xlabel("squared amplitude at the point in 1/kg")
    figure.suptitle(note, size=FONT_PT, color=INK, x=0.01, ha="left")
    figure.legend(
        *left.get_legend_handles_labels(), fontsize=FONT_PT - 0.5, frameon=False, labelcolor=INK, ncols=2,
        loc="outside lower center",
    )  # fmt: skip
    return figure
