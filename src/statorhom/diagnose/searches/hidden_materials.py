"""An effect on the materials that another effect hides: sought where valleys are wide, and beside it the other one.

A lump that parts the doublets of a stack whose sheets slide moves their frequencies by more than a refit of the sheets
alone forgives, and beside the declared material no lump explains anything. In wide valleys a few per cent do not count:
there the materials are found first, and in their own model what else there is.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from statorhom.diagnose.evidence.held_out_lines import unseen_modes
from statorhom.diagnose.fits.explanations import (
    ADEQUATE,
    PAIR_GAIN,
    Explanation,
    blank,
    explained,
    widened,
)
from statorhom.diagnose.fits.own_model import in_its_own_model
from statorhom.diagnose.fits.refit import Refit, evaluated
from statorhom.diagnose.located.scan import left_over
from statorhom.diagnose.searches.alone import with_both_needed
from statorhom.diagnose.searches.leading_effects import Leading
from statorhom.diagnose.searches.refit_starts import CHEAP, is_poor, price, searched, starts_of
from statorhom.diagnose.searches.second_effects import may_be_added, second_effects
from statorhom.errors import StatorhomError

GAIN = 20.0  # of the objective in wide valleys, from which on other materials are worth a model of their own


def beside_hidden_materials(
    leading: Leading, best: Explanation, counts: dict[str, int], seed: int
) -> tuple[list[Explanation], bool]:
    """Pairs of an effect on the materials and another one, the best first, and whether unseen modes confirm them.

    Or the one of the two that needs no other one.
    None where the best explanation is adequate, or no pair explains more.

    Parameters
    ----------
    leading, best : the single effects, and the best explanation so far.
    counts, seed : as for `leading_effects`.
    """
    base = leading.base.free
    if best.adequacy_but_one >= ADEQUATE or not is_poor(base):
        return [], True
    found: list[Explanation] = []
    for first in _with_other_materials(leading, counts):
        left = left_over(may_be_added(first, leading.scan), base, first.refit, seed)
        found += second_effects(first, left, counts)
    enough = (e for e in found if e.log_evidence > best.log_evidence + PAIR_GAIN)
    pairs = with_both_needed(sorted(enough, key=lambda e: -e.log_evidence), counts)
    if not pairs or not pairs[0].is_pair:
        return pairs, True
    unseen = unseen_modes(best.refit, pairs[0])
    return pairs, unseen.falls and not unseen.worsens


def _with_other_materials(leading: Leading, counts: dict[str, int]) -> Iterator[Explanation]:
    """Effects on the materials as wide valleys find them, each in the model of these materials."""
    base = leading.base.free
    declared = widened(blank(base.hypothesis, ()), base.z)
    for signature in leading.scan.of_every_candidate():
        start = starts_of(base, leading.scan, signature)[0]
        if start.hypothesis.actions(start.z)[0].materials is None or price((0.0, [start])) != CHEAP:
            continue
        roughs = [s.rough for s in searched(start) if s.rough is not None]
        if declared is None or not roughs or declared.objective - roughs[0].objective < GAIN:
            continue
        first = _in_narrow_valleys(roughs[0], base)
        if first is not None:
            yield explained(first, counts)


def _in_narrow_valleys(rough: Refit, base: Refit) -> Refit | None:
    """What wide valleys found, held where it is: a refit of the effect alone would run away from there."""
    own = replace(base.hypothesis, candidates=rough.hypothesis.candidates, study=rough.hypothesis.study)
    try:
        return evaluated(in_its_own_model(own, rough.z), rough.z)
    except (StatorhomError, KeyError):
        return None
