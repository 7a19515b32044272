"""The effects of a pair, each alone from the pair's constants.

A second effect may do no more than lead the constants into a better valley, where the other one explains everything
without it: beside the declared winding, whose constants had run away, neither was seen at its best.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.fits.absence import without
from statorhom.diagnose.fits.explanations import PAIR_GAIN, Explanation, explained


def with_both_needed(pairs: Sequence[Explanation], counts: dict[str, int]) -> list[Explanation]:
    """Pairs, the best first; where the best one gains too little over one of its effects alone, that one instead.

    Parameters
    ----------
    pairs : the best first.
    counts : effect → number of its candidates, over which its prior is spread.
    """
    singles = alone(pairs[0], counts) if pairs else []
    if singles and singles[0].log_evidence > pairs[0].log_evidence - PAIR_GAIN:
        return singles[:1]
    return list(pairs)


def without_idle_partners(found: Sequence[Explanation]) -> list[Explanation]:
    """Explanations without the pairs that gain too little over one of their effects alone.

    A single effect may come to more in models of its own than where the pair was found; a pair that holds it and says
    little more contradicts no name of it.
    """
    singles = {
        e.effects: e.log_evidence for e in sorted(found, key=lambda e: e.log_evidence) if not e.is_pair
    }
    return [
        e
        for e in found
        if not e.is_pair
        or all(e.log_evidence > singles.get((name,), -np.inf) + PAIR_GAIN for name in e.effects)
    ]


def alone(pair: Explanation, counts: dict[str, int]) -> list[Explanation]:
    """Refits of each effect of a pair without the other one, in the pair's model, the best first.

    Parameters
    ----------
    pair : two effects at their optimum.
    counts : effect → number of its candidates, over which its prior is spread.
    """
    found = [
        replace(explained(again, counts), settled=pair.settled)
        for left_out in range(len(pair.candidates))
        if (again := without(pair.refit, left_out)) is not None
    ]
    return sorted(found, key=lambda e: -e.log_evidence)
