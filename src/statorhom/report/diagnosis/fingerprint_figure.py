"""What the declared model leaves of every measured feature, and what the explanation leaves."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.report.document import Picture
from statorhom.report.figures.canvas import FONT_PT, INK, PREDICTED, SIMULATED, new_figure, svg, tidy
from statorhom.results.diagnosis import FeatureRow

WORDS = {"frequency": "frequency", "split": "split of the doublet", "shift": "shift of the pole"}
MOST = 40


def fingerprint_figure(rows: Sequence[FeatureRow]) -> Picture:
    """Bars in standard deviations on a scale that is linear up to three of them."""
    shown = [r for r in rows if r.sd < 0.5][:MOST]
    figure = new_figure(170, 14 + 4.2 * max(len(shown), 3))
    axes = figure.subplots()
    places = np.arange(len(shown))[::-1]
    for offset, colour, side in ((0.18, PREDICTED, "before"), (-0.18, SIMULATED, "after")):
        values = [(getattr(r, side) - r.measured) / r.sd for r in shown]
        axes.barh(places + offset, values, height=0.32, color=colour, label=side)
    axes.set_xscale("symlog", linthresh=3.0)
    axes.axvspan(-2, 2, color="#eef2f5", zorder=0)
    axes.axvline(0, color=INK, linewidth=0.6)
    axes.set_yticks(places, [_label(r) for r in shown])
    axes.set_xlabel("predicted minus measured, in standard deviations")
    axes.legend(fontsize=FONT_PT - 0.5, frameon=False, loc="best")
    tidy(axes, "x")
    alt = "bars of what the model leaves of every measured feature, before and after the effect is modelled"
    return Picture(svg(figure), "svg", 170.0, alt)


def _label(row: FeatureRow) -> str:
    name = "" if row.mode is None else f"({row.mode[0]}, {row.mode[1]}) "
    return f"{row.test[:24]} {name}{WORDS.get(row.kind, row.kind)}"
