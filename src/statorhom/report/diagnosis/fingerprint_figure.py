"""By how much the declared model misses every measured feature, and by how much with the explanation in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.report.diagnosis.words import mode_words
from statorhom.report.document import Picture, text
from statorhom.report.figures.canvas import FONT_PT, INK, PREDICTED, SIMULATED, new_figure, safe, svg, tidy
from statorhom.results.diagnosis import FeatureRow

SHORT = {
    "frequency": "frequency",
    "split": "two lines",
    "shift": "place to place",
    "lean": "lean to one end",
    "damping": "damping",
}
MOST = 24
MET = 0.1  # what is met so well before and after is left out
TICKS = (0, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)


@dataclass(frozen=True)
class Miss:
    """All features of one kind of one mode: how many standard deviations off, together."""

    test: str
    mode: tuple[int, ...] | None
    kind: str
    before: float
    after: float


def misses(rows: Sequence[FeatureRow]) -> list[Miss]:
    """Features gathered by test, mode and kind, root mean squares; in the order of the tests and modes."""
    gathered: dict[tuple[str, tuple[int, ...] | None, str], list[FeatureRow]] = {}
    for row in rows:
        gathered.setdefault((row.test, row.mode, row.kind), []).append(row)
    return [
        Miss(test, mode, kind, _size(own, "before"), _size(own, "after"))
        for (test, mode, kind), own in gathered.items()
    ]


def fingerprint_figure(rows: Sequence[FeatureRow], changed: bool) -> Picture:
    """Bars in standard deviations; `changed`: whether there is an explanation to compare with."""
    found = misses(rows)
    every = [m for m in found if max(m.before, m.after) > MET] or found
    largest = sorted(every, key=lambda m: -max(m.before, m.after))[:MOST]
    shown = [m for m in every if m in largest]
    figure = new_figure(170, 16 + 5.2 * max(len(shown), 3))
    axes = figure.subplots()
    places = np.arange(len(shown))[::-1]
    half = 0.19 if changed else 0.0
    axes.barh(places + half, [m.before for m in shown], height=0.34, color=PREDICTED, label="declared model")
    if changed:
        axes.barh(
            places - half,
            [m.after for m in shown],
            height=0.34,
            color=SIMULATED,
            label="with the explanation",
        )
    axes.set_xscale("symlog", linthresh=2.0)
    top = max([3.0, *(max(m.before, m.after) for m in shown)])
    ticks = [t for t in TICKS if t <= 1.15 * top]
    axes.set_xticks(ticks, [str(t) for t in ticks])
    axes.minorticks_off()
    axes.set_xlim(0, 1.15 * top)
    axes.axvspan(0, 2, color="#eef2f5", zorder=0)
    axes.set_yticks(places, [_label(m, len({r.test for r in rows}) > 1) for m in shown])
    axes.set_ylim(-0.7, len(shown) - 0.3)
    axes.set_xlabel("how far off, in multiples of what measurement and mesh leave uncertain")
    axes.axvline(0, color=INK, linewidth=0.6)
    if changed:
        axes.legend(
            fontsize=FONT_PT - 0.5, frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2
        )
    tidy(axes, "x")
    left = f" The {MOST} largest of {len(every)} are shown." if len(every) > MOST else ""
    lines = (
        " “Two lines”: where a mode’s two lines lie apart and at which angle they stand; on a perfectly even ring "
        "they would coincide."
    )
    met = len(found) - len(every)
    what = "the declared model and the explanation both meet" if changed else "are met"
    less = f" Left out: {met} that {what}." if met else ""
    caption = (
        f"Grey: no more than chance.{lines if any(m.kind == 'split' for m in shown) else ''}{left}{less}"
    )
    alt = "how far the model misses every measured feature, before and after the effect is modelled"
    return Picture(svg(figure), "svg", 170.0, alt, text(caption))


def _label(miss: Miss, several: bool) -> str:
    test = f"{safe(miss.test, 22)}  " if several else ""
    mode = f"mode {mode_words(miss.mode)}  " if miss.mode is not None else ""
    return f"{test}{mode}{SHORT.get(miss.kind, miss.kind)}"


def _size(rows: Sequence[FeatureRow], side: str) -> float:
    return float(np.sqrt(np.mean([((getattr(r, side) - r.measured) / r.sd) ** 2 for r in rows])))
