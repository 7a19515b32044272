"""The unrolled stator or tube: where its measured shapes contradict the model, and where a named effect sits."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap

from statorhom.materials.typical_ranges import Z95
from statorhom.report.diagnosis.words import effect_words
from statorhom.report.document import Picture, text
from statorhom.report.figures.canvas import (
    DATA,
    FAINT_INK,
    FONT_PT,
    INK,
    PREDICTED,
    new_figure,
    safe,
    svg,
    tidy,
)
from statorhom.results.diagnosis import AngleRow, EffectResult, Location, MachineRow, MapRow
from statorhom.study.message import one_line

TINTS = LinearSegmentedColormap.from_list("tints", ["#ffffff", "#f6d9bf", "#d55e00"])
WHOLE_TURN = 360.0


def place_figure(
    effects: Sequence[EffectResult],
    row: MapRow | None,
    angles: Sequence[AngleRow],
    machine: MachineRow | None,
) -> Picture | None:
    """Error map with the effects' places over it, and the angular map below; None where nothing tells a place."""
    placed = [e for e in effects if isinstance(e.location, Location) and e.location.angle_deg is not None]
    if row is None and not placed and not angles:
        return None
    around = len(angles) > 0
    figure = new_figure(170, 58 + 34 * around)
    grid = figure.subplots(1 + around, 1, sharex=True, squeeze=False, height_ratios=[1.7, 1][: 1 + around])
    top = grid[0, 0]
    if row is not None:
        _colours(top, row)
    known = [
        *(row.z_mm if row else ()),
        *(1.2 * e.location.z_mm for e in placed if isinstance(e.location, Location) and e.location.z_mm),
    ]
    length = machine.length_mm if machine is not None else max(known, default=1.0)
    for effect in placed:
        _place(top, effect, length)
    low, high = (0.0, length) if row is None else (row.z_mm[0], row.z_mm[-1])
    top.set_ylim(min(low, 0.0), max(high, length))
    top.set_ylabel("height (mm)")
    if placed:
        top.legend(fontsize=FONT_PT - 0.5, frameon=True, framealpha=0.85, edgecolor="none", loc="upper right")
    tidy(top)
    if around:
        _around(grid[1, 0], angles, placed)
    bottom = grid[-1, 0]
    bottom.set_xlim(0, WHOLE_TURN)
    bottom.set_xticks(range(0, 361, 45))
    bottom.set_xlabel(_angle_words(machine))
    return Picture(svg(figure), "svg", 170.0, _alt(placed, row), text(_caption(placed, row, around)))


def _angle_words(machine: MachineRow | None) -> str:
    if machine is not None and machine.slots == 0:
        return f"angle around the {machine.kind}, counted from +x towards +y (°)"
    return "angle around the stator, counted from the centre of tooth 0 (°)"


def _colours(axes: Axes, row: MapRow) -> None:
    total = np.sum([np.array(part) for part in row.regions.values()], axis=0).T
    # against an even spread: 1 is the mean of all places
    relative = total / max(float(total.mean()), 1e-300)
    mesh = axes.pcolormesh(
        row.angles_deg,
        row.z_mm,
        relative,
        cmap=TINTS,
        vmin=0.0,
        vmax=max(2.0, float(relative.max())),
        rasterized=True,
    )
    bar = axes.figure.colorbar(mesh, ax=axes, pad=0.01, aspect=14)
    bar.set_label("contradiction,\n1 = mean", size=FONT_PT - 0.5, color=INK)
    bar.ax.tick_params(labelsize=FONT_PT - 1, colors=INK)
    bar.outline.set_visible(False)


def _place(axes: Axes, effect: EffectResult, length: float) -> None:
    """The place with its 90 % region; equivalent angles are drawn open."""
    place = effect.location
    assert isinstance(place, Location) and place.angle_deg is not None
    z = place.z_mm if place.z_mm is not None else length / 2
    half = Z95 * place.z_sd_mm if place.z_sd_mm is not None else length / 2
    width = max(Z95 * (place.angle_sd_deg or 0.0), 1.2)
    turn = np.linspace(0, 2 * np.pi, 60)
    for i, angle in enumerate(place.angle_ambiguity_deg or (place.angle_deg,)):
        for whole in (-WHOLE_TURN, 0.0, WHOLE_TURN):
            x, y = angle + whole + width * np.cos(turn), np.clip(z + half * np.sin(turn), 0, length)
            filled = {"facecolor": DATA, "alpha": 0.75} if i == 0 else {"facecolor": "none"}
            axes.fill(x, y, edgecolor=DATA, linewidth=1.2, **filled)
    name = safe(effect_words(effect.effect))
    axes.plot([], [], marker="o", linestyle="none", color=DATA, label=f"{name}, 90 % region")
    if len(place.angle_ambiguity_deg) > 1:
        axes.plot(
            [], [], marker="o", linestyle="none", color=DATA, markerfacecolor="none", label="equally possible"
        )


def _around(axes: Axes, angles: Sequence[AngleRow], placed: Sequence[EffectResult]) -> None:
    degrees = [a.angle_deg for a in angles]
    axes.fill_between(degrees, [100 * a.weight for a in angles], color=PREDICTED, alpha=0.25, linewidth=0)
    axes.plot(degrees, [100 * a.weight for a in angles], color=PREDICTED, linewidth=1.0)
    for effect in placed:
        assert isinstance(effect.location, Location)
        for i, angle in enumerate(effect.location.angle_ambiguity_deg or ()):
            axes.axvline(angle, color=DATA, linewidth=1.2, linestyle="-" if i == 0 else "--")
    axes.set_ylim(0, 105)
    axes.set_ylabel("splits that one\ncause explains (%)", color=FAINT_INK)
    tidy(axes, "y")


def _caption(placed: Sequence[EffectResult], row: MapRow | None, around: bool) -> str:
    parts = ["The outside, cut open and unrolled."]
    if row is not None:
        parts.append(
            f"Colour (test {row.test}): where the measured motion contradicts the model most. Sensors on the outside "
            "smear it, so it ranks places and decides nothing."
        )
    if placed:
        parts.append("Green: the place of the named effect, as far as it is known.")
    if around:
        parts.append(
            "Lower curve: how much of the measured splitting of the modes one local cause at that angle would explain. "
            "Opposite angles are always alike here; only the shapes can tell them apart."
        )
    return " ".join(parts)


def _alt(placed: Sequence[EffectResult], row: MapRow | None) -> str:
    what = " and ".join(dict.fromkeys(effect_words(e.effect) for e in placed)) or "the contradiction"
    return one_line(f"where {what} lies on the unrolled body" + ("" if row is None else f", test {row.test}"))
