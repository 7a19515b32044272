"""A diagnosis as sections of a report: what, where, how it looks, how sure, and what the model gains."""

from __future__ import annotations

from statorhom.report.diagnosis.gain_section import gain_section
from statorhom.report.diagnosis.sure_section import sure_section
from statorhom.report.diagnosis.verdict_section import verdict_section
from statorhom.report.diagnosis.what_section import what_section
from statorhom.report.diagnosis.where_section import where_section
from statorhom.report.document import Document, Section
from statorhom.results.diagnosis import Details, Diagnosis
from statorhom.study.message import one_line

ANSWERS = {
    "none": "nothing is missing",
    "named": "named",
    "ambiguous": "cannot be decided yet",
    "unknown": "something unknown is missing",
}


def diagnosis_sections(diagnosis: Diagnosis, details: Details) -> tuple[Section, ...]:
    """All sections, in the order in which a reader asks."""
    candidates = (
        verdict_section(diagnosis, details),
        where_section(diagnosis, details),
        what_section(diagnosis, details),
        sure_section(diagnosis, details),
        gain_section(diagnosis, details),
    )
    return tuple(section for section in candidates if section is not None)


def diagnosis_document(diagnosis: Diagnosis, details: Details) -> Document:
    """A report of the diagnosis alone."""
    return Document(
        f"What the model of a {_body(details)} left out",
        one_line(diagnosis.study),
        diagnosis_facts(diagnosis, details),
        diagnosis_sections(diagnosis, details),
    )


def _body(details: Details) -> str:
    if details.plan is not None:
        return "test piece"
    return "stator" if details.machine is None else details.machine.kind


def diagnosis_facts(diagnosis: Diagnosis, details: Details) -> tuple[tuple[str, str], ...]:
    """The answer in a word, and the time it took."""
    return (("Diagnosis", ANSWERS[diagnosis.verdict]), ("Diagnosed in", f"{details.seconds:.0f} s"))
