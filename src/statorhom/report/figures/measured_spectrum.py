"""Order spectrum of a measured shape: shares of the orders, and their amplitudes plane by plane."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from statorhom.modes.order_spectrum import OrderSpectrum
from statorhom.report.figures.canvas import (
    DIVERGING,
    FAINT,
    FAINT_INK,
    FONT_PT,
    INK,
    PREDICTED,
    SIMULATED,
    new_figure,
    safe,
    tidy,
)

WIDTH_MM, _BARS_MM, _ROW_MM, _MOST_MAP_MM = 120.0, 42.0, 6.0, 60.0
_LABELLED_PERCENT = 1.0
_WRITTEN = 0.05  # of the largest amplitude


def measured_spectrum_plot(
    spectrum: OrderSpectrum, z_m: np.ndarray, title: str = "", statement: str = ""
) -> Figure:
    """Bars of the shares above, a map of planes against orders below.

    Parameters
    ----------
    spectrum : OrderSpectrum
    z_m : ndarray, shape (planes,)
        Axial positions of its planes (m).
    title : str
        Name and frequency of the mode.
    statement : str
        What the points cannot tell (aliases); shown under the title.
    """
    planes = len(z_m)
    figure = new_figure(WIDTH_MM, _BARS_MM + 16 + min(max(planes, 2) * _ROW_MM, _MOST_MAP_MM))
    map_mm = min(max(planes, 2) * _ROW_MM, _MOST_MAP_MM)
    bars, amplitudes = figure.subplots(2, 1, sharex=True, height_ratios=[_BARS_MM - 12, map_mm])
    _bars(bars, spectrum)
    _map(amplitudes, spectrum, z_m)
    figure.suptitle(safe(title, 80), size=FONT_PT + 0.5, color=INK, x=0.01, ha="left", weight="bold")
    bars.set_title(_wrapped(statement), size=FONT_PT - 1.5, color=FAINT_INK, loc="left")
    return figure


def _bars(axes: Axes, spectrum: OrderSpectrum) -> None:
    percent = 100 * spectrum.shares
    colours = [SIMULATED if r == spectrum.dominant_order else FAINT for r in range(percent.size)]
    axes.bar(np.arange(percent.size), percent, 0.7, color=colours)
    if 100 * spectrum.unexplained_share >= 0.05:
        axes.bar(
            percent.size,
            100 * spectrum.unexplained_share,
            0.7,
            color="none",
            edgecolor=PREDICTED,
            hatch="////",
        )
    shown = [*percent, 100 * spectrum.unexplained_share]
    for r, share in enumerate(shown):
        if share >= _LABELLED_PERCENT:
            axes.text(r, share + 2, f"{share:.0f}", size=FONT_PT - 1, color=INK, ha="center")
    axes.set_ylim(0, 115)
    axes.set_yticks([0, 50, 100])
    axes.set_ylabel("share in %")
    tidy(axes, grid="y")
    axes.tick_params(bottom=False, labelbottom=False)


def _map(axes: Axes, spectrum: OrderSpectrum, z_m: np.ndarray) -> None:
    orders = np.arange(spectrum.highest_order + 1)
    values = np.column_stack([spectrum.signed_amplitudes(int(r)) for r in orders])
    relative = values / max(float(np.nanmax(np.abs(values))), np.finfo(float).tiny)
    rows = np.argsort(z_m, kind="stable")
    axes.imshow(
        relative[rows], cmap=DIVERGING, vmin=-1.15, vmax=1.15, aspect="auto", origin="lower",
        extent=(-0.5, orders.size - 0.5, -0.5, rows.size - 0.5), interpolation="none",
    )  # fmt: skip
    for row, column in np.argwhere(np.abs(relative[rows]) >= _WRITTEN):
        value = relative[rows[row], column]
        colour = "white" if abs(value) > 0.6 else INK
        axes.text(column, row, f"{value:+.2f}", size=FONT_PT - 2.5, color=colour, ha="center", va="center")
    axes.set_yticks(range(rows.size), labels=[f"{1000 * z:.3g}" for z in z_m[rows]])
    unexplained = [orders.size] if 100 * spectrum.unexplained_share >= 0.05 else []
    axes.set_xticks([*orders, *unexplained], labels=[*map(str, orders), *(["none"] if unexplained else [])])
    axes.set_xlim(-0.6, orders.size - 0.4 + len(unexplained))
    axes.set_ylabel("plane at z in mm")
    axes.set_xlabel("circumferential order r (amplitudes over the largest)")
    tidy(axes)


def _wrapped(words: str, width: int = 95) -> str:
    lines, line = [], ""
    for word in words.split():
        if line and len(line) + 1 + len(word) > width:
            lines.append(line)
            line = word
        else:
            line = f"{line} {word}".strip()
    return "\n".join([*lines, line])
