"""Search by response surface: what was solved, how well the surfaces predict, which modes contest the constants."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.report.context import Step
from statorhom.report.document import (
    Block,
    Column,
    Paragraph,
    Picture,
    Row,
    Section,
    Table,
    Text,
    strong,
    text,
    warning,
)
from statorhom.report.figures.pareto_plot import pareto_plot, pareto_width
from statorhom.report.wording import frequency, plural
from statorhom.results import BandSummary, SurfaceSummary

_DESIGNS = {
    "latin_hypercube": "Latin hypercube",
    "full_factorial": "full factorial design",
    "sparse_grid": "sparse grid",
}


def surface(steps: Sequence[Step]) -> Section | None:
    """A part per step whose constants were sought on response surfaces."""
    blocks: list[Block] = []
    for step in steps:
        found = None if step.result.fit is None else step.result.fit.surface
        if found is not None:
            blocks += [Paragraph(text(f"Step {step.result.name}"), "heading"), *_step(found)]
    if not blocks:
        return None
    lead = text(
        "The full model was solved at the points of a design of experiments over the ranges of the constants, and a "
        "surface was fitted to every mode’s frequency. A genetic algorithm (NSGA-II) sought constants on "
        "the surfaces that meet all modes; what it found was polished and verified on the model itself."
    )
    return Section("Search by response surface", (Paragraph(lead, "lead"), *blocks))


def _step(found: SurfaceSummary) -> list[Block]:
    blocks: list[Block] = [Paragraph(_gate(found)), _rounds(found)]
    if found.at_limits:
        ends = ", ".join(found.at_limits)
        blocks.append(
            Paragraph(text(warning(f"The search ended at the end of the range of {ends}; widen it.")))
        )
    if len(found.objectives) > 1 and found.front_percent:
        caption = text(
            "Pareto front: each dot is a set of constants of which no other one meets all modes better; the ring is "
            "the one with the least sum of squares. Dots near both zeros say that the two modes do not contest."
        )
        alt = "Pareto front of the search, pairs of modes against each other"
        content = pareto_plot(found.objectives, found.front_percent)
        blocks.append(Picture(content, "svg", pareto_width(len(found.objectives)), alt, caption))
    blocks += _band(found)
    return blocks


def _gate(found: SurfaceSummary) -> Text:
    last = found.rounds[-1]
    solves = strong(f"{plural(found.full_solves, 'full solve')}")
    head = text(
        f"{_DESIGNS.get(found.design, found.design)}; {found.surface}; ",
        solves,
        f", {found.check_points} of them at points that no surface was fitted to. ",
    )
    said = f"There the surfaces are wrong by at most {_error(last.largest_error_percent)} %"
    if found.passed:
        enlarged = len(found.rounds) - 1
        more = f" after the design was enlarged {_times(enlarged)}" if enlarged else ""
        return text(head, f"{said}, less than the {found.limit_percent:g} % asked for{more}.")
    return text(
        head,
        warning(
            f"{said}, more than the {found.limit_percent:g} % asked for, with all points that were allowed."
        ),
    )


def _error(percent: float) -> str:
    return f"{percent:.2f}" if percent >= 0.01 else "under 0.01"


def _times(count: int) -> str:
    return {1: "once", 2: "twice"}.get(count, f"{count} times")


def _rounds(found: SurfaceSummary) -> Table:
    columns = (Column(text("Points of the design"), "right"), Column(text("Largest error in %"), "right"))
    rows = tuple(Row((text(str(r.points)), text(_error(r.largest_error_percent)))) for r in found.rounds)
    errors = ", ".join(f"{name} {_error(error)} %" for name, error in found.errors_percent.items())
    return Table(columns, rows, text(f"Errors of the last design: {errors}."))


def _band(found: SurfaceSummary) -> list[Block]:
    if found.band is None:
        return [Paragraph(text(f"No {found.band_remark}"), "note")] if found.band_remark else []
    band = found.band
    inside = sum(m.inside for m in band.modes)
    power = {1: "straight line", 2: "parabola"}.get(band.degree, f"polynomial of degree {band.degree}")
    verdict = text(
        f"A {power} through the measured frequencies over the mode’s number has R² = {band.r_squared:.4f}. ",
        strong(f"{inside} of {len(band.modes)} verified frequencies"),
        f" lie in its {100 * band.confidence:.0f} % confidence interval. The interval is as wide as the frequencies "
        "scatter about the line, which is no measurement’s scatter: to lie outside says much, to lie inside little.",
    )
    return [Paragraph(verdict), _band_table(band)]


def _band_table(band: BandSummary) -> Table:
    columns = (
        Column(text("No."), "right"),
        Column(text("Mode")),
        Column(text("Measured in Hz"), "right"),
        Column(text("Interval in Hz"), "right"),
        Column(text("Verified in Hz"), "right"),
        Column(text("Inside")),
    )
    rows = tuple(
        Row(
            (
                text(str(m.number)),
                text(m.mode),
                text(frequency(m.measured_hz)),
                text(f"{frequency(m.low_hz)} … {frequency(m.high_hz)}"),
                text(frequency(m.verified_hz)),
                text("yes") if m.inside else text(warning("no")),
            )
        )
        for m in band.modes
    )
    return Table(
        columns, rows, text("Verified frequencies against the confidence interval of the measured ones.")
    )
