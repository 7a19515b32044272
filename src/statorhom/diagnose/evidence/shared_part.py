"""What of the machine or of the measurement is concerned, where several effects would explain the misfit.

A lump, a strip and an oval yoke may part a few doublets alike: that it is one of these, and nothing of the supports or
of the winding, may be sure all the same. A part has to pass the rules of a name, with the effects of other parts as
its rivals.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.special import logsumexp

from statorhom.diagnose.evidence.decision import Evidence, decide
from statorhom.diagnose.evidence.resampling import stability
from statorhom.diagnose.fits.explanations import Explanation
from statorhom.physics.library import part_of

COMPARED = 2  # rivals in resamplings

Parts = frozenset[str]


def shared_part(
    evidence: Evidence, found: Sequence[Explanation], none: Explanation, seed: int
) -> tuple[str, ...]:
    """Parts that every likely explanation concerns; empty where that is not sure either.

    Parameters
    ----------
    evidence : of the best explanation.
    found : explanations, the best first.
    none : the declared model.
    seed : of resamplings.
    """
    own = _parts(found[0])
    if not own.isdisjoint(found[0].effects):  # an effect that is like no other
        return ()
    rivals = _of_other_parts(own, found)
    alone = replace(
        evidence,
        over_others=_total(found, own) - max((_total(found, parts) for parts in rivals), default=-np.inf),
        stability=stability([found[0], none, *list(rivals.values())[:COMPARED]], seed),
    )
    return tuple(sorted(own)) if decide(alone) == "named" else ()


def _of_other_parts(own: Parts, found: Sequence[Explanation]) -> dict[Parts, Explanation]:
    """The best explanation by every combination of parts that does not hold all of these, the best first."""
    rivals: dict[Parts, Explanation] = {}
    for e in sorted(found, key=lambda e: -e.log_evidence):
        if not own <= _parts(e):
            rivals.setdefault(_parts(e), e)
    return rivals


def _total(found: Sequence[Explanation], parts: Parts) -> float:
    """ln Z of all explanations that concern these parts."""
    return float(logsumexp([e.log_evidence for e in found if _parts(e) == parts]))


def _parts(e: Explanation) -> Parts:
    return frozenset(map(part_of, e.effects))
