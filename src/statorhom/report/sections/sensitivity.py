"""Which modes tell which constant, and which constants no mode tells."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.report.context import Step
from statorhom.report.document import Block, Paragraph, Picture, Points, Section, Text, strong, text
from statorhom.report.figures.sensitivity_map import sensitivity_map, sensitivity_width
from statorhom.report.wording import constant_symbol
from statorhom.results import Constant, Sensitivity


def sensitivity(steps: Sequence[Step]) -> Section:
    """A map per step and a sentence per constant."""
    lead = text(
        "The figure in a cell says by how many per cent a mode’s frequency rises when the constant rises "
        "by one per cent. A column of small figures is a constant that these modes cannot tell; two "
        "columns in proportion to one another are constants that they cannot tell apart.",
    )
    found: list[Block] = []
    for step in steps:
        found += _step(step)
    nothing: list[Block] = [Paragraph(text("No sensitivities were stored."), "note")]
    return Section("Sensitivity: what the modes can tell", (Paragraph(lead, "lead"), *(found or nothing)))


def _step(step: Step) -> list[Block]:
    values = step.result.sensitivity
    statements = tuple(_statement(region, name, c, values) for region, name, c in step.new_constants)
    complete = values is not None and bool(values.constants) and bool(values.modes)
    if not statements and not complete:
        return []
    blocks: list[Block] = [Paragraph(text(f"Step {step.result.name}"), "heading")]
    if values is not None and complete:
        alt = "map of the sensitivities of the modes to the constants"
        blocks.append(Picture(sensitivity_map(values), "svg", sensitivity_width(values), alt))
    if statements:
        blocks.append(Points(statements))
    return blocks


def _statement(region: str, name: str, constant: Constant, values: Sensitivity | None) -> Text:
    head = text(strong(region), " ", constant_symbol(name), ": ")
    strongest = _strongest(f"{region}.{name}", values)
    if constant.status == "fixed":
        return text(head, "prescribed, not fitted.")
    if constant.status == "identified":
        by = f" {strongest[0]} tells most about it ({strongest[1]:.2f})." if strongest else ""
        return text(head, "determined by the data.", by)
    if strongest is None:
        return text(head, "not determined; the measured modes leave it where it was assumed.")
    reason = (
        f" Even {strongest[0]}, which depends on it most, changes by only {strongest[1]:.3f} % when it "
        f"changes by 1 %."
    )
    if strongest[1] >= 0.1:
        reason = (
            f" Modes do depend on it, {strongest[0]} most ({strongest[1]:.2f}), but they are met by several "
            "values, or not known precisely enough, or depend alike on other constants."
        )
    return text(head, "not determined.", reason)


def _strongest(key: str, values: Sensitivity | None) -> tuple[str, float] | None:
    """The mode that reacts most to a constant, and by how much."""
    if values is None or key not in values.constants or not values.modes:
        return None
    column = values.constants.index(key)
    reactions = [abs(row[column]) for row in values.values]
    largest = max(reactions)
    return values.modes[reactions.index(largest)], largest
