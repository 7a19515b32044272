"""The Pareto front of a search: which modes can be met better only at the expense of others."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.report.figures.canvas import PREDICTED, SIMULATED, new_figure, safe, svg, tidy

_WIDTH_MM, _ROW_MM = 50.0, 48.0
_MOST = 6  # pairs of modes that are drawn
_COLUMNS = 3


def pareto_plot(objectives: Sequence[str], front: Sequence[Sequence[float]]) -> bytes:
    """SVG: relative errors of pairs of modes, one dot per point of the front, the best compromise marked.

    Parameters
    ----------
    objectives : names of the modes.
    front : (k, m) errors in per cent.
    """
    values = np.array(front, dtype=float).reshape(-1, len(objectives))
    pairs = _contested(values)[:_MOST]
    columns = min(_COLUMNS, len(pairs))
    rows = -(-len(pairs) // columns)
    figure = new_figure(_WIDTH_MM * columns, _ROW_MM * rows)
    grid = figure.subplots(rows, columns, squeeze=False).ravel()
    best = int(np.argmin(np.sum(values**2, axis=1)))
    for axes, (i, j) in zip(grid, pairs, strict=False):
        axes.plot(
            values[:, i], values[:, j], "o", color=SIMULATED, markersize=2.5, markeredgewidth=0, clip_on=False
        )
        axes.plot(
            values[best, i],
            values[best, j],
            "o",
            markersize=7,
            markerfacecolor="none",
            color=PREDICTED,
            clip_on=False,
        )
        tidy(axes, grid="both")
        axes.set_xlim(left=0.0)
        axes.set_ylim(bottom=0.0)
        axes.set_xlabel(f"error of {safe(objectives[i])} in %")
        axes.set_ylabel(f"error of {safe(objectives[j])} in %")
    for axes in grid[len(pairs) :]:
        axes.axis("off")
    return svg(figure)


def pareto_width(count: int) -> float:
    """Width on paper (mm) of the plot of a number of modes."""
    return _WIDTH_MM * min(_COLUMNS, max(1, count * (count - 1) // 2))


def _contested(values: np.ndarray) -> list[tuple[int, int]]:
    """Pairs of modes, those first whose errors move most against each other along the front."""
    count = values.shape[1]
    pairs = [(i, j) for i in range(count) for j in range(i + 1, count)]
    spread = values.std(axis=0)

    def contest(pair: tuple[int, int]) -> float:
        i, j = pair
        return (
            -float(np.mean((values[:, i] - values[:, i].mean()) * (values[:, j] - values[:, j].mean())))
            if (spread[i] and spread[j])
            else -np.inf
        )

    return sorted(pairs, key=contest, reverse=True)
