"""Loss factors of regions and modes."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.report.context import Step
from statorhom.report.document import Block, Column, Paragraph, Row, Section, Table, muted, strong, text
from statorhom.report.wording import NOTHING, frequency, mode_name, rounded


def damping(steps: Sequence[Step]) -> Section | None:
    """Loss factors, or nothing where none were measured."""
    regions = [row for step in steps for row in _regions(step)]
    modes = [row for step in steps for row in _modes(step)]
    if not regions and not modes:
        return None
    lead = text(
        "The loss factor η is the part of its elastic energy that a material or a mode loses per radian of "
        "vibration (twice the damping ratio). A mode’s loss factor is the mean of its regions’, weighted "
        "by their shares of the elastic energy; so the regions’ follow from the modes’.",
    )
    blocks: list[Block] = [Paragraph(lead, "lead")]
    if regions:
        titles = (
            ("Step", "left"),
            ("Region", "left"),
            ("Loss factor in %", "right"),
            ("90 % interval", "right"),
        )
        blocks.append(Table(tuple(Column(text(t), a) for t, a in titles), tuple(regions)))  # type: ignore[arg-type]
    if modes:
        columns = (
            Column(text("Test")),
            Column(text("Mode")),
            Column(text("Measured in Hz"), "right"),
            Column(text("Measured η in %"), "right"),
            Column(text("Simulated η in %"), "right"),
        )
        blocks.append(Table(columns, tuple(modes)))
    return Section("Damping", tuple(blocks))


def _regions(step: Step) -> list[Row]:
    rows = []
    for name, region in step.result.regions.items():
        before = None if step.before is None else step.before.regions.get(name)
        loss = region.loss_factor
        if loss is None or (before is not None and before.loss_factor == loss):
            continue
        ends = (100 * loss.ci90[0], 100 * loss.ci90[1])
        value, low, high = (rounded(x, ends) for x in (100 * loss.value, *ends))
        rows.append(Row((text(step.result.name), text(name), text(strong(value)), text(f"{low} … {high}"))))
    return rows


def _modes(step: Step) -> list[Row]:
    rows = []
    for mode in step.result.modes:
        if mode.measured_loss_factor is None or mode.measured_hz is None:
            continue
        simulated = mode.simulated_loss_factor
        rows.append(
            Row(
                (
                    text(mode.test),
                    text(mode_name(mode.order, mode.axial, mode.kind)),
                    text(frequency(mode.measured_hz)),
                    text(f"{100 * mode.measured_loss_factor:.2f}"),
                    text(muted(NOTHING)) if simulated is None else text(f"{100 * simulated:.2f}"),
                )
            )
        )
    return rows
