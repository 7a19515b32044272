"""What costs little on a later step, sought more thoroughly where nothing leaves as little as noise.

A winding has many valleys: of a soft end winding one start in four leads to the right one, and the first six of a
search may all lead elsewhere. More of them are too dear for every diagnosis, and little beside what follows otherwise:
arcs of lost contact, pairs.
"""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.diagnose.fits.explanations import (
    ADEQUATE,
    WELL,
    Explanation,
    best_narrowed,
    explained,
    nothing,
)
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.fits.valleys import ALIKE
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.searches.refit_starts import Start, cheap_starts, shared_by
from statorhom.diagnose.searches.searched_starts import searched_starts
from statorhom.physics.candidate import Candidate

SEED = 1  # other points than those that were tried
REFITTED = 24  # of them that are followed in wide valleys
NARROWED = 4  # that are followed into narrower ones


def sought_thoroughly(
    base: Refit, found: Sequence[Explanation], candidates: Sequence[Candidate], counts: dict[str, int]
) -> list[Explanation]:
    """Explanations by effects on later steps that are better than what is known.

    Parameters
    ----------
    base : the declared model.
    found : explanations beside it, the best first.
    candidates : all effects.
    counts : effect → number of its candidates, over which its prior is spread.
    """
    none = nothing(base)
    best = found[0] if found else none
    settled = best.adequacy_but_one > WELL or none.adequacy > ADEQUATE
    if settled or not isinstance(base.hypothesis, Hypothesis):
        return []
    later = {stage.name for stage in base.hypothesis.study.stages[1:]}
    begun = cheap_starts(base, [c for c in candidates if c.stage in later])
    again = side_by_side(best_of_many, begun, shared_by(begun))
    better = [explained(r, counts) for r in again if r is not None]
    return [e for e in better if e.log_evidence > best.log_evidence]


def best_of_many(start: Start) -> Refit | None:
    """The best optimum that many points all over the prior of the step lead to."""
    found = searched_starts(start.hypothesis, start.z, SEED, REFITTED)
    alike = [rough for rough in found[:NARROWED] if rough.objective <= found[0].objective + ALIKE]
    return best_narrowed(start.hypothesis, alike)
