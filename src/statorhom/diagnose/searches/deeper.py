"""What leads and leaves more than right explanations leave is wrong, or stands in a side valley.

A lump, a strip or a suspension has few parameters, and a table's few lines leave them wide open: what they do bends,
and there are valleys that no refit has seen. So points are drawn over the profile, where it is deep and all over the
prior, and the explanation goes to the best of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.fits.explanations import UNUSUAL, Explanation, refitted
from statorhom.diagnose.fits.importance import draws_of
from statorhom.diagnose.fits.profile import Profile
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.searches.refit_starts import MIDDLING, price_of

DEEPER = 1.0  # of the objective, by which another valley is deeper
ROUNDS = 3


def in_its_deepest_valley(found: Sequence[Explanation], seed: int) -> list[Explanation]:
    """Explanations, the best first, with what leads in the deepest valley that is found.

    Parameters
    ----------
    found : the best first.
    seed : of the draws.
    """
    if not found or found[0].adequacy_but_one > UNUSUAL or not is_sought(found[0]):
        return list(found)
    lead, *others = found
    best = lead.refit
    for _ in range(ROUNDS):
        deeper = _deeper(Profile.of(best), seed)
        if deeper is None:
            break
        best = deeper
    return [lead.at(best), *others]


def is_sought(e: Explanation) -> bool:
    """Whether it is one effect at a place that breaks the symmetry, free in all its parameters, and every row counts.

    Arcs of lost contact are predicted in bases that know nearby ones alone.
    """
    if len(e.candidates) != 1 or not e.candidates[0].located:
        return False
    if e.compared is not None or not e.refit.hypothesis.whole:
        return False
    return price_of(e.refit.hypothesis.actions(e.refit.z)[0]) == MIDDLING


def _deeper(profile: Profile, seed: int) -> Refit | None:
    """The optimum at the best of what is drawn; None where that is no other."""
    prior = profile.prior
    rng = np.random.default_rng(seed)
    drawn = draws_of(profile.log_likelihood, prior, profile.middle, profile.covariance, rng)
    there = int(np.argmax(drawn.log_likelihoods + prior.log_density(drawn.points)))
    best, before = profile.best(drawn.points[there]), profile.optimum.objective - DEEPER
    if best is None or best[1] >= before:
        return None
    again = refitted(replace(profile.optimum.hypothesis, held=None), best[0])
    if again is None or again.objective > before:
        return None
    # a deeper one may be so narrow that nothing speaks for it
    return again if again.log_evidence > profile.optimum.log_evidence else None
