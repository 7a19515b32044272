"""The best explanation with one more effect: sought like a single one, with the first effect free all the time."""

from __future__ import annotations

from dataclasses import replace

from statorhom.diagnose.explanations import PAIR_GAIN, Explanation
from statorhom.diagnose.refit_starts import WORTH, in_order
from statorhom.diagnose.scan import Scan
from statorhom.diagnose.single_effects import refits

SECONDS = 5  # effects that are tried beside the first


def may_be_added(first: Explanation, scan: Scan) -> Scan:
    """What of a scan is no effect that the explanation has already, but for those that may stand twice."""
    others = [s for s in scan.signatures if s.candidate.repeats or s.candidate.effect not in first.effects]
    return replace(scan, signatures=tuple(others))


def second_effects(first: Explanation, left: Scan, counts: dict[str, int]) -> list[Explanation]:
    """The first explanation and one more effect, where that adds enough; the best first.

    Parameters
    ----------
    first : the best single effect.
    left : what effects that may be added would take away of the misfit that it leaves.
    counts : effect → number of its candidates, over which its prior is spread.
    """
    favourites = left.worth_refitting(SECONDS, WORTH)[:SECONDS]
    base = first.refit
    found = refits(base, in_order(base, left, favourites), counts, base.objective - 2 * PAIR_GAIN)
    enough = [e for e in found if e.log_evidence > first.log_evidence + PAIR_GAIN]
    return sorted(enough, key=lambda e: -e.log_evidence)
