"""One more step of the declared model: its constants in the right one of many valleys."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.fits.explanations import NARROWING, by_degrees, in_valleys, nothing, widened
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.refit import Refit, refit
from statorhom.diagnose.fits.valleys import (
    ALIKE,
    DIFFERENT,
    FAR_BEHIND,
    MOST,
    different,
    is_apart,
    on_its_best_side,
    trials_around,
    wide_optima,
    with_other_sides,
)
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import with_rules
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.stages.constants import new_constants
from statorhom.diagnose.stages.stage_model import (
    StageModel,
    mesh_error,
    stage_model,
    with_reference,
    with_snapshots,
)
from statorhom.diagnose.stages.study_model import StudyModel
from statorhom.errors import IdentificationError, StatorhomError
from statorhom.identify.stages.settings import Settings
from statorhom.identify.stages.stage_setup import StageSetup
from statorhom.model.affine import Materials
from statorhom.study.study_file import FREE

SNAPSHOTS = 6  # materials that are solved per step
SAME_HZ = 2e-4  # relative: a basis is good enough when a snapshot moves no frequency by more
ROUNDS = 3
FOLLOWED = 3  # valleys
DRAWS = 2  # of other points to begin from where nothing explains
KNOWN = 8  # that a basis knows where none of those explains
STIFF = 0.01  # relative: a basis that is off by less says the same of wide valleys
CONVINCING = 0.1  # chance of a misfit above which no other valley is followed


def leading(tests: Sequence[MeasuredTest]) -> Sequence[MeasuredTest]:
    """The free tests of a step, all where there are none."""
    return [t for t in tests if t.support == FREE] or tests


def with_step(
    study: StudyModel, z: np.ndarray, setup: StageSetup, tests: Sequence[MeasuredTest], settings: Settings
) -> tuple[StudyModel, np.ndarray, tuple[np.ndarray, ...]]:
    """One more step: its constants from the best of many starts; the other optima.

    The model reaches as high as any test: a clamped one may have lines above all that the free one shows.

    Parameters
    ----------
    study, z : the declared model of the steps before, and all constants.
    setup, tests : the step, and what was measured of it.
    settings : seed of the draws, and the mesh.

    Returns
    -------
    The model with the step, its constants, and those of other optima.

    Raises
    ------
    IdentificationError
        If no material of the step is possible, or no start could be fitted.
    """
    places = new_constants(study.constants, setup.keys.name)
    trials = trials_around(z, places, settings.seed)
    snapshots = _materials(study, setup, trials)[:SNAPSHOTS]
    stage = stage_model(setup, tests, snapshots, settings.density)
    study = study.with_stages((*study.stages, stage.with_tests(leading(tests))))
    # constants of earlier steps stay while new ones are sought
    wide = wide_optima(Hypothesis(study), trials, most=MOST)
    wide = with_other_sides(Hypothesis(study), wide, places)
    first = wide[0]
    found = _until_convincing(study, [first])
    if not _is_convincing(found[-1]):
        wide = different([*wide, *_of_more_draws(study, z, places, settings)])
        # a basis of a few materials is too stiff elsewhere, and its band lacks the highest modes there; but where modes
        # of one order come near each other, what they are called may differ from basis to basis
        knowing = _in_a_basis_that_knows(study, wide)
        # where the basis stays the same, the first one's neighbours lead where it led
        wide = different([*knowing, *(w for w in wide if w is first or is_apart(w.z, [first.z], DIFFERENT))])
        ahead = [w for w in _worth_following(wide) if w is not first and _is_new(w, found, places)]
        found += _until_convincing(study, ahead)
    best = found[-1] if _is_convincing(found[-1]) else _best_in_wide_valleys(found)
    left = (w.z for w in wide[:FOLLOWED] if _is_new(w, found, places))
    others = (*(r.z for r in found if r is not best), *left)
    best = _on_its_best_side(best, places)
    return best.hypothesis.study, best.z, others


def _on_its_best_side(best: Refit[Hypothesis], places: Sequence[int]) -> Refit[Hypothesis]:
    """The same, or a deeper one on another side of a constant of which little is known.

    A modulus across the sheets moves few modes, and those little: wide valleys forgive a wrong one more than it costs.
    What does not convince where it stands flees from physics that it lacks: the deeper, the further away.
    """
    if not _is_convincing(best):
        return best
    other = on_its_best_side(best, replace(best.hypothesis, held=None), places)
    if other is best:
        return best
    there = _settled(other.hypothesis.study, other)
    return min(best, there, key=lambda r: r.objective)


def _of_more_draws(
    study: StudyModel, z: np.ndarray, places: Sequence[int], settings: Settings
) -> list[Refit[Hypothesis]]:
    """Optima in wide valleys from other points than the first ones, between which a valley may lie."""
    draws = [trials_around(z, places, settings.seed + number) for number in range(1, 1 + DRAWS)]
    blank = Hypothesis(study)
    found = side_by_side(lambda trials: wide_optima(blank, trials, most=MOST), draws, [blank, *blank.shared])
    return [w for wide in found for w in wide]


def _is_new(one: Refit[Hypothesis], found: Sequence[Refit[Hypothesis]], places: Sequence[int]) -> bool:
    """Whether it lies near no optimum; one that was followed from near it and fled may have had too poor a basis."""
    own = list(places)
    return is_apart(one.z[own], (other.z[own] for other in found), DIFFERENT)


def _until_convincing(study: StudyModel, valleys: Sequence[Refit[Hypothesis]]) -> list[Refit[Hypothesis]]:
    """Optima in models of their own, one after the other until nothing is left to explain."""
    found: list[Refit[Hypothesis]] = []
    for one in valleys:
        # what a coarse mesh is wrong by differs from valley to valley: none is the best before that is known
        found.append(_settled(study, one))
        if _is_convincing(found[-1]):
            break
    return found


def _is_convincing(found: Refit[Hypothesis]) -> bool:
    return nothing(found).adequacy > CONVINCING


def _in_a_basis_that_knows(study: StudyModel, wide: Sequence[Refit[Hypothesis]]) -> list[Refit[Hypothesis]]:
    """Optima of which the last step's basis knew too little, where it knows the best of all; the best first."""
    *before, stage = study.stages
    best = wide[:KNOWN]
    materials = [w.hypothesis.materials(stage, w.z) for w in best]
    knowing = with_snapshots(stage, materials)
    moved = [_moved(_frequencies(stage, m), _frequencies(knowing, m)) for m in materials]
    poor = [w for w, by in zip(best, moved, strict=True) if by > STIFF]
    blank = Hypothesis(study.with_stages((*before, knowing)))
    again = side_by_side(lambda w: widened(blank, w.z), poor, [blank, *blank.shared])
    return different([r for r in again if r is not None])


