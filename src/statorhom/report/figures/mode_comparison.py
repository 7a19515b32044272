"""Measured and simulated frequencies of one test: a ladder of both, and the errors with their uncertainty."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from statorhom.report.figures.canvas import (
    FAINT,
    FONT_PT,
    INK,
    MEASURED,
    PREDICTED,
    SIMULATED,
    new_figure,
    safe,
    svg,
    tidy,
)
from statorhom.report.wording import short_name
from statorhom.results import ModeResult

WIDTH_MM = 170.0
NORMAL_90 = 1.645  # half-width of a normal distribution's 90 % interval in standard deviations
_LABEL_SPACING_MM = 3.3
_FRAME_MM = 16.0  # of the picture's height, above and below the ladder


def mode_comparison(modes: Sequence[ModeResult]) -> bytes:
    """SVG of a test's modes; those without a partner stand on the ladder alone."""
    pairs = [m for m in modes if m.measured_hz is not None and m.simulated_hz is not None]
    pairs.sort(key=lambda m: m.measured_hz or 0.0)
    height = min(max(58.0, 22.0 + 6.5 * max(len(pairs), len(modes) * 0.7)), 150.0)
    figure = new_figure(WIDTH_MM, height)
    ladder, errors = figure.subplots(1, 2, width_ratios=(1.0, 1.15))
    _draw_ladder(ladder, modes, _LABEL_SPACING_MM / (height - _FRAME_MM))
    _draw_errors(errors, pairs)
    return svg(figure)


def error_half_width(mode: ModeResult) -> float | None:
    """Half of the 90 % interval that measurement and model leave the error, in percent."""
    deviations = [sd for sd in (mode.measured_sd_hz, mode.model_sd_hz) if sd is not None]
    if not deviations or not mode.measured_hz:
        return None
    return NORMAL_90 * 100 * math.hypot(*deviations) / mode.measured_hz


def _colour(mode: ModeResult) -> str:
    return {"fitted": SIMULATED, "held_out": PREDICTED}.get(mode.role, FAINT)


def _draw_ladder(axes: Axes, modes: Sequence[ModeResult], spacing: float) -> None:
    labels: list[tuple[float, str, str]] = []
    for mode in modes:
        f, g = mode.measured_hz, mode.simulated_hz
        if f is not None:
            axes.plot([0.0, 1.0], [f, f], color=MEASURED, linewidth=1.6, solid_capstyle="butt")
        if g is not None:
            axes.plot([2.0, 3.0], [g, g], color=_colour(mode), linewidth=1.6, solid_capstyle="butt")
            labels.append((g, safe(short_name(mode)), _colour(mode)))
        elif f is not None:
            axes.annotate("no partner", (1.06, f), fontsize=FONT_PT - 1.5, color=PREDICTED, va="center")
        if f is not None and g is not None:
            axes.plot([1.0, 2.0], [f, g], color=_colour(mode), linewidth=0.6, alpha=0.8)
    tidy(axes, grid="y")
    axes.set_xlim(-0.1, 4.35)
    axes.margins(y=0.06)
    axes.set_xticks([0.5, 2.5], labels=["measured", "simulated"])
    axes.tick_params(axis="x", length=0)
    axes.spines["bottom"].set_visible(False)
    axes.set_ylabel("frequency in Hz")
    _label_rungs(axes, labels, spacing)


def _label_rungs(axes: Axes, labels: list[tuple[float, str, str]], spacing: float) -> None:
    """Names beside the rungs, at least a part `spacing` of the ladder's height apart."""
    low, high = axes.get_ylim()
    axes.set_ylim(low, high)
    names = _merged(labels)
    at = np.array([frequency for frequency, _, _ in names])
    place = _spread(at, spacing * (high - low))
    for (frequency, name, colour), y in zip(names, place, strict=True):
        axes.plot([3.02, 3.3], [frequency, y], color=FAINT, linewidth=0.4)
        axes.annotate(name, (3.34, y), fontsize=FONT_PT - 1, color=colour, va="center", annotation_clip=False)


def _merged(labels: list[tuple[float, str, str]]) -> list[tuple[float, str, str]]:
    """One label for a doublet measured twice."""
    merged: dict[tuple[float, str], str] = {}
    for frequency, name, colour in sorted(labels):
        merged.setdefault((frequency, name), colour)
    return [(frequency, name, colour) for (frequency, name), colour in merged.items()]


def _spread(wanted: np.ndarray, distance: float) -> np.ndarray:
    """Ascending places at least a distance apart, near the wanted ones (neighbours are pooled)."""
    groups: list[tuple[float, int]] = []  # middle and number of labels
    for value in wanted:
        middle, count = float(value), 1
        while groups and middle - (count - 1) / 2 * distance < _top(*groups[-1], distance) + distance:
            before, number = groups.pop()
            middle = (middle * count + before * number) / (count + number)
            count += number
        groups.append((middle, count))
    places = [middle + (i - (count - 1) / 2) * distance for middle, count in groups for i in range(count)]
    return np.array(places)


def _top(middle: float, count: int, distance: float) -> float:
    return middle + (count - 1) / 2 * distance


def _draw_errors(axes: Axes, pairs: Sequence[ModeResult]) -> None:
    shown = [m for m in pairs if m.error_percent is not None]
    for row, mode in enumerate(shown):
        half = error_half_width(mode)
        axes.errorbar(
            mode.error_percent or 0.0,
            row,
            xerr=half,
            fmt="o" if mode.role == "fitted" else "D",
            markersize=4.2,
            markerfacecolor=_colour(mode) if mode.role == "fitted" else "white",
            color=_colour(mode),
            elinewidth=1.0,
            capsize=2.0,
            markeredgewidth=1.0,
        )
    axes.axvline(0.0, color=INK, linewidth=0.7)
    tidy(axes, grid="both")
    axes.set_yticks(range(len(shown)), labels=[_row_label(m) for m in shown])
    axes.set_ylim(len(shown) - 0.4, -0.6)
    reach = max((abs(m.error_percent or 0.0) + (error_half_width(m) or 0.0) for m in shown), default=1.0)
    axes.set_xlim(-1.12 * max(reach, 0.05), 1.12 * max(reach, 0.05))
    axes.set_xlabel("error of the simulated frequency in %")
    if not shown:
        axes.text(0.5, 0.5, "no pairs", transform=axes.transAxes, ha="center", color=FAINT, fontsize=FONT_PT)
    _legend(axes, shown)


def _row_label(mode: ModeResult) -> str:
    return f"{safe(short_name(mode))}  {mode.measured_hz:.0f} Hz"


def _legend(axes: Axes, shown: Sequence[ModeResult]) -> None:
    entries = {
        "fitted": Line2D([], [], color=SIMULATED, marker="o", linestyle="", markersize=4.2, label="fitted"),
        "held_out": Line2D(
            [], [], color=PREDICTED, marker="D", linestyle="", markersize=4, markerfacecolor="white",
            label="predicted, not used in the fit",
        ),
    }  # fmt: skip
    roles = {m.role for m in shown}
    handles = [handle for role, handle in entries.items() if role in roles]
    if handles:
        axes.legend(
            handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2, frameon=False,
            fontsize=FONT_PT - 0.5, labelcolor=INK, handletextpad=0.2, columnspacing=1.2,
        )  # fmt: skip
