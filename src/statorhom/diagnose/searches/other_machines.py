"""Wrong dimensions sought on machines to either side of the typed one, where nothing explains that is seen from there.

Constants that had made up for a wrong dimension stand in a valley of their own, which a small step does not leave. The
first tested step alone says which machine it is: it has few constants, and its model is soon made.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product

import numpy as np

from statorhom.diagnose.fits.explanations import ADEQUATE, blank, explained, refitted, through_wide_valleys
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.own_model import on_its_own_machine
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.searches.own_machine import PART, Beside, on_its_machine
from statorhom.diagnose.searches.refit_starts import Start, last_action, shared_by
from statorhom.errors import StatorhomError

FACTORS = 0.92, 1.08  # times the typed dimension: from there a cubic reaches to about a sixth of it
FOLLOWED = 2  # of what the first step alone likes best
WHOLE, MOST = ("frequency", "density"), 0.5  # kinds of features that a dimension moves; part of the misfit


def on_other_machines(base: Refit, starts: Iterable[Start], beside: Beside) -> list[Refit]:
    """Optima with dimensions of the first step, on machines of their own; none where that step is no reason for them.

    Parameters
    ----------
    base : the declared model.
    starts : of candidates, of which those count that correct a dimension of the first tested step.
    beside : more optima of a hypothesis, beside constants of later steps.
    """
    if not isinstance(base.hypothesis, Hypothesis) or not _keeps_symmetry(base):
        return []
    first = base.hypothesis.study.stages[0].name
    tasks = list(product((s for s in starts if _corrects(s, first)), FACTORS))
    declared = refitted(_alone(blank(base.hypothesis, base.hypothesis.candidates)), base.z) if tasks else None
    if declared is None:
        return []
    found = side_by_side(lambda task: _of_first_step(*task), tasks, shared_by([start for start, _ in tasks]))
    liked = sorted(
        ((left, number) for number, (left, _) in enumerate(found) if left < PART * declared.objective),
    )
    followed: list[Refit] = []
    for _, number in liked[:FOLLOWED]:
        there = on_its_machine(tasks[number][0].hypothesis, found[number][1], base.objective, beside)
        followed += [] if there is None else [there]
        # one row of a wrong machine may be off so far that the others are met
        if there is not None and explained(there, {}).adequacy > ADEQUATE:
            break
    return followed


def _keeps_symmetry(base: Refit) -> bool:
    """Whether most of what is left is of frequencies and weights: dimensions part no doublets."""
    features = base.hypothesis.features(base.z)
    whole = sum(f.residual**2 for f in features if f.kind in WHOLE)
    return whole > MOST * sum(f.residual**2 for f in features)


def _corrects(start: Start, stage: str) -> bool:
    return bool(last_action(start).dimensions) and start.hypothesis.candidates[-1].stage == stage


def _alone(hypothesis: Hypothesis) -> Hypothesis:
    """Of the first tested step alone."""
    return hypothesis.with_stages(hypothesis.study.stages[:1])


def _of_first_step(start: Start, factor: float) -> tuple[float, np.ndarray]:
    """What a dimension near a part of the typed one leaves of the first step, and where; infinite where nothing can.

    From typical constants, and from those of the typed machine, of which a dimension leaves some where they belong.
    """
    alone, typical = _alone(start.hypothesis), np.zeros_like(start.z)
    (value,) = alone.candidates[-1].parameters
    assert value.absent is not None
    typical[-1] = value.internal(factor * value.absent)
    try:
        drawn = on_its_own_machine(alone, typical)
    except StatorhomError:
        return np.inf, typical
    begun = typical, np.append(start.z[:-1], typical[-1])
    found = [r for z in begun if (r := through_wide_valleys(drawn, z)) is not None]
    best = min(found, key=lambda r: r.objective, default=None)
    return (np.inf, typical) if best is None else (best.objective, best.z)
