"""Where an effect sits on the unrolled back of the core."""

from __future__ import annotations

import numpy as np

from statorhom.report.document import Picture
from statorhom.report.figures.canvas import DATA, FAINT_INK, FONT_PT, new_figure, svg, tidy
from statorhom.results.diagnosis import EffectResult

Z90 = 1.645


def place_figure(effect: EffectResult, length_mm: float) -> Picture | None:
    """The place with its 90 % region; equivalent angles are drawn hollow."""
    place = effect.location
    if place is None or place.angle_deg is None:
        return None
    figure = new_figure(170, 55)
    axes = figure.subplots()
    z = place.z_mm if place.z_mm is not None else length_mm / 2
    half = Z90 * place.z_sd_mm if place.z_sd_mm is not None else length_mm / 2
    width = Z90 * (place.angle_sd_deg or 0.0)
    turn = np.linspace(0, 2 * np.pi, 60)
    for i, angle in enumerate(place.angle_ambiguity_deg or (place.angle_deg,)):
        x, y = angle + max(width, 1.0) * np.cos(turn), z + half * np.sin(turn)
        axes.fill(
            x, np.clip(y, 0, length_mm), facecolor=DATA if i == 0 else "none", edgecolor=DATA, alpha=0.7
        )
    axes.set_xlim(0, 360)
    axes.set_ylim(0, length_mm)
    axes.set_xticks(range(0, 361, 45))
    axes.set_xlabel("angle around the stator (°)")
    axes.set_ylabel("height (mm)")
    if len(place.angle_ambiguity_deg) > 1:
        axes.set_title(
            "hollow: angles that the measurements do not tell from it", fontsize=FONT_PT, color=FAINT_INK
        )
    tidy(axes)
    return Picture(svg(figure), "svg", 170.0, f"{effect.effect} on the unrolled stator")
