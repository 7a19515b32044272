"""A contact that is lost over an arc, sought beside what is typical of the winding.

The declared model, whose winding holds on everywhere, takes the lost contact for a winding that is ten or fifty times
too soft, and so softly held a winding has no use for a contact that is lost. Where nothing explains the misfit, arcs
are tried beside a winding as windings usually are, in the model of that one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from statorhom.diagnose.constants import new_constants
from statorhom.diagnose.explanations import ADEQUATE, Explanation, blank, explained, nothing, refitted
from statorhom.diagnose.refit import Refit, evaluated
from statorhom.diagnose.refit_starts import Start, start_of
from statorhom.diagnose.scan import starts as scan_starts
from statorhom.diagnose.sharper import in_its_own_model
from statorhom.diagnose.valleys import nearest_first
from statorhom.errors import StatorhomError
from statorhom.physics.candidate import Candidate

WINDINGS = (0.0, 1.0)  # prior standard deviations from the median, of all stiffnesses together
GRID = {"arc_deg": (30.0, 60.0, 100.0, 160.0), "contact_ratio": (3e-3, 3e-4, 3e-5)}
PLACES = 24  # angles of each
FOLLOWED = 3  # starts of one winding
ROUNDS = 2  # models of its own for the best one


def with_lost_contact(
    base: Refit, found: Sequence[Explanation], candidates: Sequence[Candidate], counts: dict[str, int]
) -> list[Explanation]:
    """Arcs of lost contact that explain more than anything that was found, where that leaves much to explain.

    Parameters
    ----------
    base : the declared model.
    found : explanations, the best first.
    candidates : all effects.
    counts : effect → number of its candidates, over which its prior is spread.
    """
    arcs = [c for c in candidates if set(GRID) < {p.name for p in c.parameters}]
    if not arcs:
        return []
    best = found[0] if found else nothing(base)
    if max(best.adequacy_but_one, nothing(base).adequacy) > ADEQUATE:
        return []
    refits = (_beside_typical(base, c) for c in arcs)
    own = (explained(r, counts) for r in refits if r is not None)
    return [e for e in own if e.log_evidence > best.log_evidence]


def _beside_typical(base: Refit, candidate: Candidate) -> Refit | None:
    """The best optimum of an arc, in a model of its own; None where no winding will do."""
    typical = [_with_typical_winding(base, candidate, sds) for sds in WINDINGS]
    starts = [s for t in typical if t is not None for s in _starts(t, candidate)]
    tried = [r for s in starts if (r := refitted(s.hypothesis, s.z)) is not None]
    if not tried:
        return None
    best = min(tried, key=lambda r: r.objective)
    for _ in range(ROUNDS):
        again = refitted(in_its_own_model(best), best.z)
        if again is not None and again.objective < best.objective:
            best = again
    return best


def _with_typical_winding(base: Refit, candidate: Candidate, sds: float) -> Refit | None:
    """The declared model with a winding some standard deviations stiffer than it usually is, in the model of that."""
    study = base.hypothesis.study
    own = [s.setup for s in study.stages if s.setup.keys.name == candidate.stage]
    z = base.z.copy()
    for place in (place for setup in own for place in new_constants(study.constants, setup)):
        z[place] = sds if study.constants.items[place].log else 0.0
    try:
        there = evaluated(blank(base.hypothesis, base.hypothesis.candidates), z)
        return evaluated(in_its_own_model(there, mesh_known=True), z)
    except (StatorhomError, KeyError):
        return None


def _starts(typical: Refit, candidate: Candidate) -> list[Start]:
    """Arcs all around, the best of each width and ratio, and of these the best."""
    begun = start_of(typical, candidate, scan_starts(typical.hypothesis.study, candidate)[0])
    shapes = [dict(zip(GRID, values, strict=True)) for values in product(*GRID.values())]
    nearest = [nearest_first(begun.hypothesis, list(_all_around(begun, s)))[:1] for s in shapes]
    best = nearest_first(begun.hypothesis, [z for found in nearest for z in found])
    return [replace(begun, z=z) for z in best[:FOLLOWED]]


def _all_around(start: Start, shape: dict[str, float]) -> Iterator[np.ndarray]:
    """Coordinates with an arc of some width and ratio at every angle."""
    parameters = start.hypothesis.candidates[-1].parameters
    first = len(start.z) - len(parameters)
    for angle in 2 * np.pi * np.arange(PLACES) / PLACES:
        z, values = start.z.copy(), {**shape, "angle_rad": float(angle)}
        for place, p in enumerate(parameters, first):
            z[place] = p.internal(values[p.name]) if p.name in values else z[place]
        yield z
