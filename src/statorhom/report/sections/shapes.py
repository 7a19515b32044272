"""Pictures of the deformed stator for the modes that were measured."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.report.context import DrawnShapes, Step, are_blocks
from statorhom.report.document import Block, Gallery, Paragraph, Picture, Section, Text, muted, strong, text
from statorhom.report.figures.shape_picture import WIDTH_MM
from statorhom.report.wording import frequency, mode_name
from statorhom.results import ModeResult
from statorhom.results.shape_file import ModeShape

_MOST_PICTURES = 18
_LEAD = (
    "How the stator moves in each measured mode, as simulated and greatly exaggerated. Left: the "
    "deformed stator, red where it moves outwards and blue where it moves inwards at the same moment; "
    "dashed, the edges of the undeformed outer surface. Right: the outer edges of both ends seen along "
    "the axis, the upper end (largest z) as a full dark line, the lower one as a dashed blue line. "
    "Where both coincide, n is even; where they are opposite, n is odd."
)
_BLOCK_LEAD = (
    "How the body moves in each measured mode, as simulated and greatly exaggerated: red and blue parts move in "
    "opposite directions, along the axis that moves most. Thin lines: the edges of the undeformed body."
)


def shapes(steps: Sequence[Step]) -> Section:
    """A gallery per step."""
    lead = text(_BLOCK_LEAD if are_blocks(steps) else _LEAD)
    blocks: list[Block] = [Paragraph(lead, "lead")]
    for step in steps:
        blocks += _step(step)
    return Section("Mode shapes", tuple(blocks))


def _step(step: Step) -> list[Block]:
    if not step.paired:
        return []
    head = Paragraph(text(f"Step {step.result.name}"), "heading")
    modes = step.drawn_modes
    if step.shapes is None or not modes:
        return [head, Paragraph(text("The shapes of this step were not stored."), "note")]
    shown = modes[:_MOST_PICTURES]
    blocks: list[Block] = [head, Gallery(tuple(_picture(step.shapes, mode) for mode in shown), columns=2)]
    if len(modes) > len(shown):
        blocks.append(Paragraph(text(f"{len(modes) - len(shown)} more modes are not drawn."), "note"))
    return blocks


def _picture(drawn: DrawnShapes, mode: ModeResult) -> Picture:
    assert mode.shape is not None
    shape = drawn.file.modes[mode.shape]
    content = drawn.picture(mode.shape)
    name = mode_name(shape.order, shape.axial, shape.kind)
    return Picture(content, "png", WIDTH_MM, f"deformed body, mode {name}", _caption(name, mode, shape))


def _caption(name: str, mode: ModeResult, shape: ModeShape) -> Text:
    pure = f", {100 * shape.share:.0f} % of order {shape.order}" if shape.order is not None else ""
    return text(
        strong(name),
        f"  simulated {frequency(mode.simulated_hz)} Hz, measured {frequency(mode.measured_hz)} Hz",
        muted(f" ({mode.test}{pure})"),
    )
