"""The best single effects, sought beside the best declared model: either may lead to a better one of the other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from statorhom.diagnose.evidence.decision import OVER_NOTHING, is_chance
from statorhom.diagnose.evidence.held_out_name import renames_alone
from statorhom.diagnose.evidence.repeated_null import with_repeated_null
from statorhom.diagnose.fits.baseline import Baseline
from statorhom.diagnose.fits.explanations import ADEQUATE, Explanation, best_of_each, nothing
from statorhom.diagnose.located.scan import Scan, scan
from statorhom.diagnose.searches.approach import Approach
from statorhom.diagnose.searches.beside_typical import beside_typical_materials
from statorhom.diagnose.searches.lacking_modes import lacks_modes
from statorhom.diagnose.searches.leaning_fields import leaning_fields
from statorhom.diagnose.searches.look_alikes import look_alikes
from statorhom.diagnose.searches.lost_contact import with_lost_contact
from statorhom.diagnose.searches.other_valleys import in_other_valleys
from statorhom.diagnose.searches.refit_starts import starts_of
from statorhom.diagnose.searches.single_effects import new_names, refits, single_effects
from statorhom.diagnose.searches.thorough import sought_thoroughly
from statorhom.physics.candidate import Candidate

AGAIN = 2  # times that the declared model is sought where explanations lead


@dataclass(frozen=True, eq=False)
class Leading:
    """Single effects and what they were sought beside.

    Parameters
    ----------
    base : the declared model, in the deepest valley that is known.
    scan : of all effects there.
    unpaired : many measured modes have no partner there.
    found : explanations, the best first.
    elsewhere : labels of those that were found beside the declared model of another valley and are better than this
        one; its signatures do not say what they explain.
    """

    base: Baseline
    scan: Scan
    unpaired: bool
    found: tuple[Explanation, ...]
    elsewhere: frozenset[str] = frozenset()

    def chance(self, best: Explanation) -> float:
        """Of the misfit that the best explanation was found by.

        No signature stands for another valley, nor for another name: their evidence does.
        """
        if renames_alone(best) or best.label in self.elsewhere:
            over = best.log_evidence - nothing(self.base.refit).log_evidence
            return float(np.exp(-max(0.0, over)))
        return self.scan.p_value

    def by_chance(self, best: Explanation) -> bool:
        """Whether nothing is missing whatever the best explanation says."""
        return is_chance(self.chance(best), self.unpaired)

    @property
    def misfit_is_real(self) -> bool:
        """Whether anything is left for an effect to explain."""
        return not is_chance(self.scan.p_value, self.unpaired) or bool(self.elsewhere)


def leading_effects(
    approach: Approach, base: Baseline, candidates: Sequence[Candidate], counts: dict[str, int], seed: int
) -> Leading:
    """Scan and refits beside the declared model, and once more where that turns out to have a deeper valley.

    Parameters
    ----------
    approach, base : the kind of body, and the declared model.
    candidates : all effects.
    counts : effect → number of its candidates, over which its prior is spread.
    seed : of the scan's null distribution.
    """

    def beside_typical(leading: Leading) -> list[Explanation]:
        return beside_typical_materials(leading.base.free, leading.found, candidates, counts)

    def in_deeper_valleys(leading: Leading, times: int) -> Leading:
        for _ in range(times):
            deeper = approach.declared_again(leading.base, leading.found)
            if deeper is None:
                break
            only = leading.found[0].label if _explains(leading.found[0], deeper) else None
            leading = _joined(leading, _beside(deeper, candidates, counts, seed, only=only))
        return leading

    leading = _beside(base, candidates, counts, seed)
    leading = in_deeper_valleys(_with_more(leading, beside_typical(leading)), AGAIN)
    # a deeper valley may be one to which the declared model has fled, too
    if leading.base is not base and (found := beside_typical(leading)):
        leading = in_deeper_valleys(_with_more(leading, found), 1)
    leading = _with_more(leading, sought_thoroughly(leading.base.free, leading.found, candidates, counts))
    leading = _with_more(leading, leaning_fields(leading.base.free, leading.found, candidates, counts))
    leading = _with_more(leading, look_alikes(leading.base.free, leading.found, candidates, counts))
    # what no signature beside the declared winding shows
    return _with_more(leading, with_lost_contact(leading.base.free, leading.found, candidates, counts))


def _beside(
    base: Baseline,
    candidates: Sequence[Candidate],
    counts: dict[str, int],
    seed: int,
    *,
    only: str | None = None,
) -> Leading:
    signatures = scan(base.free, [c for c in candidates if c.parameters], seed)
    signatures = with_repeated_null(base.free, signatures, seed)
    discrete = [c for c in candidates if not c.parameters]
    begun = Leading(base, signatures, lacks_modes(base.free), ())
    if begun.misfit_is_real and only is None:
        found = in_other_valleys(base, single_effects(base.free, signatures, discrete, counts), counts)
    else:
        # no rival but another name can be found any more
        found = [*_of_one(base, signatures, only, counts), *new_names(base.free, discrete, counts)]
    return replace(begun, found=tuple(found))


def _of_one(base: Baseline, found: Scan, label: str | None, counts: dict[str, int]) -> list[Explanation]:
    """The candidate of a label, which may explain as much with other constants, and then with another magnitude."""
    own = [s for s in found.signatures if s.candidate.label == label]
    return refits(base.free, [(s.gain, starts_of(base.free, found, s)) for s in own[:1]], counts)


def _with_more(leading: Leading, more: Sequence[Explanation]) -> Leading:
    """And explanations that were found beside other constants, the better one of every candidate."""
    best = best_of_each((*leading.found, *more))
    labels = {e.label for e in more if best[e.label] is e}
    return replace(leading, found=tuple(best.values()), elsewhere=leading.elsewhere | labels)


def _explains(best: Explanation, deeper: Baseline) -> bool:
    """Whether an explanation leaves nothing to explain and is better than the deeper valley without any.

    Then it needs no rivals from there; otherwise it only stood in for that valley.
    """
    return best.adequacy_but_one > ADEQUATE and best.log_evidence > nothing(deeper.refit).log_evidence


def _joined(before: Leading, now: Leading) -> Leading:
    """What was found in both valleys, the better one of every candidate."""
    least = nothing(now.base.refit).log_evidence + OVER_NOTHING
    best = best_of_each((*before.found, *now.found))
    elsewhere = frozenset(e.label for e in before.found if best[e.label] is e and e.log_evidence > least)
    return Leading(now.base, now.scan, now.unpaired, tuple(best.values()), elsewhere)
