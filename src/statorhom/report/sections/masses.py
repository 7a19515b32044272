"""Weights of the steps and the densities that follow from them."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.report.context import Step, coupon_of
from statorhom.report.document import (
    Block,
    Column,
    Notice,
    Paragraph,
    Row,
    Section,
    Table,
    Text,
    muted,
    strong,
    text,
)
from statorhom.report.wording import NOTHING, WING, step_words
from statorhom.results import Results

_OF_MASSES = "kg"  # a warning that names a weight or a density concerns this section
_UNITS = {"mm": "mm", "deg": "°", "kg": "kg", "m3": "m³", "m": "m", "hz": "Hz"}


def masses(results: Results, steps: Sequence[Step]) -> Section:
    """Table of weights and densities, the warnings about them, and the machine's dimensions."""
    lead = text(
        "The weight gives the one density that the geometry file leaves open, or scales all of them; “±” is one "
        "standard deviation, which comes from the weighing."
        if coupon_of(steps) == WING
        else "The weight, divided by the volume in the model, is the mean density; “±” is one standard deviation, "
        "which comes from the weighing."
        if coupon_of(steps) is not None
        else "After every step the stator was weighed. What a step added, divided by the volume it fills in the "
        "model, is the mean density of that region; “±” is one standard deviation, which comes from both "
        "weighings."
    )
    blocks: list[Block] = [Paragraph(lead, "lead"), _table(steps)]
    warnings = tuple(
        text(strong(f"{s.result.name}: "), w) for s in steps for w in s.result.warnings if _OF_MASSES in w
    )
    if warnings:
        blocks.append(Notice("Weights and densities to check", warnings, "warning"))
    if results.geometry:
        blocks += [Paragraph(text("The model"), "heading"), _dimensions(results)]
    return Section("Masses and densities", tuple(blocks))


def _table(steps: Sequence[Step]) -> Table:
    columns = (
        Column(text("Step")),
        Column(text("Weight in kg"), "right"),
        Column(text("Added in kg"), "right"),
        Column(text("Region")),
        Column(text("Volume in cm³"), "right"),
        Column(text("Density in kg/m³"), "right"),
    )
    return Table(columns, tuple(row for step in steps for row in _rows(step)))


def _rows(step: Step) -> list[Row]:
    result = step.result
    head = (
        text(strong(result.name), muted(f" {step_words(result.kind)}")),
        text(f"{result.mass_kg:.3f} ± {result.mass_sd_kg:.3f}"),
        text(f"{result.added_mass_kg:.3f}".replace("-", "−")),
    )
    regions = list(step.new_regions.items())
    if not regions:
        return [Row((*head, text(NOTHING), text(NOTHING), text(NOTHING)))]
    rows = []
    for i, (name, region) in enumerate(regions):
        first: tuple[Text, ...] = head if i == 0 else (text(), text(), text())
        volume = text(f"{region.volume_m3 * 1e6:.1f}")
        rows.append(
            Row((*first, text(name), volume, _density(region.density_kg_m3, region.density_sd_kg_m3)))
        )
    return rows


def _density(value: float | None, deviation: float | None) -> Text:
    if value is None:
        return text(muted("not determined"))
    return text(f"{value:.0f}" if not deviation else f"{value:.0f} ± {deviation:.0f}")


def _dimensions(results: Results) -> Table:
    rows = tuple(
        Row((text(_noun(key)), text(_quantity(key, value)))) for key, value in results.geometry.items()
    )
    return Table((Column(text("Property")), Column(text("Value"), "right")), rows)


def _noun(key: str) -> str:
    name, _, unit = key.rpartition("_")
    return (name if name and unit in _UNITS else key).replace("_", " ").replace(".", ": ")


def _quantity(key: str, value: float | int | str) -> str:
    unit = _UNITS.get(key.rpartition("_")[2], "")
    shown = f"{value:g}" if isinstance(value, float) else str(value).replace("_", " ")
    return f"{shown} {unit}".strip() if unit != "°" else f"{shown}°"
