"""The best explanation with one more effect: sought like a single one, with the first effect free all the time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from statorhom.diagnose.evidence.decision import MAX_T_P, OVER_NOTHING, STABLE, too_few
from statorhom.diagnose.evidence.held_out_lines import unseen_modes
from statorhom.diagnose.evidence.repeated_null import with_repeated_null
from statorhom.diagnose.evidence.resampling import stability
from statorhom.diagnose.fits.explanations import ADEQUATE, PAIR_GAIN, Explanation, explained, nothing
from statorhom.diagnose.located.scan import Scan, left_over
from statorhom.diagnose.searches.alone import with_both_needed
from statorhom.diagnose.searches.leading_effects import Leading
from statorhom.diagnose.searches.refit_starts import WORTH, in_order
from statorhom.diagnose.searches.sharper import sharpened
from statorhom.diagnose.searches.single_effects import refits

SECONDS = 5  # effects that are tried beside the first
OWN_MODELS = 2  # pairs that get models of their own before they are compared


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
    if first.adequacy_but_one < ADEQUATE:
        found = _in_own_models(found, counts)
    enough = [e for e in found if e.log_evidence > first.log_evidence + PAIR_GAIN]
    return sorted(enough, key=lambda e: -e.log_evidence)


def _in_own_models(pairs: Sequence[Explanation], counts: dict[str, int]) -> list[Explanation]:
    """Pairs of which one effect breaks the symmetry of materials that the other one changes, each at its own materials.

    What breaks the symmetry is solved at the materials of the first alone: where these were far off, the right pair
    explains less than a wrong effect alone.
    """
    far = sorted((e for e in pairs if _breaks_what_changes(e)), key=lambda e: e.refit.objective)[:OWN_MODELS]
    return [e if e not in far else explained(sharpened(e, leads=False).refit, counts) for e in pairs]


def _breaks_what_changes(pair: Explanation) -> bool:
    actions = pair.refit.hypothesis.actions(pair.refit.z)[: len(pair.candidates)]
    return any(a.changes for a in actions) and any(a.materials for a in actions)


def confirmed_pairs(
    leading: Leading, first: Explanation, counts: dict[str, int], seed: int
) -> tuple[list[Explanation], bool]:
    """An explanation with one more effect, the best first, and whether modes that it did not see confirm that.

    Or the one of the two that needs no other one, from the constants that the pair led to. None where unseen modes
    contradict; nor where the first alone leaves no more than noise, or one gross error, and is hardly better than
    nothing, what it leaves is no trace of a second one, resampled data can do without that, or unseen modes do not
    confirm it.

    Parameters
    ----------
    leading, first : the single effects, and the best of them.
    counts, seed : as for `leading_effects`.
    """
    enough, none = first.adequacy_but_one >= ADEQUATE, nothing(leading.base.refit)
    if enough and first.log_evidence - none.log_evidence < OVER_NOTHING:
        return [], True
    left = left_over(may_be_added(first, leading.scan), leading.base.free, first.refit, seed)
    if enough and with_repeated_null(first.refit, left, seed).p_value >= MAX_T_P:
        return [], True
    pairs = with_both_needed(second_effects(first, left, counts), counts)
    if pairs and not pairs[0].is_pair:
        return pairs, True
    if not pairs or (enough and stability([pairs[0], none, first], seed) < STABLE):
        return [], True
    # both effects have to hold: the second one against the first alone
    unseen = unseen_modes(first.refit, pairs[0])
    confirmed = unseen.falls and not unseen.worsens
    return (pairs, confirmed) if confirmed or (too_few(unseen) and not enough) else ([], True)
