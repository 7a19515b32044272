"""The other effects once more, from the constants beside which the best one was found.

Where the declared model stands in a wrong valley, the first effect that leads into the right one looks unique: the
others were sought from elsewhere. A mass that does not move and one that was typed wrongly are the same to all modes.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.diagnose.fits.explanations import Explanation, blank, explained, refitted
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.fits.valleys import nearest_first
from statorhom.diagnose.located.scan import Scan, Signature
from statorhom.diagnose.searches.refit_starts import CHEAP, Start, last_action, price

MOVED = 1.0  # prior standard deviations between the constants of two valleys
RIVAL = 20.0  # of the objective: what does not come so near to the best is given up


def from_the_best(
    base: Refit, found: Scan, explanations: Sequence[Explanation], counts: dict[str, int]
) -> list[Explanation]:
    """The explanations, those with other effects that cost little replaced where the best one's constants are better.

    Parameters
    ----------
    base : the declared model's optimum.
    found : the scan there.
    explanations : by single effects.
    counts : effect → number of its candidates, over which its prior is spread.
    """
    best = max(explanations, key=lambda e: e.log_evidence, default=None)
    constants = len(base.z)
    if best is None or np.linalg.norm(best.refit.z[:constants] - base.z) <= MOVED:
        return list(explanations)
    known = {e.label: e for e in explanations}
    own: dict[str, list[Signature]] = {}
    for signature in found.signatures:
        own.setdefault(signature.candidate.label, []).append(signature)
    for label, signatures in own.items():
        if label != best.label and (again := _beside(base, best, signatures)) is not None:
            other = explained(again, counts)
            if label not in known or other.log_evidence > known[label].log_evidence:
                known[label] = other
    return list(known.values())


def _beside(base: Refit, best: Explanation, signatures: Sequence[Signature]) -> Refit | None:
    """An effect's optimum next to the best one's constants; None where its trial would be dear, or promises nothing."""
    candidate = signatures[0].candidate
    hypothesis = blank(best.refit.hypothesis, (*base.hypothesis.candidates, candidate))
    points = [np.r_[best.refit.z[: len(base.z)], s.start] for s in signatures]
    begun = Start(hypothesis, points[0])
    if price((0.0, [begun])) != CHEAP or last_action(begun).dimensions:
        return None
    nearest = nearest_first(hypothesis, points)[:1]
    return refitted(hypothesis, nearest[0], best.refit.objective + RIVAL) if nearest else None