def _worth_following(wide: Sequence[Refit[Hypothesis]]) -> list[Refit[Hypothesis]]:
    """Optima in wide valleys that are as good as the best one, and the one that stays best as they narrow."""
    alike = [w for w in wide[:FOLLOWED] if w.objective <= wide[0].objective + ALIKE]
    near = [w for w in wide if w.objective <= wide[0].objective + FAR_BEHIND]
    if len(near) == len(alike):
        return alike
    narrower = side_by_side(_narrower, near)
    best = min(zip(narrower, near, strict=True), key=lambda pair: pair[0])[1]
    return alike if best in alike else [*alike, best]


def _narrower(wide: Refit[Hypothesis]) -> float:
    """What the optimum next to it leaves in narrower valleys; infinite where there is none."""
    found = in_valleys(wide.hypothesis, wide.z, NARROWING[0])
    return np.inf if found is None else found.objective


def _best_in_wide_valleys(found: Sequence[Refit[Hypothesis]]) -> Refit[Hypothesis]:
    """The best of optima in wide valleys; of those that are alike there the one that leaves least."""
    wide = [_wide_objective(r) for r in found]
    alike = [r for r, objective in zip(found, wide, strict=True) if objective <= min(wide) + ALIKE]
    return min(alike, key=lambda r: r.objective)


def _wide_objective(found: Refit[Hypothesis]) -> float:
    """In wide valleys: where no optimum is any good, small uncertainties would weigh accidents."""
    rough = widened(found.hypothesis, found.z)
    return np.inf if rough is None else rough.objective


def _settled(study: StudyModel, found: Refit[Hypothesis]) -> Refit[Hypothesis]:
    """Refitted with a basis and mesh factors of its own, until the basis moves no frequency any more."""
    for number in range(ROUNDS):
        stage = study.stages[-1]
        materials = found.hypothesis.materials(stage, found.z)
        before = _frequencies(stage, materials)
        better = with_reference(stage, materials)
        moved = _moved(before, _frequencies(better, materials))
        if number == 0 or not _is_convincing(found):
            better = better.with_error(mesh_error(better, materials))
        study = study.with_stages((*study.stages[:-1], better))
        followed = _followed if number == 0 else refit
        found = followed(Hypothesis(study), found.z)
        if number > 0 and moved < SAME_HZ:
            break
    return found


def _followed(hypothesis: Hypothesis, z: np.ndarray) -> Refit[Hypothesis]:
    """The optimum that a wide one leads to, straight or by degrees where that does not convince.

    Straight into the narrowest valley from where all modes are off by a per cent, steps are so long that modes lose
    their partners on the way.
    """
    straight = refit(hypothesis, z)
    gently = None if _is_convincing(straight) else by_degrees(hypothesis, z)
    return straight if gently is None else min(straight, gently, key=lambda r: r.objective)


def _moved(before: Mapping[int, float], after: Mapping[int, float]) -> float:
    """The largest relative change of a frequency; infinite where a basis had no mode in a narrow band at all."""
    both = before.keys() & after.keys()
    return max((abs(float(np.log(after[k] / before[k]))) for k in both), default=np.inf)


def _frequencies(stage: StageModel, materials: Materials) -> dict[int, float]:
    """Lowest frequencies by number."""
    return {i: m.frequency_hz for i, m in enumerate(stage.solve(materials).modes[:12])}


def _materials(study: StudyModel, setup: StageSetup, points: Sequence[np.ndarray]) -> list[Materials]:
    found = []
    for z in points:
        values = study.constants.values(z)
        try:
            plain = study.declared(setup, values, study.masses(values, {}))
            found.append(with_rules(plain, setup.keys.name, study.effects))
        except StatorhomError:
            continue
    if not found:
        raise IdentificationError(
            f"stage {setup.keys.name!r}: no material is possible; check masses and priors"
        )
    return found
