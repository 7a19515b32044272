"""Measured against simulated modes, test by test."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.report.context import Step, are_blocks, tests_of
from statorhom.report.document import (
    Block,
    Column,
    Paragraph,
    Picture,
    Row,
    Section,
    Table,
    Text,
    muted,
    strong,
    text,
    warning,
)
from statorhom.report.figures.mode_comparison import WIDTH_MM, error_half_width, mode_comparison
from statorhom.report.wording import NOTHING, frequency, mode_name, percent, plural
from statorhom.results import ModeResult

DOUBTFUL = 0.3
_UNMATCHED_SHOWN = 12
_BAND_MARGIN = (
    1.15  # simulated modes without a partner are of interest up to a little above the measured ones
)


def modes(steps: Sequence[Step]) -> Section:
    """A table and a picture per test."""
    naming = (
        "Modes are told by their motion and paired by their frequencies. "
        if are_blocks(steps)
        else "A mode is named (r, n): r waves around the circumference, n node planes along the axis. "
    )
    lead = text(
        naming,
        "The error is how far the simulated frequency lies above (+) or below (−) the measured one; “±” after it is "
        "the 90 % uncertainty that measurement and model leave it, so that an error beyond it (bold) needs "
        "an explanation. “Mesh” is the correction that was added to the simulated frequency for the finite "
        "mesh. Predicted modes were not used in the fit: they test it.",
    )
    blocks: list[Block] = [Paragraph(lead, "lead")]
    for step in steps:
        for test in tests_of(step.result.modes):
            blocks += _test(step, test)
    untested = [step.result.name for step in steps if not step.result.modes]
    if untested:
        blocks.append(Paragraph(text(f"No modes were measured after: {', '.join(untested)}."), "note"))
    return Section("Measured and simulated modes", tuple(blocks))


def _test(step: Step, test: str) -> list[Block]:
    found = [m for m in step.result.modes if m.test == test]
    shown, hidden = _in_band(found)
    head = Paragraph(text(f"Step {step.result.name}, test {test}"), "heading")
    blocks: list[Block] = [head, _table(shown)]
    if hidden:
        note = (
            f"Not listed: {plural(hidden, 'simulated mode')} without a measured partner, above the "
            f"measured band or beyond the {_UNMATCHED_SHOWN}th."
        )
        blocks.append(Paragraph(text(note), "note"))
    if any(_doubtful(m) for m in shown):
        note = "“Uncertain pair”: another simulated mode would have fitted nearly as well."
        blocks.append(Paragraph(text(note), "note"))
    blocks.append(_picture(shown))
    return blocks


def _in_band(found: list[ModeResult]) -> tuple[list[ModeResult], int]:
    """Modes to show, and how many simulated ones without partner are left out."""
    top = _BAND_MARGIN * max((m.measured_hz or 0.0 for m in found), default=0.0)
    lonely = sorted(
        (m for m in found if m.measured_hz is None and (m.simulated_hz or 0.0) <= top),
        key=lambda m: m.simulated_hz or 0.0,
    )[:_UNMATCHED_SHOWN]
    measured = [m for m in found if m.measured_hz is not None]
    return measured + lonely, len(found) - len(measured) - len(lonely)


def _table(found: Sequence[ModeResult]) -> Table:
    columns = (
        Column(text("Mode")),
        Column(text("Measured in Hz"), "right"),
        Column(text("Simulated in Hz"), "right"),
        Column(text("Error in %"), "right"),
        Column(text("± 90 %"), "right"),
        Column(text("Mesh in %"), "right"),
        Column(text("MAC"), "right"),
        Column(text("Remark")),
    )
    groups = (
        ("Fitted", [m for m in found if m.role == "fitted"]),
        ("Predicted: held out or not used in the fit", [m for m in found if m.role == "held_out"]),
        ("Measured without a simulated partner", [m for m in found if _alone(m) and m.simulated_hz is None]),
        (
            "Simulated without a measured partner",
            [m for m in found if _alone(m) and m.simulated_hz is not None],
        ),
    )
    rows: list[Row] = []
    for title, members in groups:
        if members:
            rows.append(Row((text(title),), group=True))
            members.sort(key=lambda m: m.measured_hz or m.simulated_hz or 0.0)
            rows += [_row(m) for m in members]
    return Table(columns, tuple(rows))


def _alone(mode: ModeResult) -> bool:
    return mode.role == "unmatched"


def _row(mode: ModeResult) -> Row:
    half = error_half_width(mode)
    return Row(
        (
            _name(mode),
            text(frequency(mode.measured_hz)),
            text(frequency(mode.simulated_hz)),
            _error(mode, half),
            text(NOTHING if half is None or mode.simulated_hz is None else percent(half, sign=False)),
            text(percent(mode.mesh_percent)),
            text(NOTHING if mode.mac is None else f"{mode.mac:.2f}"),
            _remark(mode),
        )
    )


def _name(mode: ModeResult) -> Text:
    name = strong(mode_name(mode.order, mode.axial, mode.kind))
    return text(name, muted(f"  no. {mode.label}")) if mode.label else text(name)


def _error(mode: ModeResult, half: float | None) -> Text:
    shown = percent(mode.error_percent)
    beyond = half is not None and mode.error_percent is not None and abs(mode.error_percent) > half
    return text(strong(shown)) if beyond else text(shown)


def _doubtful(mode: ModeResult) -> bool:
    return mode.doubt is not None and mode.doubt >= DOUBTFUL and mode.role != "unmatched"


def _remark(mode: ModeResult) -> Text:
    if _doubtful(mode):
        return text(warning("uncertain pair"))
    return text()


def _picture(found: Sequence[ModeResult]) -> Picture:
    caption = text(
        "Left: measured and simulated frequencies, joined where they are a pair. Right: errors; the bars "
        "are the 90 % uncertainty of measurement and model together."
    )
    alt = "ladder of measured and simulated frequencies, and errors with their uncertainty"
    return Picture(mode_comparison(found), "svg", WIDTH_MM, alt, caption)
