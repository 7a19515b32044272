"""Words of the report."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.report.context import Step, are_blocks, coupon_of
from statorhom.report.document import Definitions, Section, strong, text

_TERMS = (
    (
        "Mode (r, n)",
        "A natural vibration with r waves around the circumference and n node planes along the axis.",
    ),
    (
        "Doublet",
        "Two modes of the same shape, turned against each other; in a symmetric stator they have one "
        "frequency.",
    ),
    (
        "Step",
        "A stage of fabrication after which the stator was weighed and possibly tested: stack, wound, "
        "impregnated …",
    ),
    (
        "Region",
        "A part of the model with one material: lamination, winding (slots), overhang, frame, machine.",
    ),
    (
        "Homogenized material",
        "One uniform material that moves as the mixture of sheets, wires and resin does. Of round parts, "
        "direction r is radial, θ tangential, z axial.",
    ),
    (
        "Free test",
        "The tested object hangs on something soft and moves as if nothing held it.",
    ),
    (
        "Supported test",
        "The stator is held. The constants come from free tests; supported ones are predicted with them.",
    ),
    (
        "90 % interval",
        "The true value lies inside with a probability of 90 %, if the model is right; standard "
        "deviations are stated as ±.",
    ),
    (
        "Typical range (prior)",
        "Where 90 % of such parts lie before anything is measured; a study may give its own. It keeps "
        "constants that the data do not reach from taking any value.",
    ),
    (
        "Determined by the data",
        "The measurements narrowed the spread to less than a third of the typical one, and the 90 % interval to "
        "3 % of the value or less on either side.",
    ),
    (
        "Fitted, held out, predicted",
        "Used to find the constants; kept back to test them; of a test that was not fitted.",
    ),
    (
        "Rms error",
        "Square root of the mean of the squared errors.",
    ),
    (
        "MAC",
        "Modal assurance criterion: 1 where a measured and a simulated shape agree, 0 where they have "
        "nothing in common.",
    ),
    (
        "Order spectrum",
        "Shares of the waves r = 0, 1, 2 … in a shape’s radial motion around the circumference.",
    ),
    (
        "Loss factor η",
        "Twice the damping ratio.",
    ),
    (
        "Seed",
        "Start of the random numbers; the same seed gives the same results again.",
    ),
)


# what is said of stators only, and of all that is round
_OF_STATORS = {"Step", "Region", "Supported test"}
_OF_ROUND = {"Mode (r, n)", "Doublet", "Order spectrum"}


def glossary(steps: Sequence[Step]) -> Section:
    """Terms in the order in which a reader meets them."""
    left_out = (_OF_STATORS if coupon_of(steps) else set()) | (_OF_ROUND if are_blocks(steps) else set())
    shown = tuple((text(strong(t)), text(d)) for t, d in _TERMS if t not in left_out)
    return Section("Words used", (Definitions(shown),))
