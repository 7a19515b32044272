"""What to measure next where several explanations are left, and what each measurement would bring."""

from __future__ import annotations

from statorhom.report.diagnosis.words import effect_words
from statorhom.report.document import Block, Column, Fold, Notice, Row, Table, strong, text
from statorhom.results.diagnosis import Details, Diagnosis

DECISIVE, TELLING = 5.0, 1.0  # log evidence


def next_steps(d: Diagnosis, details: Details) -> list[Block]:
    """The measurement that decides best for its cost, and the others."""
    n = d.next_measurement
    if n is None:
        return []
    what = n.what[:1].upper() + n.what[1:]
    items = [text(strong(f"{what}."))]
    if len(n.separates) > 1:
        first, *rest = (effect_words(name) for name in n.separates)
        items.append(text(f"This tells {first} from {' and '.join(rest)}."))
    if n.expected_log_evidence is not None:
        items.append(text(f"With it the decision would be {worth(n.expected_log_evidence)}."))
    found: list[Block] = [Notice("What to measure next", tuple(items))]
    if len(details.options) > 1:
        rows = tuple(
            Row((text(o.what), text(f"{o.hours:g} h"), text(worth(o.log_evidence)))) for o in details.options
        )
        head = (Column(text("measure")), Column(text("work"), "right"), Column(text("decision")))
        found.append(Fold(text("Other measurements, the most telling per hour first"), (Table(head, rows),)))
    return found


def worth(log_evidence: float) -> str:
    """What a log evidence means."""
    if log_evidence >= DECISIVE:
        return "safe"
    return "likely" if log_evidence >= TELLING else "hardly nearer"
