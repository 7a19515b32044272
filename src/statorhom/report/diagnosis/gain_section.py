"""What the model gains: errors before and after, what was not fitted apart, and what the constants had absorbed."""

from __future__ import annotations

from statorhom.materials.typical_ranges import Z95
from statorhom.report.diagnosis.words import constant_figures, constant_words
from statorhom.report.document import Block, Column, Paragraph, Row, Section, Table, Text, strong, text
from statorhom.report.wording import constant_interval, constant_value
from statorhom.results.diagnosis import ConstantRow, Details, Diagnosis, RefittedRow

NOTABLE = 1.0  # standard deviations by which a constant must move to have absorbed something


def gain_section(d: Diagnosis, e: Details) -> Section:
    """Fifth section."""
    blocks: list[Block] = [_errors(d)]
    if d.verdict in ("named", "ambiguous") and e.constants:
        blocks.append(Paragraph(text("What the constants had absorbed"), "heading"))
        blocks.append(Paragraph(_absorbed(d, e)))
        blocks.append(_constants(e))
    if e.refitted:
        blocks.append(Paragraph(text("The chain of steps identified anew"), "heading"))
        blocks.append(_refitted(e.refitted))
    if e.refit_note:
        blocks.append(Paragraph(text(e.refit_note), "note"))
    return Section("Before and after", tuple(blocks))


def _errors(d: Diagnosis) -> Table:
    named = d.verdict in ("named", "ambiguous")
    head = [Column(text("error of the frequencies")), Column(text("declared model"), "right")]
    if named:
        head.append(Column(text("with the explanation"), "right"))
    rows = [Row((text("modes that were fitted"),), group=True)]
    for what, key in (("root mean square", "rms_percent"), ("largest", "max_percent")):
        values = [getattr(d.fit.before, key), *([getattr(d.fit.after, key)] if named else [])]
        rows.append(Row((text(what), *(text(f"{v:.2f} %") for v in values))))
    h = d.fit.held_out
    if h is not None:
        rows.append(Row((text("held out: not seen by the fit"),), group=True))
        values = [h.before_rms_percent, *([h.after_rms_percent] if named else [])]
        rows.append(Row((text(h.what), *(text(f"{v:.2f} %") for v in values))))
    return Table(tuple(head), tuple(rows))


def _absorbed(d: Diagnosis, e: Details) -> Text:
    moved = sorted(
        (c for c in e.constants if c.before_sd > 0 and c.before != 0 and "." in c.name),
        key=lambda c: -abs(_moved(c)),
    )
    chief = [c for c in moved if abs(_moved(c)) >= NOTABLE]
    lead = "Where physics is missing, the constants bend to make up for it. "
    if not chief:
        return text(lead + "Here none had to bend by more than its own uncertainty.")
    c = chief[0]
    step, name = constant_words(c.name)
    percent = 100 * (c.after / c.before - 1)
    tone = "" if d.verdict == "named" else " if the likeliest explanation is right"
    return text(
        lead + "The most had been absorbed by ",
        strong(f"{name} (step {step})"),
        f": it changes by {_signed(percent)}, {abs(_moved(c)):.1f} times its standard deviation{tone}.",
    )


def _moved(c: ConstantRow) -> float:
    return (c.after - c.before) / c.before_sd


def _constants(e: Details) -> Table:
    head = (
        Column(text("constant")),
        Column(text("declared model (90 % interval)"), "right"),
        Column(text("with the explanation (90 % interval)"), "right"),
        Column(text("change"), "right"),
    )
    rows: list[Row] = []
    for c in e.constants:
        step, name = constant_words(c.name)
        if "." not in c.name:
            continue  # weights are no materials
        if not rows or all(r.cells[0] != text(f"step {step}") for r in rows if r.group):
            rows.append(Row((text(f"step {step}"),), group=True))
        before, after = constant_figures(c)
        change = "–" if c.before == 0 else _signed(100 * (c.after / c.before - 1))
        rows.append(Row((text(name), text(before), text(after), text(change))))
    said = f"Intervals are ± {Z95:.2f} standard deviations at the optimum of all tests together."
    return Table(head, tuple(rows), text(said))


def _refitted(rows: tuple[RefittedRow, ...]) -> Table:
    head = (
        Column(text("step")),
        Column(text("constant")),
        Column(text("before (90 % interval)"), "right"),
        Column(text("after (90 % interval)"), "right"),
        Column(text("change"), "right"),
    )
    body = []
    for r in rows:
        region, _, constant = r.name.partition(".")
        words = constant_words(f"{r.stage}:{region}.{constant}")[1]
        cells = [
            f"{constant_value(constant, v, ci)} ({constant_interval(constant, v, ci)}){_open(status)}"
            for v, ci, status in (
                (r.before, r.before_ci90, r.before_status),
                (r.after, r.after_ci90, r.after_status),
            )
        ]
        change = "–" if r.before == 0 else _signed(100 * (r.after / r.before - 1))
        body.append(Row((text(r.stage), text(words), text(cells[0]), text(cells[1]), text(change))))
    return Table(head, tuple(body), text("* the measurements do not determine it; the prior does."))


def _open(status: str) -> str:
    return " *" if status == "prior_dominated" else ""


def _signed(percent: float) -> str:
    return f"{percent:+.1f} %".replace("-", "−")
