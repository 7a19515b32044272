"""What few lines leave open of an effect's place: other heights, and the other side of its absence.

Splits without angles have no sign: a strip that is softer parts doublets like one that is stiffer. A lump that a refit
has carried to an end of the core does not come back, for there all slopes by its height point outwards. A modulus that
the declared model took from the wrong side stays there beside the effect. One start from each such place costs less
than a second, and the best of them may explain far more. Beside recordings, angles and leans tell more, and a refit
costs more: there what leads is tried at other places only where it leaves more than right names of recordings do.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.evidence.decision import NEAR_RIVAL
from statorhom.diagnose.fits.explanations import UNUSUAL, Explanation, refitted, was_recorded
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.profile import Profile
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.fits.valleys import on_its_best_side
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.searches.deeper import DEEPER, is_sought
from statorhom.diagnose.searches.sharper import in_its_own_models, refines
from statorhom.physics.parameter import EffectParameter

MOST = 4  # explanations that are followed
# of what is left by what leads in recordings, the chance from which on nothing is sought: all 29 right names of
# development recordings leave as much with a chance of 0.98 or more
AS_RIGHT_ONES = 0.9
MORE = 0.3  # right explanations leave as much of the rows with a chance that is larger by about this
DRAWN = 30  # starts of what leaves too much
HEIGHTS = 0.2, 0.5  # of the core's height: what lies above its middle mirrors what lies below


def at_their_best_places(found: Sequence[Explanation], seed: int) -> list[Explanation]:
    """Explanations, the best first: what leads and, in a table, what comes near it, each at its best place.

    Parameters
    ----------
    found : the best first.
    seed : of the points that are drawn.
    """
    if not found:
        return []
    recorded = was_recorded(found[0].refit)
    if recorded and found[0].adequacy_but_one > AS_RIGHT_ONES:
        return list(found)
    least = found[0].log_evidence - NEAR_RIVAL
    near = [e for e in found[: 1 if recorded else MOST] if e.log_evidence > least and is_sought(e)]
    followed = side_by_side(
        lambda e: _at_its_best_place(e, seed if e is found[0] else None),
        near,
        [e.refit.hypothesis for e in near],
    )
    better = dict(zip(map(id, near), followed, strict=True))
    return sorted((better.get(id(e), e) for e in found), key=lambda e: -e.log_evidence)


def _at_its_best_place(explanation: Explanation, seed: int | None) -> Explanation:
    """From other places, and with a seed all over the prior where it leaves more than right ones leave."""
    if not explanation.settled:
        explanation = replace(_better(explanation, explanation.refit), settled=True)
    aside = on_its_best_side(
        explanation.refit, _blank(explanation), range(explanation.refit.hypothesis.constants)
    )
    if aside is not explanation.refit:
        explanation = _better(explanation, aside)
    best, blank = explanation.refit, _blank(explanation)
    starts = list(_other_places(best))
    if seed is not None and min(explanation.adequacy_but_one, explanation.chance_of_rows - MORE) <= UNUSUAL:
        starts += _drawn(best, seed)
    followed = side_by_side(lambda z: refitted(blank, z, best.objective), starts, [blank, *blank.shared])
    there = [r for r in followed if r is not None]
    other = min(there, key=lambda r: r.objective, default=None)
    if other is None or other.objective > best.objective - DEEPER:
        return explanation
    return _better(explanation, other)


def _blank(explanation: Explanation) -> Hypothesis:
    """What it is refitted with, to be paired anew."""
    return replace(explanation.refit.hypothesis, held=None)


def _better(before: Explanation, other: Refit) -> Explanation:
    """What an optimum leads to in its own models, where that leaves less and is not too narrow to speak for it."""
    now = before.at(in_its_own_models(replace(before, refit=other)).refit)
    if refines(now.refit, before.refit):
        return now
    deeper = now.refit.objective < before.refit.objective - DEEPER
    return now if deeper and now.log_evidence > before.log_evidence else before


def _other_places(best: Refit) -> Iterator[np.ndarray]:
    """All coordinates, the effect on the other side of its absence or at another height, as usual or as it is."""
    n, (candidate,) = best.hypothesis.constants, best.hypothesis.candidates
    magnitude = candidate.parameters[0]
    if _has_two_sides(magnitude):
        z = best.z.copy()
        z[n] = magnitude.internal(_opposite(magnitude, magnitude.value(float(z[n]))))
        yield z
    usual = best.z.copy()
    usual[n + 1 :][best.hypothesis.prior_weights[n + 1 :] > 0.0] = 0.0
    for k, parameter in enumerate(candidate.parameters):
        for part in HEIGHTS if parameter.scale == "place" else ():
            for begun in (best.z, usual):
                z = begun.copy()
                z[n + k] = parameter.internal(parameter.lower + part * (parameter.upper - parameter.lower))
                yield z


def _drawn(best: Refit, seed: int) -> list[np.ndarray]:
    """All coordinates with the effect's parameters from all over their prior, but those of which nothing is told.

    Of a heavy lump one start in fifteen leads to where it belongs.
    """
    profile = Profile.of(best)
    found = []
    for point in profile.prior.draws(DRAWN, np.random.default_rng(seed)):
        z = best.z.copy()
        z[profile.places] = point
        found.append(z)
    return found


def _has_two_sides(magnitude: EffectParameter) -> bool:
    return magnitude.absent is not None and magnitude.lower < magnitude.absent < magnitude.upper


def _opposite(magnitude: EffectParameter, value: float) -> float:
    """As far on the other side of the absence."""
    assert magnitude.absent is not None
    other = magnitude.absent**2 / value if magnitude.scale == "log" else 2 * magnitude.absent - value
    return float(np.clip(other, magnitude.lower, magnitude.upper))
