"""The declared model of a coupon or a wing fitted to its tests: where every explanation starts from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.coupons.body_hypothesis import BodyHypothesis
from statorhom.diagnose.coupons.body_stage import body_stage, with_reference
from statorhom.diagnose.coupons.body_study import BodyStudy
from statorhom.diagnose.features.mode_features import SCATTER_SD
from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.fits.new_step import SAME_HZ, SNAPSHOTS
from statorhom.diagnose.fits.refit import Refit, evaluated, refit
from statorhom.diagnose.fits.valleys import optima, trials_around
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.stages.constants import Constants, new_constants, study_constants
from statorhom.errors import IdentificationError, StatorhomError
from statorhom.geometry.tested_object import ObjectGeometry
from statorhom.identify.stages.settings import Settings
from statorhom.identify.stages.stage_setup import StageSetup, stage_setup
from statorhom.model.affine import Materials
from statorhom.model.modal.modal_body import NEAR, WIDE
from statorhom.physics.declared import declared_effects
from statorhom.physics.plan import plan_of
from statorhom.study.study import StudyFiles
from statorhom.study.study_file import FREE

FloatArray = npt.NDArray[np.float64]
BodyRefit = Refit[BodyHypothesis]

ROUNDS = 4
PART = 0.1  # of the errors that are left anyway: a basis need not be better
SAME = 1e-3  # relative: materials so near to the reference need no basis of their own
FAR = 0.3  # relative: modes of materials so far from it come in another order


def body_baseline(
    files: StudyFiles,
    geometry: ObjectGeometry,
    tests: Mapping[str, MeasuredTest],
    settings: Settings,
) -> tuple[BodyRefit, tuple[FloatArray, ...]]:
    """The declared model's optimum, and constants at its other optima.

    Raises
    ------
    IdentificationError
        If the study has no free test.
    StatorhomError
        If files, masses or tests do not allow it.
    """
    plan = plan_of(files)
    assert plan is not None, "rings have an approach of their own"
    setup = stage_setup(files, geometry, 0)
    own = [tests[t.name] for t in setup.tests if t.name in tests and t.support == FREE]
    if not own:
        raise IdentificationError(f"{files.path}: no stage has a free test; there is nothing to diagnose")
    constants = study_constants([setup], (), SCATTER_SD)
    effects = tuple(d.action for d in declared_effects(files))
    study = BodyStudy(files, constants, (), effects)
    places = new_constants(constants, setup.keys.name)
    trials = trials_around(np.zeros(len(constants)), places, settings.seed)
    snapshots = _snapshots(study, setup, trials, min(SNAPSHOTS, 1 + len(places)))
    # other dimensions are other Hooke entries
    varied = (
        frozenset(r.region for r in setup.materials.regions)
        if plan.typed
        else varied_regions(constants, setup)
    )
    study = study.with_stages((body_stage(setup, own, snapshots, settings, varied),))
    found, *others = optima(BodyHypothesis(study), trials)
    found = _settled(found)
    return evaluated(found.hypothesis, found.z), tuple(r.z for r in others)


def varied_regions(constants: Constants, setup: StageSetup) -> frozenset[str]:
    """Regions that have constants to be found."""
    free = {
        constants.names[i].partition(":")[2].partition(".")[0]
        for i in new_constants(constants, setup.keys.name)
    }
    return frozenset(r.region for r in setup.materials.regions if r.source in free)


def _snapshots(
    study: BodyStudy, setup: StageSetup, points: Sequence[FloatArray], most: int
) -> list[Materials]:
    """Materials of the first points that have any."""
    found: list[Materials] = []
    for z in points:
        try:
            found.append(study.materials(setup, study.constants.values(z), study.effects))
        except StatorhomError:
            continue
        if len(found) == most:
            break
    if not found:
        raise IdentificationError(
            f"stage {setup.keys.name!r}: no material is possible; check masses and priors"
        )
    return found


def _settled(found: BodyRefit) -> BodyRefit:
    """Refitted with a basis of its own until that moves no frequency any more; then with one for attachments too.

    What is left out draws the constants away: the last basis knows the materials from which the search began as well.
    """
    [begun] = found.hypothesis.study.stages
    for number in range(ROUNDS):
        before = _frequencies(found)
        found = at_own_reference(found, mesh_known=number > 0, reach=NEAR)
        step = float(np.abs(_frequencies(found) - before).max())
        if step < max(SAME_HZ, PART * _missed_rms(found)):
            break
    return at_own_reference(found, [begun.body.reference], mesh_known=True)


def at_own_reference(
    found: BodyRefit,
    others: Sequence[Materials] = (),
    *,
    mesh_known: bool = False,
    near: bool = False,
    reach: float = WIDE,
) -> BodyRefit:
    """The same with a basis (and mesh errors, unless they are known) of its own materials, refitted.

    Parameters
    ----------
    others, near, reach : see `with_reference`.
    """
    study, [stage], materials = found.hypothesis.study, found.hypothesis.study.stages, _own_materials(found)
    if near and _apart(materials, stage.body.reference) < SAME:
        return found
    moved = with_reference(stage, materials, others, mesh_known=mesh_known, near=near, reach=reach)
    return refit(replace(found.hypothesis, study=study.with_stages((moved,)), held=None), found.z)


def _own_materials(found: BodyRefit) -> Materials:
    """What its constants make."""
    study, [stage] = found.hypothesis.study, found.hypothesis.study.stages
    return study.materials(stage.setup, study.constants.values(found.z[: found.hypothesis.constants]), ())


def _apart(materials: Materials, reference: Materials) -> float:
    """Largest relative difference of stiffness or density; a small one needs no basis of its own."""
    differences = [0.0]
    for region, one in materials.items():
        stiffness, other = one.hooke.matrix, reference[region].hooke.matrix
        differences.append(float(np.abs(stiffness - other).max() / np.abs(stiffness).max()))
        differences.append(abs(one.density / reference[region].density - 1.0))
    return max(differences)


def _missed_rms(found: BodyRefit) -> float:
    """Of ln f, what the declared model leaves."""
    features = found.hypothesis.features(found.z)
    missed = [f.measured - f.predicted for f in features if f.kind == "frequency" and not f.lost]
    return float(np.sqrt(np.mean(np.square(missed)))) if missed else 0.0


def _frequencies(found: BodyRefit) -> FloatArray:
    return np.array([f.predicted for f in found.hypothesis.features(found.z) if f.kind == "frequency"])


def sharpened_body(explanation: Explanation[BodyHypothesis]) -> Explanation[BodyHypothesis]:
    """An explanation with a basis of its own materials, anew while they move far from it.

    Mesh errors and local shapes hardly depend on them: they are computed anew where what was left out had drawn the
    constants far away.
    """
    for _ in range(ROUNDS):
        far = _distance(explanation.refit) > FAR
        try:
            found = at_own_reference(explanation.refit, mesh_known=not far, near=not far)
        except (StatorhomError, KeyError):
            break
        explanation = replace(explanation, refit=found)
        if not far:
            break
    return explanation


def _distance(found: BodyRefit) -> float:
    """Of the constants from the materials of the basis."""
    [stage] = found.hypothesis.study.stages
    return _apart(_own_materials(found), stage.body.reference)
