"""What was taken for granted."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.report.context import Step, coupon_of
from statorhom.report.document import Block, Paragraph, Points, Section, strong, text

_ALWAYS = (
    "Small vibrations: stiffness does not depend on the amplitude, the temperature or the frequency.",
    "Every region is one homogeneous material; sheets, wires and resin are not modelled one by one.",
    "Regions that touch are firmly joined.",
    "Damping is small enough not to move the frequencies.",
)

_STATOR = "The machine has the exact symmetry of its slots: no welds, notches, ovality or sensor masses."
_COUPON = "The coupon has exactly the shape of the geometry file: no cut-outs, waviness or sensor masses."


def assumptions(steps: Sequence[Step]) -> Section:
    """Assumptions of every study, and those of the steps."""
    lead = text("The results hold as far as the following does.")
    shape = _STATOR if coupon_of(steps) is None else _COUPON
    blocks: list[Block] = [Paragraph(lead, "lead"), Points(tuple(text(item) for item in (*_ALWAYS, shape)))]
    # most assumptions are those of several steps: each stands once, with the steps it is of
    steps_of: dict[str, list[str]] = {}
    for step in steps:
        for item in step.result.assumptions:
            steps_of.setdefault(item, []).append(step.result.name)
    own = tuple(text(strong(f"{', '.join(names)}: "), item) for item, names in steps_of.items())
    if own:
        blocks += [Paragraph(text("Of the steps"), "heading"), Points(own)]
    return Section("What was assumed", tuple(blocks))
