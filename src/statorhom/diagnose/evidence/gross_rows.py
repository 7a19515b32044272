"""What no explanation explains tells nothing of which of them is right.

A line with a wrong name, or a mode that the mesh gets wrong, is off by many standard deviations whatever is left out.
An effect that happens to bend it a little would lead by that alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from statorhom.diagnose.evidence.held_out import Group
from statorhom.diagnose.evidence.held_out_modes import refit_held
from statorhom.diagnose.fits.explanations import Explanation, explained
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.measured.feature import Feature
from statorhom.errors import StatorhomError

GROSS, LEFT = 3.5, 2.0  # standard deviations in the declared model, and of what an explanation leaves of it
MOST = 1  # gross errors that are set aside; more of them are missing physics
NEAR = 30.0  # log evidence behind the first, up to which explanations are compared


def without_gross_rows(
    base: Refit, found: Sequence[Explanation], counts: dict[str, int]
) -> list[Explanation]:
    """Explanations by the evidence of what at least one of them explains, the best first.

    Parameters
    ----------
    base : the declared model.
    found : the best first.
    counts : effect → number of its candidates, over which its prior is spread.
    """
    leaders = [e for e in found if e.log_evidence > found[0].log_evidence - NEAR]
    if len(leaders) < 2:
        return list(found)
    gross = _beyond(base, GROSS)
    for e in leaders:
        gross &= _beyond(e.refit, LEFT)
    if not 0 < len(gross) <= MOST:
        return list(found)
    # the same for all of them, and for the declared model: the row stays as unlikely as that one finds it
    cost = 0.5 * sum(f.residual**2 for f in _frequencies(base) if f.group in gross)
    again = [_compared(e, gross, cost, counts) if e in leaders else e for e in found]
    return sorted(again, key=lambda e: -e.log_evidence)


def _frequencies(found: Refit) -> list[Feature]:
    features = found.hypothesis.features(found.z)
    return [f for f in features if f.kind == "frequency" and not f.lost and not f.third]


def _beyond(found: Refit, most: float) -> frozenset[Group]:
    return frozenset(f.group for f in _frequencies(found) if abs(f.residual) > most)


def _compared(e: Explanation, gross: frozenset[Group], cost: float, counts: dict[str, int]) -> Explanation:
    try:
        rest = refit_held(replace(e.refit.hypothesis, left_out=gross), e.refit.z)
    except StatorhomError:
        return e
    return replace(e, log_evidence=explained(rest, counts).log_evidence - cost, compared=rest)
