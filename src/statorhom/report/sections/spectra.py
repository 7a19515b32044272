"""Circumferential order spectra of the simulated shapes."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.report.context import DrawnShapes, Step, are_blocks
from statorhom.report.document import Block, Gallery, Paragraph, Picture, Section, muted, strong, text
from statorhom.report.figures.spectrum_map import WIDTH_MM, shown_orders, spectrum_map
from statorhom.report.wording import frequency, mode_name
from statorhom.results import ModeResult

_MOST_PICTURES = 18


def spectra(steps: Sequence[Step]) -> Section | None:
    """A gallery of spectra per step, or nothing where modes have no orders."""
    if are_blocks(steps):
        return None
    lead = text(
        "The radial motion of the outer surface is split into waves around the circumference. The bars "
        "give each order’s share of the motion; below them, a row for every plane along the axis shows how "
        "strongly and with which sign (red or blue) the order moves there: a change of colour from one end "
        "to the other is a node plane. A clean mode has one order; several orders mean that the mode’s "
        "name (r, n) stands for its largest part only.",
    )
    galleries: list[Block] = []
    for step in steps:
        galleries += _step(step)
    nothing: list[Block] = [Paragraph(text("No spectra were stored."), "note")]
    return Section("Order spectra", (Paragraph(lead, "lead"), *(galleries or nothing)))


def _step(step: Step) -> list[Block]:
    if step.shapes is None or not len(step.shapes.file.planes_m):
        return []
    modes = [m for m in step.drawn_modes if _has_spectrum(step.shapes, m)][:_MOST_PICTURES]
    if not modes:
        return []
    orders = shown_orders([step.shapes.file.modes[m.shape].spectrum for m in modes if m.shape is not None])
    head = Paragraph(text(f"Step {step.result.name}"), "heading")
    return [head, Gallery(tuple(_picture(step.shapes, m, orders) for m in modes), columns=3)]


def _has_spectrum(drawn: DrawnShapes, mode: ModeResult) -> bool:
    return mode.shape is not None and bool(drawn.file.modes[mode.shape].spectrum.any())


def _picture(drawn: DrawnShapes, mode: ModeResult, orders: int) -> Picture:
    assert mode.shape is not None
    shape = drawn.file.modes[mode.shape]
    content = spectrum_map(shape.spectrum, drawn.file.planes_m * 1e3, orders)
    name = mode_name(shape.order, shape.axial, shape.kind)
    caption = text(strong(name), f"  {frequency(mode.simulated_hz)} Hz", muted(f" ({mode.test})"))
    return Picture(content, "svg", WIDTH_MM, f"order spectrum of mode {name}", caption)
