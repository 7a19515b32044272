"""Projected signature scan: how much of the misfit each effect would take away, constants refitted.

For every candidate and place g is the change of all residuals by the effect at a typical magnitude; whitened and with
the refittable constants projected out it gives T = (gᵀPr)²/(gᵀPg) (physics.md §7). The distribution of the largest T
when nothing is missing comes from draws of noise and constants that are refitted the same way.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.fits.any_hypothesis import AnyHypothesis, ModelledStudy
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.processes.memory import remembering
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.errors import StatorhomError
from statorhom.physics.candidate import Candidate
from statorhom.physics.parameter import EffectParameter

FloatArray = npt.NDArray[np.float64]
Place = tuple[Candidate, FloatArray]  # an effect, and internal coordinates of its parameters
Row = tuple[str, str, object, int]  # kind, test and mode of a feature, and how many such came before
ANGLES_PER_ORDER = 5  # places per half wave of the highest split order
# of the core's length; not its middle, where splits of a symmetric stator have no slope that a refit could follow
HEIGHTS = (0.15, 0.45, 0.7)
DRAWS = 4000
MANY = 24  # of a candidate's further places: worth a process
COMMON = 0.6  # of the features, from which on signatures of one optimum are those of another
INVISIBLE = 1e-6  # of a signature's square that the constants leave: none that could be told
NOTHING = 1e-8  # the same of itself, in squared standard deviations


@dataclass(frozen=True, eq=False)
class Signature:
    """One candidate at one place and start.

    Parameters
    ----------
    candidate : the effect.
    start : internal coordinates of its parameters.
    change : (features + constants,) of the augmented residuals, constants projected out, of unit length.
    strength : length before, in standard deviations.
    gain : T, one-sided: 0 where the misfit asks for the opposite of the effect.
    whole : (features,) change of the residuals before.
    """

    candidate: Candidate
    start: FloatArray
    change: FloatArray
    strength: float
    gain: float
    whole: FloatArray

    @property
    def amount(self) -> float:
        """How many times the start's effect the misfit asks for, were the effect proportional."""
        return float(np.sqrt(self.gain)) / self.strength


@dataclass(frozen=True, eq=False)
class Scan:
    """All signatures, the best first, and the chance of the best if nothing is missing."""

    signatures: tuple[Signature, ...]
    p_value: float

    def of_every_candidate(self) -> tuple[Signature, ...]:
        """The best signature of every candidate, the best first."""
        best: dict[str, Signature] = {}
        for signature in self.signatures:
            best.setdefault(signature.candidate.label, signature)
        return tuple(best.values())

    def worth_refitting(
        self, most: int, least_gain: float, every_effect: bool = False
    ) -> tuple[Signature, ...]:
        """The best signature of every candidate that gains enough; every effect's best one comes first.

        Parameters
        ----------
        most : candidates, but for the best ones of the effects.
        least_gain : of a signature that is worth it.
        every_effect : an effect's best signature is worth it whatever it gains: far from an optimum, where gross errors
            are held down, a signature does not say what a refit would.
        """
        best: dict[str, Signature] = {}
        seen: set[str] = set()
        for signature in self.signatures:
            leads = signature.candidate.effect not in seen
            seen.add(signature.candidate.effect)
            if signature.gain >= least_gain or (every_effect and leads):
                best.setdefault(signature.candidate.label, signature)
        leaders = {s.candidate.effect: s.candidate.label for s in reversed(list(best.values()))}
        first = [s for label, s in best.items() if label in leaders.values()]
        rest = [s for label, s in best.items() if label not in leaders.values()]
        return tuple([*first, *rest][: max(most, len(first))])


