"""The report of a study as a document, from its results folder alone."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from statorhom.report.context import Step, coupon_of, steps_of
from statorhom.report.document import Document, Section
from statorhom.report.sections.assumptions import assumptions
from statorhom.report.sections.damping import damping
from statorhom.report.sections.glossary import glossary
from statorhom.report.sections.masses import masses
from statorhom.report.sections.material_tests import material_tests
from statorhom.report.sections.materials import materials
from statorhom.report.sections.mesh import mesh
from statorhom.report.sections.modes import modes
from statorhom.report.sections.sensitivity import sensitivity
from statorhom.report.sections.shapes import shapes
from statorhom.report.sections.spectra import spectra
from statorhom.report.sections.summary import summary
from statorhom.report.sections.surface import surface
from statorhom.report.wording import WING
from statorhom.results import Results
from statorhom.study.message import one_line


def compose(results: Results, folder: Path) -> Document:
    """All sections, in the order in which a reader asks.

    Raises
    ------
    ResultsError
        If a shape file is damaged.
    """
    steps = steps_of(results, folder)
    candidates: tuple[Section | None, ...] = (
        summary(steps),
        masses(results, steps),
        materials(steps),
        modes(steps),
        shapes(steps),
        spectra(steps),
        mesh(steps),
        surface(steps),
        material_tests(steps),
        sensitivity(steps),
        damping(steps),
        assumptions(steps),
        glossary(steps),
    )
    sections = tuple(section for section in candidates if section is not None)
    return Document(
        f"Material{'s' if coupon == WING else ''} of a {coupon}, from its weight and its modes"
        if (coupon := coupon_of(steps)) is not None
        else "Materials of a stator, from its weight and its modes",
        one_line(results.study),
        _facts(results, steps),
        sections,
    )


def _facts(results: Results, steps: Sequence[Step]) -> tuple[tuple[str, str], ...]:
    return (
        ("Steps", one_line(", ".join(step.result.name for step in steps)) or "none yet"),
        ("Seed", str(results.seed)),
        ("Program", one_line(results.program) or "statorhom"),
    )
