"""Complex mode indicator function: singular values of the FRF matrix over frequency."""

from __future__ import annotations

from collections.abc import Sequence

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from statorhom.report.figures.canvas import FONT_PT, INK, PREDICTED, new_figure, tidy

WIDTH_MM, _HEIGHT_MM = 160.0, 72.0
_DECADES = 5.0
_MOST = 4  # further singular values are noise


def cmif_plot(axis_hz: np.ndarray, singular_values: np.ndarray, poles_hz: Sequence[float] = ()) -> Figure:
    """Singular values, the largest first; a doublet is a frequency where two of them peak.

    Parameters
    ----------
    axis_hz : ndarray, shape (lines,)
        Frequencies (Hz).
    singular_values : ndarray, shape (values, lines)
        Of the receptance matrix (m/N), descending in their first axis.
    poles_hz : sequence of float
        Natural frequencies found, marked at the top (Hz).
    """
    figure = new_figure(WIDTH_MM, _HEIGHT_MM)
    axes = figure.subplots()
    shown = singular_values[:_MOST]
    colours = mpl.colormaps["viridis"](np.linspace(0.0, 0.8, len(shown)))
    for number, (values, colour) in enumerate(zip(shown, colours, strict=True), 1):
        axes.plot(
            axis_hz, values, color=colour, linewidth=1.0 if number == 1 else 0.8, label=f"value {number}"
        )
    axes.set_yscale("log")
    positive = shown[np.isfinite(shown) & (shown > 0)]
    if positive.size:
        top = float(positive.max())
        axes.set_ylim(max(float(positive.min()), top * 10**-_DECADES), 3 * top)
    if len(poles_hz):
        axes.plot(
            poles_hz, np.full(len(poles_hz), 0.97), "v", color=PREDICTED, markersize=4,
            transform=axes.get_xaxis_transform(), label="modes found", linestyle="none",
        )  # fmt: skip
    tidy(axes, grid="y")
    axes.minorticks_off()
    axes.set_xlim(float(axis_hz[0]), float(axis_hz[-1]))
    axes.set_xlabel("frequency in Hz")
    axes.set_ylabel("singular values of the\nreceptance matrix in m/N")
    axes.legend(
        fontsize=FONT_PT - 0.5, frameon=False, labelcolor=INK, ncols=_MOST + 1, loc="lower right",
        bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2,
    )  # fmt: skip
    return figure