def scan(base: Refit, candidates: Sequence[Candidate], seed: int) -> Scan:
    """Signatures of all candidates at an optimum.

    Parameters
    ----------
    base : the declared model, or an explanation that another effect may be added to.
    candidates : with parameters; discrete ones change the pairing and are tried by refits alone.
    seed : of the draws.
    """
    away = _Constants(base)
    # a signature's direction needs no local fields
    hypothesis = replace(base.hypothesis, trained=False)
    without = hypothesis.features(base.z)
    places = [(c, start) for c in candidates for start in starts(base.hypothesis.study, c)]

    def acted(place: Place) -> tuple[AnyHypothesis, FloatArray]:
        candidate, start = place
        return replace(hypothesis, candidates=(*hypothesis.candidates, candidate)), np.r_[base.z, start]

    def change(place: Place) -> FloatArray | None:
        return _change(without, *acted(place))

    def meshes(place: Place) -> int:
        return _meshes(*acted(place))

    changes = _first_ones_first(change, places, meshes, hypothesis)
    found = []
    for (candidate, start), whole in zip(places, changes, strict=True):
        if whole is not None and (signature := away.signature(candidate, start, whole)) is not None:
            found.append(signature)
    found.sort(key=lambda s: -s.gain)
    return Scan(tuple(found), _p_value(found, away.q, seed))


def left_over(before: Scan, base: Refit, first: Refit, seed: int) -> Scan:
    """What the effects would take away of the misfit that an explanation leaves, its constants refitted too.

    Signatures keep their shapes on the features that both have; where these are few, the scan is made anew.

    Parameters
    ----------
    before, base : the scan and the optimum that it was made at.
    first : the explanation.
    seed : of the draws that tell the chance of the largest gain if the explanation leaves nothing.
    """
    own, rows = (rows_of(r.hypothesis.features(r.z)) for r in (base, first))
    known = {row: place for place, row in enumerate(own)}
    places = [known.get(row) for row in rows]
    if sum(place is not None for place in places) < COMMON * max(len(own), len(rows)):
        return scan(first, list({s.candidate.label: s.candidate for s in before.signatures}.values()), seed)
    away = _Constants(first)
    found = []
    for s in before.signatures:
        whole = np.array([0.0 if place is None else s.whole[place] for place in places])
        if (again := away.signature(s.candidate, s.start, whole)) is not None:
            found.append(again)
    found.sort(key=lambda s: -s.gain)
    return Scan(tuple(found), _p_value(found, away.q, seed))


def _first_ones_first(
    change: Callable[[Place], FloatArray | None],
    places: Sequence[Place],
    meshes: Callable[[Place], int],
    hypothesis: AnyHypothesis,
) -> list[FloatArray | None]:
    """Changes at all places; what all those of a candidate need is made by its first one, and remembered here.

    Other meshes are made side by side; what belongs to this one stays with it, and so is made here meanwhile.
    """
    first = {candidate.label: i for i, (candidate, _) in reversed(list(enumerate(places)))}.values()
    prices = {i: meshes(places[i]) if hypothesis.memories else 0 for i in first}
    ordered = sorted(first, key=lambda i: -prices[i])
    here = [place for place, i in enumerate(ordered) if not prices[i]]
    begun = [places[i] for i in ordered]
    known = dict(
        zip(ordered, remembering(change, begun, hypothesis.memories, hypothesis.shared, here), strict=True)
    )
    rest = [i for i in range(len(places)) if i not in known]
    known |= dict(zip(rest, side_by_side(change, [places[i] for i in rest], least=MANY), strict=True))
    return [known[i] for i in range(len(places))]


def _meshes(acted: AnyHypothesis, z: FloatArray) -> int:
    """How dear the meshes are that the last effect alone asks for: of parts that meet, of other sizes, none."""
    action = acted.actions(z)[len(acted.candidates) - 1]
    return 2 if action.joint is not None else int(bool(action.dimensions))


def rows_of(features: Sequence[Feature]) -> list[Row]:
    """What features are of; equal ones are counted."""
    seen: Counter[tuple[str, str, object]] = Counter()
    rows: list[Row] = []
    for f in features:
        what = f.kind, f.test, f.key
        rows.append((*what, seen[what]))
        seen[what] += 1
    return rows


