"""A diagnosis as a document: where, what, how sure, and what the model gains."""

from __future__ import annotations

from pathlib import Path

from statorhom.report.diagnosis.fingerprint_figure import fingerprint_figure
from statorhom.report.diagnosis.place_figure import place_figure
from statorhom.report.document import (
    Block,
    Column,
    Document,
    Notice,
    Paragraph,
    Row,
    Section,
    Table,
    strong,
    text,
)
from statorhom.report.html import render_html
from statorhom.results.diagnosis import Details, Diagnosis, EffectResult, Estimated
from statorhom.study.atomic import write_text

NAME = "report.html"
VERDICTS = {
    "none": "Nothing is missing from the model as far as these measurements can tell.",
    "named": "The model lacks something, and the measurements say what.",
    "ambiguous": "The model lacks something; two explanations or more are equally likely.",
    "unknown": "The model lacks something that no effect in the library explains.",
}


def write_diagnosis_page(diagnosis: Diagnosis, details: Details, length_mm: float, folder: Path) -> Path:
    """Write the page into a folder."""
    write_text(folder / NAME, render_html(compose(diagnosis, details, length_mm)))
    return folder / NAME


def compose(diagnosis: Diagnosis, details: Details, length_mm: float) -> Document:
    """All sections."""
    sections = [
        Section("Verdict", _verdict(diagnosis, details)),
        Section("Where", _where(diagnosis, details, length_mm)),
        Section("How sure", _sure(diagnosis, details)),
        Section("Before and after", _errors(diagnosis, details)),
    ]
    facts = (("Verdict", diagnosis.verdict), ("Computed in", f"{details.seconds:.0f} s"))
    return Document("What the model left out", diagnosis.study, facts, tuple(sections))


def _verdict(d: Diagnosis, details: Details) -> tuple[Block, ...]:
    blocks: list[Block] = [Paragraph(text(strong(VERDICTS[d.verdict])), "lead")]
    for effect in d.effects:
        blocks.append(Notice(effect.effect, tuple(text(line) for line in _lines(effect, details))))
    if d.next_measurement is not None:
        n = d.next_measurement
        blocks.append(
            Notice("What would tell them apart", (text(f"{n.what}: separates {', '.join(n.separates)}"),))
        )
    return tuple(blocks)


def _lines(effect: EffectResult, details: Details) -> list[str]:
    lines = [
        details.summary or effect.effect,
        f"in stage {effect.stage}, probability {effect.probability:.0%}",
    ]
    for name, value in effect.parameters.items():
        lines.append(f"{name} = {_shown(value)}")
    if effect.note:
        lines.append(f"modelled as: {effect.note}")
    if details.citation:
        lines.append(f"see {details.citation}")
    return lines


def _shown(value: Estimated | float | str) -> str:
    if isinstance(value, Estimated):
        number = value.value if isinstance(value.value, str) else f"{value.value:.4g}"
        return number if value.ci90 is None else f"{number} ({value.ci90[0]:.4g} … {value.ci90[1]:.4g})"
    return value if isinstance(value, str) else f"{value:.4g}"


def _where(d: Diagnosis, details: Details, length_mm: float) -> tuple[Block, ...]:
    blocks: list[Block] = []
    if d.mismatch is not None:
        blocks.append(Paragraph(text(f"Stage {d.mismatch.stage}: {d.mismatch.statement}."), "lead"))
    for effect in d.effects:
        picture = place_figure(effect, length_mm)
        if picture is not None:
            blocks.append(picture)
    if details.features:
        blocks.append(
            Paragraph(
                text(
                    "Each bar is one measured quantity: how far the declared model (before) and the one with the best "
                    "explanation (after) miss it. Within the grey band a difference is no more than chance."
                )
            )
        )
        blocks.append(fingerprint_figure(details.features))
    return tuple(blocks) or (Paragraph(text("No test can be compared.")),)


def _sure(d: Diagnosis, e: Details) -> tuple[Block, ...]:
    rows = [
        ("chance of so strong a signature if nothing is missing", f"{e.p_value:.2g}", "below 0.01"),
        ("log evidence over “nothing is missing”", f"{e.over_nothing:.1f}", "above 5"),
        ("log evidence over the next explanation", f"{min(e.over_others, 999):.1f}", "above 3"),
        ("chance of the remaining misfit, if the explanation is right", f"{e.adequacy:.2g}", "above 0.01"),
        ("the same of the declared model", f"{e.nothing_adequacy:.2g}", ""),
        ("resamplings that find the same", f"{e.stability:.0%}", "at least 80 %"),
    ]
    head = (Column(text("rule")), Column(text("found"), "right"), Column(text("needed"), "right"))
    blocks: list[Block] = [Table(head, tuple(Row(tuple(text(c) for c in row)) for row in rows))]
    if d.alternatives:
        blocks.append(
            Paragraph(
                text(
                    "Other explanations: "
                    + ", ".join(f"{a.effect} ({a.probability:.1%})" for a in d.alternatives)
                )
            )
        )
    if e.confusions:
        blocks.append(
            Paragraph(
                text(
                    "Looks alike: "
                    + "; ".join(f"{name} (told apart by: {how})" for name, how in e.confusions)
                ),
                "note",
            )
        )
    return tuple(blocks)


def _errors(d: Diagnosis, e: Details) -> tuple[Block, ...]:
    rows = [("all paired modes, rms", d.fit.before.rms_percent, d.fit.after.rms_percent)]
    rows.append(("all paired modes, largest", d.fit.before.max_percent, d.fit.after.max_percent))
    if d.fit.held_out is not None:
        h = d.fit.held_out
        rows.append((f"held out: {h.what}, rms", h.before_rms_percent, h.after_rms_percent))
    head = (Column(text("error")), Column(text("before, %"), "right"), Column(text("after, %"), "right"))
    body = tuple(Row((text(a), text(f"{b:.3f}"), text(f"{c:.3f}"))) for a, b, c in rows)
    constants = tuple(
        Row(
            (
                text(c.name),
                text(f"{c.before:.4g} ± {c.before_sd:.2g}"),
                text(f"{c.after:.4g} ± {c.after_sd:.2g}"),
            )
        )
        for c in e.constants
    )
    names = (Column(text("constant")), Column(text("before"), "right"), Column(text("after"), "right"))
    said = Paragraph(text("What the constants had absorbed of the missing physics shows in how they change."))
    return (Table(head, body), said, Table(names, constants))
