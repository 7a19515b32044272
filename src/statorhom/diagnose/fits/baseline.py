"""The declared model fitted to all tests together: where every explanation starts from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.diagnose.features.mode_features import SCATTER_SD
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.new_step import leading, with_step
from statorhom.diagnose.fits.refit import Refit, evaluated, refit
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.stages.constants import held_by_lines, study_constants
from statorhom.diagnose.stages.study_model import StudyModel
from statorhom.errors import IdentificationError
from statorhom.geometry.tested_object import RingGeometry
from statorhom.identify.stages.settings import Settings
from statorhom.identify.stages.stage_setup import StageSetup, stage_setup
from statorhom.physics.declared import declared_effects
from statorhom.physics.ring import ring_of
from statorhom.study.study import StudyFiles
from statorhom.study.study_file import FREE

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
        study, z, valleys = with_step(study, z, setup, _measured(setup, tests), settings)
    whole = tuple(s.with_tests(_measured(s.setup, tests)) for s in study.stages)
    return baseline_at(study.with_stages(whole), z, valleys)


def baseline_at(study: StudyModel, z: np.ndarray, valleys: tuple[np.ndarray, ...]) -> Baseline:
    """The declared model at the optimum next to some constants.

    Parameters
    ----------
    study : with all tests.
    z, valleys : constants there, and at other optima.
    """
    free_tests = tuple(s.with_tests(leading(s.tests)) for s in study.stages)
    z = refit(Hypothesis(study.with_stages(free_tests)), z).z
    free = evaluated(Hypothesis(study), z)
    same = all(t.support == FREE for s in study.stages for t in s.tests)
    return Baseline(study, free, free if same else refit(Hypothesis(study), z), valleys)


def _measured(setup: StageSetup, tests: Mapping[str, MeasuredTest]) -> Sequence[MeasuredTest]:
    """The tests of a step that were measured."""
    return [tests[t.name] for t in setup.tests if t.name in tests]