def freed(wholes: FloatArray, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Changes of the features without what a refit's coordinates can take up of them.

    Parameters
    ----------
    wholes : (changes, features).
    q : (features + coordinates, coordinates) orthonormal, what the coordinates do.

    Returns
    -------
    units : (changes, features + coordinates) of unit length; 0 of what the coordinates take up all of.
    strengths : (changes,) lengths before; 0 of these.
    """
    changes = np.hstack([wholes, np.zeros((len(wholes), len(q) - wholes.shape[1]))])
    total = np.sum(changes**2, axis=1)
    changes = changes - (changes @ q) @ q.T
    left = np.sum(changes**2, axis=1)
    strengths = np.sqrt(np.where(left > np.maximum(INVISIBLE * total, NOTHING), left, 0.0))
    seen = strengths > 0.0
    units = np.zeros_like(changes)
    units[seen] = changes[seen] / strengths[seen, None]
    return units, strengths


class _Constants:
    """Projects out what a refit's coordinates can take up."""

    def __init__(self, base: Refit) -> None:
        known = np.sqrt(base.hypothesis.prior_weights)
        self.residuals = np.r_[base.hypothesis.residuals(base.z), known * base.z]
        self.q, _ = np.linalg.qr(np.vstack([base.jacobian, np.diag(known)]))

    def signature(self, candidate: Candidate, start: FloatArray, whole: FloatArray) -> Signature | None:
        """Of a change of the features' residuals; None where the constants take up all of it."""
        (unit,), (strength,) = freed(whole[None], self.q)
        if strength == 0.0:
            return None
        # the effect takes away what its signature shares with the misfit, with the opposite sign
        gain = max(0.0, -float(unit @ self.residuals)) ** 2
        return Signature(candidate, start, unit, float(strength), gain, whole)


def _p_value(signatures: Sequence[Signature], q: FloatArray, seed: int) -> float:
    """Chance of so large a maximum under noise and prior alone."""
    if not signatures:
        return 1.0
    units = np.array([s.change for s in signatures])
    rng = np.random.default_rng(seed)
    noise = rng.standard_normal((q.shape[0], DRAWS))
    noise -= q @ (q.T @ noise)
    largest = np.max(np.maximum(-units @ noise, 0.0), axis=0) ** 2
    return float((1 + np.count_nonzero(largest >= signatures[0].gain)) / (1 + DRAWS))


def starts(study: ModelledStudy, candidate: Candidate) -> list[FloatArray]:
    """Internal coordinates at all combinations of magnitudes and places."""
    choices = [_choices(study, p) for p in candidate.parameters]
    return [np.array(point) for point in product(*choices)]


def _choices(study: ModelledStudy, parameter: EffectParameter) -> list[float]:
    if parameter.scale == "angle":
        period = parameter.upper - parameter.lower
        split = [t for stage in study.stages for t in stage.tests if t.splits]
        if not split and all(test.support == "free" for stage in study.stages for test in stage.tests):
            return [parameter.internal(0.0)]  # nothing that was measured tells angles
        highest = max((m.order or 0 for t in split for m in t.modes), default=4)
        # doublets do not tell half a turn
        half = min(period, np.pi)
        count = max(4, int(np.ceil(ANGLES_PER_ORDER * max(highest, 2) * half / np.pi)))
        return [parameter.internal(half * k / count) for k in range(count)]
    if parameter.scale == "place":
        span = parameter.upper - parameter.lower
        return [
            parameter.internal(v) for v in parameter.starts or [parameter.lower + h * span for h in HEIGHTS]
        ]
    return [parameter.internal(value) for value in parameter.starts]


def _change(without: Sequence[Feature], acted: AnyHypothesis, z: FloatArray) -> FloatArray | None:
    """Residuals with the effect minus those without, pairing held; None where no body has the effect."""
    try:
        with_effect = acted.features(z)
    except (StatorhomError, KeyError):
        return None
    # a mode that vanishes with the effect is a jump that says nothing of its signature
    return np.array(
        [
            0.0 if a.lost or b.lost else a.residual - b.residual
            for a, b in zip(with_effect, without, strict=True)
        ]
    )
