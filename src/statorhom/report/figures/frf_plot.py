"""A measured FRF with the regenerated one, its phase and its coherence."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from statorhom.report.figures.canvas import (
    DATA,
    FAINT,
    FONT_PT,
    INK,
    MEASURED,
    PREDICTED,
    new_figure,
    safe,
    tidy,
)

WIDTH_MM, _HEIGHT_MM, _COHERENCE_MM = 160.0, 88.0, 20.0


def frf_plot(
    axis_hz: np.ndarray,
    receptance: np.ndarray,
    regenerated: np.ndarray | None = None,
    coherence: np.ndarray | None = None,
    poles_hz: Sequence[float] = (),
    title: str = "",
) -> Figure:
    """Magnitude, phase and, where it was measured, coherence over frequency.

    Parameters
    ----------
    axis_hz : ndarray, shape (lines,)
        Frequencies (Hz).
    receptance, regenerated : ndarray of complex, shape (lines,)
        Measured and fitted receptance (m/N); NaN is left out.
    coherence : ndarray, shape (lines,), optional
    poles_hz : sequence of float
        Natural frequencies, marked by thin lines (Hz).
    title : str
        Pair of points.
    """
    with_coherence = coherence is not None and bool(np.isfinite(coherence).any())
    figure = new_figure(WIDTH_MM, _HEIGHT_MM + (_COHERENCE_MM if with_coherence else 0))
    rows = figure.subplots(
        3 if with_coherence else 2, 1, sharex=True, height_ratios=[3, 1.4, 1][: 2 + with_coherence]
    )
    for axes in rows:
        for pole in poles_hz:
            axes.axvline(pole, color=FAINT, linewidth=0.5, linestyle=(0, (1, 2)))
    _curves(rows[0], axis_hz, np.abs(receptance), None if regenerated is None else np.abs(regenerated))
    rows[0].set_yscale("log")
    rows[0].set_ylabel("receptance in m/N")
    rows[0].set_title(safe(title, 80), size=FONT_PT, color=INK, loc="left")
    _curves(rows[1], axis_hz, _degrees(receptance), None if regenerated is None else _degrees(regenerated))
    rows[1].set_ylim(-190, 190)
    rows[1].set_yticks([-180, -90, 0, 90, 180])
    rows[1].set_ylabel("phase in °")
    if with_coherence:
        assert coherence is not None
        rows[2].plot(axis_hz, coherence, color=DATA, linewidth=0.8)
        rows[2].set_ylim(0, 1.05)
        rows[2].set_yticks([0, 0.5, 1])
        rows[2].set_ylabel("coherence")
    for axes in rows:
        tidy(axes, grid="y")
        axes.minorticks_off()
    rows[-1].set_xlabel("frequency in Hz")
    rows[-1].set_xlim(float(axis_hz[0]), float(axis_hz[-1]))
    if regenerated is not None:
        rows[0].legend(
            fontsize=FONT_PT - 0.5, frameon=False, labelcolor=INK, ncols=2, loc="lower right",
            bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2,
        )  # fmt: skip
    return figure


def _curves(axes: Axes, axis_hz: np.ndarray, measured: np.ndarray, fitted: np.ndarray | None) -> None:
    axes.plot(axis_hz, measured, color=MEASURED, linewidth=0.9, label="measured")
    if fitted is not None:
        axes.plot(
            axis_hz, fitted, color=PREDICTED, linewidth=0.9, linestyle=(0, (4, 1.5)), label="regenerated"
        )


def _degrees(values: np.ndarray) -> np.ndarray:
    """Phase with gaps where it jumps over ± 180°, which are no motion of the curve."""
    phase = np.degrees(np.angle(values))
    phase[1:][np.abs(np.diff(phase)) > 180] = np.nan
    return phase
