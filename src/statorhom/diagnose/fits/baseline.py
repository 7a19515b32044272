"""The declared model fitted to all tests together: where every explanation starts from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import takewhile

import numpy as np

from statorhom.diagnose.features.mode_features import SCATTER_SD
from statorhom.diagnose.fits.explanations import NARROWING, in_valleys, nothing, widened
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.refit import Refit, evaluated, refit
from statorhom.diagnose.fits.valleys import (
    ALIKE,
    DIFFERENT,
    FAR_BEHIND,
    MOST,
    different,
    trials_around,
    wide_optima,
    with_other_sides,
)
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import acted_materials, with_rules
from statorhom.diagnose.stages.constants import held_by_lines, new_constants, study_constants
from statorhom.diagnose.stages.stage_model import (
    StageModel,
    mesh_error,
    stage_model,
    with_reference,
    with_snapshots,
)
from statorhom.diagnose.stages.study_model import StudyModel
from statorhom.errors import IdentificationError, StatorhomError
from statorhom.geometry.tested_object import RingGeometry
from statorhom.identify.stages.settings import Settings
from statorhom.identify.stages.stage_setup import StageSetup, stage_setup
from statorhom.model.affine import Materials
from statorhom.physics.declared import declared_effects
from statorhom.physics.ring import ring_of
from statorhom.study.study import StudyFiles
from statorhom.study.study_file import FREE

SNAPSHOTS = 6  # materials that are solved per step
SAME_HZ = 2e-4  # relative: a basis is good enough when a snapshot moves no frequency by more
ROUNDS = 3
FOLLOWED = 3  # valleys
KNOWN = 8  # that a basis knows where none of those explains
STIFF = 0.01  # relative: a basis that is off by less says the same of wide valleys
CONVINCING = 0.1  # chance of a misfit above which no other valley is followed
MAX_SCATTER_ORDER = 8


@dataclass(frozen=True, eq=False)
class Baseline:
    """The declared model.

    Parameters
    ----------
    study : references of its stages lie at `free`.
    free : where the free tests put the constants: a support is known worse than a material, and a wrong one would
        draw them away. Explanations are sought from here.
    refit : optimum over all tests.
    valleys : constants at other optima, of the last step's search.
    """

    study: StudyModel
    free: Refit
    refit: Refit
    valleys: tuple[np.ndarray, ...] = ()


def baseline(
    files: StudyFiles,
    geometry: RingGeometry,
    tests: Mapping[str, MeasuredTest],
    settings: Settings,
) -> Baseline:
    """Fit the declared model, step by step and then all steps together.

    Raises
    ------
    IdentificationError
        If the study has no test.
    StatorhomError
        If files, masses or tests do not allow it.
    """
    setups = [stage_setup(files, geometry, i) for i in range(len(files.study.stages))]
    length = ring_of(files).length
    tests = {name: test.on_core(length) for name, test in tests.items()}
    tested = [s for s in setups if s.tests and s.step is not None]
    if not tested:
        raise IdentificationError(f"{files.path}: no stage has a test; there is nothing to diagnose")
    orders = sorted({m.order for t in tests.values() for m in t.modes if m.order is not None and m.order > 0})
    damped = any(m.loss_factor is not None for t in tests.values() for m in t.modes)
    split = [r for r in orders if r <= MAX_SCATTER_ORDER]
    constants = study_constants(
        setups, split, SCATTER_SD, with_losses=damped, on_lines=held_by_lines(files, setups)
    )
    effects = tuple(d.action for d in declared_effects(files))
    study = StudyModel(files, geometry, constants, (), effects)
    z = np.zeros(len(constants))
    valleys: tuple[np.ndarray, ...] = ()
    for setup in tested:
        study, z, valleys = _with_step(study, z, setup, _measured(setup, tests), settings)
    whole = tuple(s.with_tests(_measured(s.setup, tests)) for s in study.stages)
    return baseline_at(study.with_stages(whole), z, valleys)


def baseline_at(study: StudyModel, z: np.ndarray, valleys: tuple[np.ndarray, ...]) -> Baseline:
    """The declared model at the optimum next to some constants.

    Parameters
    ----------
    study : with all tests.
    z, valleys : constants there, and at other optima.
    """
    free_tests = tuple(s.with_tests(_leading(s.tests)) for s in study.stages)
    z = refit(Hypothesis(study.with_stages(free_tests)), z).z
    free = evaluated(Hypothesis(study), z)
    same = all(t.support == FREE for s in study.stages for t in s.tests)
    return Baseline(study, free, free if same else refit(Hypothesis(study), z), valleys)


def _measured(setup: StageSetup, tests: Mapping[str, MeasuredTest]) -> Sequence[MeasuredTest]:
    """The tests of a step that were measured."""
    return [tests[t.name] for t in setup.tests if t.name in tests]


def _leading(tests: Sequence[MeasuredTest]) -> Sequence[MeasuredTest]:
    """The free tests of a step, all where there are none."""
    return [t for t in tests if t.support == FREE] or tests


def _with_step(
    study: StudyModel, z: np.ndarray, setup: StageSetup, tests: Sequence[MeasuredTest], settings: Settings
) -> tuple[StudyModel, np.ndarray, tuple[np.ndarray, ...]]:
    """One more step: its constants from the best of many starts; the other optima.

    The model reaches as high as any test: a clamped one may have lines above all that the free one shows.
    """
    places = new_constants(study.constants, setup.keys.name)
    trials = trials_around(z, places, settings.seed)
    snapshots = _materials(study, setup, trials)[:SNAPSHOTS]
    stage = stage_model(setup, tests, snapshots, settings.density)
    study = study.with_stages((*study.stages, stage.with_tests(_leading(tests))))
    # constants of earlier steps stay while new ones are sought
    wide = wide_optima(Hypothesis(study), trials, most=MOST)
    wide = with_other_sides(Hypothesis(study), wide, places)
    followed = _worth_following(wide)
    found = _until_convincing(study, followed, settings)
    if not _is_convincing(found[-1]):
        # a basis of a few materials is too stiff elsewhere, and its band lacks the highest modes there
        again = _worth_following(_in_a_basis_that_knows(study, wide) or wide)
        ahead = takewhile(lambda w: all(np.linalg.norm(w.z - f.z) > DIFFERENT for f in followed), again)
        found += _until_convincing(study, list(ahead), settings)
    best = found[-1] if _is_convincing(found[-1]) else min(found, key=_wide_objective)
    begun = followed[: len(found)]
    others = (*(r.z for r in found if r is not best), *(w.z for w in wide[:FOLLOWED] if w not in begun))
    return best.hypothesis.study, best.z, others


def _until_convincing(
    study: StudyModel, valleys: Sequence[Refit[Hypothesis]], settings: Settings
) -> list[Refit[Hypothesis]]:
    """Optima in models of their own, one after the other until nothing is left to explain."""
    found: list[Refit[Hypothesis]] = []
    for one in valleys:
        # what a coarse mesh is wrong by differs from valley to valley: none is the best before that is known
        found.append(_settled(study, one, settings))
        if _is_convincing(found[-1]):
            break
    return found


def _is_convincing(found: Refit[Hypothesis]) -> bool:
    return nothing(found).adequacy > CONVINCING


def _in_a_basis_that_knows(study: StudyModel, wide: Sequence[Refit[Hypothesis]]) -> list[Refit[Hypothesis]]:
    """The same optima where the last step's basis knows the best of them, the best first; none where it did before."""
    *before, stage = study.stages
    materials = [
        acted_materials(study, stage, study.constants.values(w.z), study.effects) for w in wide[:KNOWN]
    ]
    knowing = with_snapshots(stage, materials)
    if all(_moved(_frequencies(stage, m), _frequencies(knowing, m)) < STIFF for m in materials):
        return []
    hypothesis = Hypothesis(study.with_stages((*before, knowing)))
    again = (widened(hypothesis, w.z) for w in wide[:KNOWN])
    return different([r for r in again if r is not None])


