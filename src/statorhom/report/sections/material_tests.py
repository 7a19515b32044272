"""Identified constants beside mechanical tests of samples."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.report.context import Step
from statorhom.report.document import Block, Column, Paragraph, Row, Section, Table, text
from statorhom.report.wording import constant_interval, constant_symbol, constant_value, frequency
from statorhom.results import MaterialTest, TestedFrequency


def material_tests(steps: Sequence[Step]) -> Section | None:
    """Tables per step that names such tests."""
    blocks: list[Block] = []
    for step in steps:
        if step.result.material_tests:
            blocks += [
                Paragraph(text(f"Step {step.result.name}"), "heading"),
                _tests(step.result.material_tests),
            ]
            if step.result.tested_frequencies:
                blocks.append(_frequencies(step.result.tested_frequencies))
    if not blocks:
        return None
    lead = text(
        "Samples were tested mechanically. The tests decided nothing here: the first table sets them beside what the "
        "modes say, the second says which frequencies the tests’ mean values would give."
    )
    return Section("Comparison with material tests", (Paragraph(lead, "lead"), *blocks))


def _tests(found: Sequence[MaterialTest]) -> Table:
    heads = (
        "Region",
        "Constant",
        "Test",
        "Tested",
        "Samples",
        "Identified",
        "90 % interval",
        "Difference in %",
    )
    rows = []
    for t in found:
        c, known = t.identified, t.low is not None and t.high is not None
        samples = f"{constant_value(t.constant, t.low or 0.0)} … {constant_value(t.constant, t.high or 0.0)}"
        rows.append(
            Row(
                (
                    text(t.region),
                    constant_symbol(t.constant),
                    text(t.name),
                    text(constant_value(t.constant, t.value)),
                    text(samples if known else ""),
                    text(constant_value(t.constant, c.value, c.ci90)),
                    text(
                        constant_interval(t.constant, c.value, c.ci90)
                        if c.status != "fixed"
                        else "prescribed"
                    ),
                    text(f"{t.difference_percent:.2f}"),
                )
            )
        )
    caption = text("Difference: |identified − tested| / tested.")
    return Table(
        tuple(Column(text(h), "right" if h == heads[-1] else "left") for h in heads), tuple(rows), caption
    )


def _frequencies(found: Sequence[TestedFrequency]) -> Table:
    heads = (
        "Mode",
        "Measured in Hz",
        "Identified in Hz",
        "Difference in %",
        "Tests’ values in Hz",
        "Difference in % ",
    )
    rows = tuple(
        Row(
            (
                text(f.mode),
                text(frequency(f.measured_hz)),
                text(frequency(f.identified_hz)),
                text(f"{f.identified_percent:.2f}"),
                text(frequency(f.tests_hz)),
                text(f"{f.tests_percent:.2f}"),
            )
        )
        for f in found
    )
    return Table(tuple(Column(text(h.strip()), "right" if i else "left") for i, h in enumerate(heads)), rows)
