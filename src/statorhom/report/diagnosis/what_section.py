"""What the measurements show: every measured feature against the declared model and against the explanation."""

from __future__ import annotations

import numpy as np

from statorhom.report.diagnosis.fingerprint_figure import fingerprint_figure
from statorhom.report.diagnosis.words import effect_words, feature_words, mode_words
from statorhom.report.document import Block, Column, Fold, Paragraph, Row, Section, Table, text
from statorhom.results.diagnosis import Details, Diagnosis, FeatureRow

CERTAIN = 0.5  # features less certain than this are bounds, not measurements


def what_section(d: Diagnosis, details: Details) -> Section | None:
    """Third section; None where no feature can be compared."""
    rows = [r for r in details.features if r.sd < CERTAIN]
    if not rows:
        return None
    changed = d.verdict != "none" and any(r.before != r.after for r in rows)
    lead = "Each bar is one thing that was measured, and how far the fitted model misses it. "
    if d.verdict == "named":
        names = " and ".join(dict.fromkeys(effect_words(e.effect) for e in d.effects))
        lead += f"Orange without, blue with the {names} in the model: what is missing must take the large misses away."
    elif changed:
        lead += "Orange: the declared model. Blue: with the explanation that fits best, which is not certain."
    blocks: list[Block] = [Paragraph(text(lead), "lead"), fingerprint_figure(rows, changed)]
    blocks.append(Fold(text("The same as numbers"), (_table(rows, changed),)))
    return Section("What was measured, and what the model says", tuple(blocks))


def _table(rows: list[FeatureRow], changed: bool) -> Table:
    head = [Column(text("test")), Column(text("mode")), Column(text("what"))]
    head += [Column(text(t), "right") for t in ("measured", "declared model")]
    if changed:
        head.append(Column(text("with the explanation"), "right"))
    body = []
    for row in (r for r in rows if r.kind != "shape"):
        values = [row.measured, row.before, *([row.after] if changed else [])]
        cells = [row.test, mode_words(row.mode), feature_words(row), *(_shown(row.kind, v) for v in values)]
        body.append(Row(tuple(text(c) for c in cells)))
    lines = (
        "Distances of lines are relative to the frequency; the two rows of a mode are the part that stands at 0° "
        "and the part that is turned by an eighth of a wave’s period."
    )
    return Table(tuple(head), tuple(body), text(lines) if any(r.kind == "split" for r in rows) else ())


def _shown(kind: str, value: float) -> str:
    if kind == "frequency":
        return f"{np.exp(value):.1f} Hz"
    if kind == "split":
        return f"{50 * value:+.3f} %"
    if kind == "shift":
        return f"{100 * value:+.4f} %"
    if kind == "lean":
        return f"{round(100 * value, 2) + 0.0:+.2f} %"  # no minus before nothing
    if kind == "loss":
        return f"{np.exp(value):.4f}"
    if kind in ("level", "level_loss"):
        return f"{100 * np.expm1(value):+.2f} %"
    if kind == "density":
        return f"{value:.0f} kg/m³"
    return f"{value:.4g}"
