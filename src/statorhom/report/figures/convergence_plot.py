"""Frequency of a mode on finer and finer meshes, against the extrapolated one."""

from __future__ import annotations

from collections.abc import Sequence

import matplotlib as mpl
from matplotlib.colors import to_hex
from matplotlib.lines import Line2D

from statorhom.report.figures.canvas import FONT_PT, INK, new_figure, safe, svg, tidy
from statorhom.results import Convergence

WIDTH_MM = 120.0
_HEIGHT_MM = 58.0
_CLOSEST = 1.35
_LEGEND_ROWS = 10
_OPPOSITE = (0, (3, 1.5))


def convergence_plot(series: Sequence[Convergence]) -> bytes:
    """SVG: relative distance from the extrapolated frequency over the degrees of freedom.

    Modes of one order share a colour, for a wound stator has many; those of odd n are dashed.
    """
    figure = new_figure(WIDTH_MM, _HEIGHT_MM)
    axes = figure.subplots()
    colours = _colours(series)
    for c in series:
        excess = [100 * (f / c.extrapolated_hz - 1) for f in c.frequency_hz]
        axes.plot(
            c.dof, excess, marker="o", markersize=3, linewidth=1, color=colours[_order(c)],
            linestyle=_OPPOSITE if (c.axial or 0) % 2 else "solid",
        )  # fmt: skip
    axes.axhline(0.0, color=INK, linewidth=0.7)
    axes.set_xscale("log")
    tidy(axes, grid="y")
    ticks = _ticks({n for c in series for n in c.dof})
    axes.set_xticks(ticks, labels=[f"{n / 1000:.0f} 000" if n >= 1000 else str(n) for n in ticks])
    axes.minorticks_off()
    axes.set_xlabel("degrees of freedom of the whole model")
    axes.set_ylabel("above the extrapolated\nfrequency in %")
    axes.legend(
        handles=[Line2D([], [], color=colour, label=order) for order, colour in colours.items()],
        ncols=1 + (len(colours) - 1) // _LEGEND_ROWS, fontsize=FONT_PT - 0.5, frameon=False, labelcolor=INK,
        loc="center left", bbox_to_anchor=(1.0, 0.5),
    )  # fmt: skip
    return svg(figure)


def _order(mode: Convergence) -> str:
    if mode.order is None:
        # a colour per kind of motion, whatever its nodal lines
        return safe((mode.kind or "").partition(" (")[0]) or "no name"
    return f"r = {mode.order}"


def _colours(series: Sequence[Convergence]) -> dict[str, str]:
    orders = [_order(c) for c in sorted(series, key=lambda c: -1 if c.order is None else c.order)]
    names = list(dict.fromkeys(orders))
    palette = mpl.colormaps["viridis"]
    return {name: to_hex(palette(0.85 * i / max(len(names) - 1, 1))) for i, name in enumerate(names)}


def _ticks(dof: set[int]) -> list[int]:
    """Sizes of the meshes, without those too close to a smaller one for their labels."""
    ticks: list[int] = []
    for n in sorted(dof):
        if not ticks or n > _CLOSEST * ticks[-1]:
            ticks.append(n)
    return ticks