def _worth_following(wide: Sequence[Refit[Hypothesis]]) -> list[Refit[Hypothesis]]:
    """Optima in wide valleys that are as good as the best one, and the one that stays best as they narrow."""
    alike = [w for w in wide[:FOLLOWED] if w.objective <= wide[0].objective + ALIKE]
    near = [w for w in wide if w.objective <= wide[0].objective + FAR_BEHIND]
    if len(near) == len(alike):
        return alike
    narrower = [
        (r.objective, w) for w in near if (r := in_valleys(w.hypothesis, w.z, NARROWING[0])) is not None
    ]
    best = min(narrower, key=lambda pair: pair[0])[1] if narrower else wide[0]
    return alike if best in alike else [*alike, best]


def _wide_objective(found: Refit[Hypothesis]) -> float:
    """In wide valleys: where no optimum is any good, small uncertainties would weigh accidents."""
    rough = widened(found.hypothesis, found.z)
    return np.inf if rough is None else rough.objective


def _settled(study: StudyModel, found: Refit[Hypothesis], settings: Settings) -> Refit[Hypothesis]:
    """Refitted with a basis and mesh factors of its own, until the basis moves no frequency any more."""
    for number in range(ROUNDS):
        stage = study.stages[-1]
        materials = acted_materials(study, stage, study.constants.values(found.z), study.effects)
        before = _frequencies(stage, materials)
        better = with_reference(stage, materials)
        moved = _moved(before, _frequencies(better, materials))
        if number == 0:
            error = mesh_error(stage.setup, better.ring, materials, settings.density)
            better = better.with_error(error)
        study = study.with_stages((*study.stages[:-1], better))
        found = refit(Hypothesis(study), found.z)
        if number > 0 and moved < SAME_HZ:
            break
    return found


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
