"""A plate, a beam or a wing from above, with the places of what was left out."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.materials.typical_ranges import Z95
from statorhom.report.diagnosis.words import effect_words
from statorhom.report.document import Picture, text
from statorhom.report.figures.canvas import DATA, FONT_PT, INK, new_figure, safe, svg, tidy
from statorhom.results.diagnosis import EffectResult, PlanLocation, PlanRow
from statorhom.study.message import one_line

WIDE, LEAST, MOST = 150.0, 34.0, 130.0  # of the picture (mm)


def plan_figure(effects: Sequence[EffectResult], plan: PlanRow) -> Picture | None:
    """The outline with every effect's place and those that look the same; None where nothing has a place."""
    placed = [(e, e.location) for e in effects if isinstance(e.location, PlanLocation)]
    if not placed:
        return None
    outline = np.array([*plan.outline_mm, plan.outline_mm[0]])
    size = np.ptp(outline, axis=0)
    figure = new_figure(WIDE, float(np.clip(22 + 0.85 * WIDE * size[1] / size[0], LEAST, MOST)))
    axes = figure.subplots()
    axes.plot(outline[:, 0], outline[:, 1], color=INK, linewidth=1.0)
    turn = np.linspace(0, 2 * np.pi, 60)
    smallest = 0.008 * float(size.max())
    for _, place in placed:
        half = [max(Z95 * sd, smallest) for sd in (place.x_sd_mm, place.y_sd_mm)]
        for i, (x, y) in enumerate(place.place_ambiguity_mm or ((place.x_mm, place.y_mm),)):
            filled = {"facecolor": DATA, "alpha": 0.75} if i == 0 else {"facecolor": "none"}
            axes.fill(
                x + half[0] * np.cos(turn),
                y + half[1] * np.sin(turn),
                edgecolor=DATA,
                linewidth=1.2,
                **filled,
            )
    names = " and ".join(dict.fromkeys(safe(effect_words(e.effect)) for e, _ in placed))
    axes.plot([], [], marker="o", linestyle="none", color=DATA, label=f"{names}, 90 % region")
    if any(len(place.place_ambiguity_mm) > 1 for _, place in placed):
        axes.plot(
            [], [], marker="o", linestyle="none", color=DATA, markerfacecolor="none", label="equally possible"
        )
    axes.legend(fontsize=FONT_PT - 0.5, frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
    axes.set_aspect("equal")
    axes.set_xlabel("x (mm)")
    axes.set_ylabel("y (mm)")
    tidy(axes)
    return Picture(svg(figure), "svg", WIDE, _alt([e for e, _ in placed]), text("The body from above."))


def _alt(placed: Sequence[EffectResult]) -> str:
    what = " and ".join(dict.fromkeys(effect_words(e.effect) for e in placed))
    return one_line(f"where {what} lies on the body, seen from above")
