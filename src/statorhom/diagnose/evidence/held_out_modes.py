"""Errors on modes that an explanation did not see: constants and effect are fitted to the other modes only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from typing_extensions import TypeVar

from statorhom.diagnose.evidence.held_out import APART, LEAST_FALL, OF_TABLES, REST, WHAT, Group, HeldOut
from statorhom.diagnose.features.assignment import NEAR
from statorhom.diagnose.fits.any_hypothesis import AnyHypothesis
from statorhom.diagnose.fits.derivatives import jacobian
from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.fits.refit import Refit, refit
from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.errors import StatorhomError
from statorhom.identify.residuals.stage_problem import LABELLED_GATE, PAIRING_SD

_H = TypeVar("_H", bound=AnyHypothesis)

FOLDS = 6
# of features other than frequencies, in terms of a frequency: split of λ, shift of a pole, lean of a shape, level, a
# density's error
WEIGHT = {
    "frequency": 1.0,
    "split": 0.25,
    "shift": 1.0,
    "lean": 0.1,
    "level": 1.0,
    "level_loss": 0.005,
    "density": 0.5,
}
DIFFERENT = 0.2  # of the noise: by how much errors differ at least where two models say different things
Part = tuple[Group, str]  # of a group: `APART` or `REST`
# percent: how far off a mode counts as that a model has not got, which predicts none of that name any nearer
LACKING = round(100 * NEAR * LABELLED_GATE * PAIRING_SD, 1)
Lacking = tuple[set[Group], set[Group]]  # by the declared model, and by the explanation
NOTHING: Lacking = set(), set()
WEIGHED: Group = ("", None)  # what is known of the densities
MOVES = 0.5  # standard deviations by which an explanation moves a density of which it says something


def held_out(base: Refit, explanation: Explanation) -> HeldOut:
    """Hold out every sixth mode in turn; where modes do not tell, the densities that an explanation moves.

    A density is what no recording saw: that the recordings alone ask for a plausible one is a test of its own. A sensor
    moves frequencies by less than the mesh leaves open of them: where it is unseen shifts that fall, these tell, unless
    a test's error grows.
    """
    lacking = lacked(base, explanation.refit), lacked(explanation.refit, base)
    groups = [g for g in _groups(base, explanation, lacking) if g not in {WEIGHED, *explanation.set_aside}]
    found = _predicted(base, explanation, [frozenset(groups[k::FOLDS]) for k in range(FOLDS)], lacking)
    if found.falls or found.worsens:
        return found
    shifts = found.of_shifts
    if shifts.falls:
        return shifts
    if _moves_densities(base, explanation):
        weighed = _predicted(base, explanation, [frozenset([WEIGHED])])
        if weighed.falls:
            return replace(weighed, what="densities of the regions predicted from the recordings alone")
    return found


def _predicted(
    base: Refit, explanation: Explanation, folds: Sequence[frozenset[Group]], lacking: Lacking = NOTHING
) -> HeldOut:
    groups = {g for fold in folds for g in fold}
    used = [fold for fold in folds if fold and (len(fold) < len(groups) or fold == {WEIGHED})]
    fits = [(r, fold) for r in (base, explanation.refit) for fold in used]
    errors = side_by_side(lambda fit: _errors(*fit), fits)
    rows: dict[Part, tuple[Error, Error]] = {}
    # a mode that a model has not got counts once, however many of its features are told apart
    unknown, given_up = ({(group, REST) for group in groups} for groups in lacking)
    for before, after in zip(errors[: len(used)], errors[len(used) :], strict=True):
        rows |= {part: (before[part], after[part]) for part in before if part in after}
        rows |= {part: (_lacking(e), e) for part, e in after.items() if part in unknown}
        rows |= {part: (e, _lacking(e)) for part, e in before.items() if part in given_up}
    apart = [part for part, both in rows.items() if _differ(*both)]
    told = sorted(apart or rows, key=str)
    lone = any(group in lacking[0] | lacking[1] for group, _ in told)
    return HeldOut(
        tuple(group for group, _ in told),
        tuple(rows[g][0].error for g in told),
        tuple(rows[g][1].error for g in told),
        tuple(noise_of(*rows[g]) for g in told),
        f"{WHAT}; one that a model has not got counts as {LACKING} % off" if lone else WHAT,
        LEAST_FALL if _has_shapes(base) else OF_TABLES,
        kinds=tuple(kind for _, kind in told),
    )


def _has_shapes(base: Refit) -> bool:
    """Whether shapes were measured, and not frequencies alone."""
    return any(test.shapes is not None for step in base.hypothesis.study.stages for test in step.tests)


def _groups(base: Refit, explanation: Explanation, lacking: Lacking) -> list[Group]:
    """Modes that both have a partner for, or one has and the other has none; tests mixed."""
    both = set(_paired_rows(base)) & set(_paired_rows(explanation.refit))
    return sorted(both.union(*lacking), key=str)


def _paired_rows(r: Refit) -> dict[Group, frozenset[str]]:
    """Modes that have a partner, and the rows that were measured of them."""
    features = r.hypothesis.features(r.z)
    return {f.group: frozenset(f.rows) for f in features if f.kind in WEIGHT and not f.lost and not f.third}


def lacked(one: Refit, other: Refit) -> set[Group]:
    """Named modes of another fit whose rows have no partner in the one: it says that nothing is near (`LACKING`)."""
    features = one.hypothesis.features(one.z)
    lost = {(f.test, row) for f in features if f.stray for row in f.rows}
    return {
        group
        for group, rows in _paired_rows(other).items()
        if rows and all((group[0], row) in lost for row in rows)
    }


def _moves_densities(base: Refit, explanation: Explanation) -> bool:
    """Whether an explanation says something of densities."""
    old, new = (
        [f for f in r.hypothesis.features(r.z) if f.kind == "density"] for r in (base, explanation.refit)
    )
    return any(abs(a.measured - b.measured) > MOVES * a.sd for a, b in zip(old, new, strict=True))


def groups_of(base: Refit) -> list[Group]:
    """Modes that have a partner, tests mixed; densities left out."""
    features = base.hypothesis.features(base.z)
    return sorted({f.group for f in features if f.kind in WEIGHT and not f.lost} - {WEIGHED}, key=str)


@dataclass(frozen=True)
class Error:
    """Of what was held out, in percent: the error, its noise, and what the rest leaves open of the prediction."""

    error: float
    noise: float
    spread: float


def noise_of(before: Error, after: Error) -> float:
    """What the errors of two explanations are compared with."""
    return float(np.hypot(before.noise, max(before.spread, after.spread)))


def _differ(before: Error, after: Error) -> bool:
    """Whether two predictions say different things: where they agree, neither can be the better one."""
    return abs(before.error - after.error) > DIFFERENT * noise_of(before, after)


def _lacking(known: Error) -> Error:
    """Of a model that has no such mode, beside one that has."""
    return replace(known, error=LACKING)


def _errors(full: Refit, fold: frozenset[Group]) -> dict[Part, Error]:
    """Errors of a fold after a fit without it."""
    hypothesis: AnyHypothesis = replace(full.hypothesis, left_out=fold)
    try:
        trained = refit_held(hypothesis, full.z)
        known = left_out_errors(trained.hypothesis, trained.z)
        spreads = _spreads(trained)
    except StatorhomError:
        return {}
    return {part: Error(*pair, spreads.get(part, 0.0)) for part, pair in known.items()}


def _spreads(trained: Refit[_H]) -> dict[Part, float]:
    """Standard deviations of the predictions of what a fit left out, in percent."""
    everything = replace(trained.hypothesis, left_out=frozenset())
    rows = jacobian(everything, trained.z)
    variances = np.einsum("ij,jk,ik->i", rows, trained.covariance, rows)
    found: dict[Part, float] = {}
    for feature, variance in zip(everything.features(trained.z), variances.tolist(), strict=True):
        if feature.group in trained.hypothesis.left_out and _tells(feature):
            part = 100 * WEIGHT[feature.kind] * feature.sd / _scale(feature)
            own = _part(feature)
            found[own] = float(np.hypot(found.get(own, 0.0), part * np.sqrt(variance)))
    return found


def left_out_errors(hypothesis: AnyHypothesis, z: np.ndarray) -> dict[Part, tuple[float, float]]:
    """Errors of what a hypothesis leaves out in percent, and their noise."""
    found: dict[Part, list[Feature]] = {}
    for feature in hypothesis.features(z, left_out=True):
        if _tells(feature):
            found.setdefault(_part(feature), []).append(feature)
    return {part: (_error(features), _noise(features)) for part, features in found.items()}


def _part(feature: Feature) -> Part:
    """What errors are summed over.

    A sensor moves a pole, and a wave parts a mode's lines, by less than the mesh leaves open of its frequency.
    """
    return feature.group, feature.kind if feature.kind in APART else REST


def _tells(feature: Feature) -> bool:
    """Whether a prediction of it can be wrong: not so where anything is possible."""
    return feature.kind in WEIGHT and not feature.lost and feature.sd < 0.5 * _scale(feature)


def refit_held(hypothesis: _H, z: np.ndarray) -> Refit[_H]:
    """Fit with the pairing as it is."""
    return refit(hypothesis, z, rounds=1)


def _error(features: Sequence[Feature]) -> float:
    return 100 * float(
        np.sqrt(sum((WEIGHT[f.kind] * (f.measured - f.predicted) / _scale(f)) ** 2 for f in features))
    )


def _noise(features: Sequence[Feature]) -> float:
    return 100 * float(np.sqrt(sum((WEIGHT[f.kind] * f.sd / _scale(f)) ** 2 for f in features)))


def _scale(feature: Feature) -> float:
    """What an error of 1 is: all features are relative but densities."""
    return feature.predicted if feature.kind == "density" else 1.0
