"""Elastic constants of every region after every step, with their intervals."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.errors import MaterialError
from statorhom.materials.typical import prior_range
from statorhom.report.context import Step, coupon_of
from statorhom.report.document import (
    Block,
    Column,
    Fold,
    Paragraph,
    Row,
    Section,
    Span,
    Table,
    Text,
    joined,
    muted,
    strong,
    text,
)
from statorhom.report.figures.interval_bar import interval_bar
from statorhom.report.wording import (
    AXES_OF_BLOCKS,
    AXES_OF_PLIES,
    AXES_OF_ROUND,
    WING,
    constant_interval,
    constant_meaning,
    constant_symbol,
    constant_value,
    rounded,
    symmetry_words,
)
from statorhom.results import Constant, FitSummary, RegionResult, StageResult

_VOIGT = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
_STATUS: dict[str, Span] = {
    "identified": Span("determined by the data", "good"),
    "prior_dominated": Span("not determined", "muted"),
    "fixed": Span("prescribed", "muted"),
}


def materials(steps: Sequence[Step]) -> Section:
    """Table of constants per step and region, Hooke's matrix on demand."""
    lead = text(
        _lead_subject(coupon_of(steps)),
        " is treated as one homogeneous material with the constants below; with "
        "90 % probability the true constant lies in the interval. A constant is ",
        Span("determined by the data", "good"),
        " where the measured modes narrowed it down to a few per cent. Where it is “not determined”, the "
        "fitted modes hardly depend on it, or are met by more than one value; its value is then the most "
        "probable one, and no more than that. In the small plots the line is the interval, the dot the value "
        "(filled: determined) and the grey band the typical range; moduli stand on logarithmic axes in GPa, "
        "each row with its own.",
    )
    blocks: list[Block] = [Paragraph(lead, "lead")]
    for step in steps:
        blocks += _step(step)
    unchanged = [step.result.name for step in steps if not _has_news(step)]
    if unchanged:
        found = f"No elastic constants were determined in: {', '.join(unchanged)}."
        blocks.append(Paragraph(text(found), "note"))
    return Section("Materials", tuple(blocks))


def _lead_subject(coupon: str | None) -> str:
    if coupon == WING:
        return "Every material of the wing"
    return "Every region of the stator" if coupon is None else f"The {coupon}"


def _has_news(step: Step) -> bool:
    return bool(step.new_constants) or step.result.fit is not None


def _step(step: Step) -> list[Block]:
    if not _has_news(step):
        return []
    result = step.result
    blocks: list[Block] = []
    new = step.new_regions
    for name, region in result.regions.items():
        if name in new and region.engineering:
            blocks += _region(step, name, region)
    kept = [name for name, region in result.regions.items() if name not in new and region.engineering]
    if kept:
        blocks.append(Paragraph(text(f"As found in the step before: {', '.join(kept)}."), "note"))
    if result.fit is not None and len(result.fit.optima) > 1:
        blocks.append(_optima(result.fit))
    return [Paragraph(text(f"Step {result.name}"), "heading"), *blocks]


def _region(step: Step, name: str, region: RegionResult) -> list[Block]:
    stage, axes = step.result, _axes(step)
    symmetry = f", {symmetry_words(region.symmetry, axes)}" if region.symmetry else ""
    head = Paragraph(text(strong(name), symmetry), "subheading")
    columns = (
        Column(text("Constant")),
        Column(text("Value"), "right"),
        Column(text("90 % interval"), "right"),
        Column(text("Status")),
        Column(text("Interval and typical range (moduli in GPa)")),
    )
    rows = tuple(_row(stage, name, region, key, c) for key, c in region.engineering.items())
    blocks: list[Block] = [head, Table(columns, rows)]
    if region.hooke_pa is not None:
        blocks.append(_hooke(name, region.hooke_pa, axes))
    return blocks


def _axes(step: Step) -> tuple[str, str, str]:
    """What the material's axes are called; a wing's plies have their own."""
    if step.coupon == WING:
        return AXES_OF_PLIES
    return AXES_OF_BLOCKS if step.is_block else AXES_OF_ROUND


def _row(stage: StageResult, region_name: str, region: RegionResult, key: str, c: Constant) -> Row:
    typical = _typical(region_name, stage.kind, region.symmetry, key)
    interval = text(muted("–")) if c.status == "fixed" else text(constant_interval(key, c.value, c.ci90))
    return Row(
        (
            text(constant_symbol(key), muted(f"  {constant_meaning(key)}")),
            text(strong(constant_value(key, c.value, c.ci90))),
            interval,
            text(_STATUS[c.status]),
            interval_bar(key, c.value, c.ci90, typical, c.status),
        )
    )


def _typical(region: str, kind: str, symmetry: str | None, constant: str) -> tuple[float, float] | None:
    if symmetry is None:
        return None
    try:
        prior = prior_range(region, kind, symmetry, constant)
    except MaterialError:
        return None
    return prior.low90, prior.high90


def _hooke(name: str, matrix: tuple[tuple[float, ...], ...], axes: tuple[str, str, str]) -> Fold:
    indices = tuple(axes[i] + axes[j] for i, j in _VOIGT)
    columns = (Column(text("GPa")), *(Column(text(f"ε {index}"), "right") for index in indices))
    rows = tuple(
        Row((text(f"σ {index}"), *(_entry(value) for value in row)))
        for index, row in zip(indices, matrix, strict=False)
    )
    note = Paragraph(text("Stress is this matrix times strain; shear strains are engineering ones."), "note")
    return Fold(text(f"Hooke’s matrix of the {name}"), (note, Table(columns, rows)))


def _entry(value_pa: float) -> Text:
    return text(muted("0")) if value_pa == 0 else text(rounded(value_pa / 1e9, digits=4).replace("-", "−"))


def _optima(fit: FitSummary) -> Fold:
    note = Paragraph(
        text(
            "The measured frequencies are met by more than one set of constants. The intervals above cover "
            "all of them, weighted by their probability."
        ),
        "note",
    )
    names = list(fit.optima[0].values)
    columns = (
        Column(text("Probability"), "right"),
        Column(text("Cost"), "right"),
        *(Column(_constant_title(name), "right") for name in names),
    )
    rows = tuple(
        Row(
            (
                text(f"{100 * o.probability:.0f} %"),
                text(f"{o.cost:.2f}"),
                *(_optimum_value(name, o.values.get(name)) for name in names),
            )
        )
        for o in fit.optima
    )
    return Fold(text(f"{len(fit.optima)} distinct optima of the fit"), (note, Table(columns, rows)))


def _constant_title(name: str) -> Text:
    region, _, constant = name.rpartition(".")
    return joined([part for part in (text(region), constant_symbol(constant)) if part and part[0].text], " ")


def _optimum_value(name: str, value: float | None) -> Text:
    return text(muted("–")) if value is None else text(constant_value(name.rpartition(".")[2], value))
