"""Which constant moves which mode: a map of ∂ln f / ∂ln p."""

from __future__ import annotations

import numpy as np
from matplotlib.colors import PowerNorm

from statorhom.report.figures.canvas import FONT_PT, INK, new_figure, safe, svg, tidy
from statorhom.report.wording import constant_formula
from statorhom.results import Sensitivity

_CELL_MM = (17.5, 5.6)
_LABELS_MM = (42.0, 24.0)
_WIDEST_MM, _HIGHEST_MM = 170.0, 230.0
_DARK = 0.5  # above this part of the largest value letters turn white
# small sensitivities matter: they decide what cannot be told
_CONTRAST = 0.5


def sensitivity_width(sensitivity: Sensitivity) -> float:
    """Width of the map on paper (mm)."""
    return min(_LABELS_MM[0] + _CELL_MM[0] * len(sensitivity.constants), _WIDEST_MM)


def sensitivity_map(sensitivity: Sensitivity) -> bytes:
    """SVG: a row per mode, a column per constant, the absolute value as colour and the value as figure."""
    values = np.array(sensitivity.values, dtype=float).reshape(
        len(sensitivity.modes), len(sensitivity.constants)
    )
    height = min(_LABELS_MM[1] + _CELL_MM[1] * len(sensitivity.modes), _HIGHEST_MM)
    figure = new_figure(sensitivity_width(sensitivity), height)
    axes = figure.subplots()
    largest = max(float(np.abs(values).max(initial=0.0)), 1e-9)
    axes.pcolormesh(
        np.abs(values), cmap="Blues", norm=PowerNorm(_CONTRAST, 0.0, largest), edgecolors="white", linewidth=1
    )
    for (row, column), value in np.ndenumerate(values):
        dark = (abs(value) / largest) ** _CONTRAST > 1.25 * _DARK
        axes.text(
            column + 0.5, row + 0.5, f"{value:.3f}".replace("-", "−"), ha="center", va="center",
            fontsize=FONT_PT - 1, color="white" if dark else INK,
        )  # fmt: skip
    tidy(axes)
    axes.set_xticks(
        np.arange(len(sensitivity.constants)) + 0.5, labels=[_column(c) for c in sensitivity.constants]
    )
    axes.set_yticks(np.arange(len(sensitivity.modes)) + 0.5, labels=[safe(m) for m in sensitivity.modes])
    axes.xaxis.tick_top()
    axes.invert_yaxis()
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)
    return svg(figure)


def _column(constant: str) -> str:
    region, dot, name = constant.rpartition(".")
    symbol = constant_formula(name) or safe(name)
    return f"{safe(region, 14)}\n{symbol}" if dot else symbol
