"""Where most modes agree, a mode of the same name far away is no partner; where none does, it is."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from statorhom import Study
from statorhom.command_line.template import write_template
from statorhom.diagnose.constants import study_constants
from statorhom.diagnose.features import SCATTER_SD
from statorhom.diagnose.hypothesis import Hypothesis
from statorhom.diagnose.measured import MeasuredTest
from statorhom.diagnose.prediction import predicted
from statorhom.diagnose.recorded import measured_tests
from statorhom.diagnose.stage_model import stage_model
from statorhom.diagnose.study_model import StudyModel
from statorhom.geometry.stator import stator_geometry
from statorhom.identify.stage_setup import stage_setup
from statorhom.mesh import uniform
from statorhom.study.modal_table import MeasuredMode

STRAY = 0.15  # of ln f: how far a mode with the name of another lies off


@pytest.fixture(scope="module")
def empty(tmp_path_factory: pytest.TempPathFactory) -> Hypothesis:
    """The declared model of a stack whose test is to be replaced."""
    folder: Path = tmp_path_factory.mktemp("study")
    write_template(folder)
    (folder / "stack-free.csv").write_text("frequency_hz,order,axial\n1428,2,0\n3770,3,0\n")
    files = Study.load(folder / "study.toml").files
    files, tests = measured_tests(files, folder)
    setup = stage_setup(files, stator_geometry(files.geometry, files.geometry_path), 0)
    constants = study_constants([setup], [2, 3], SCATTER_SD)
    study = StudyModel(files, stator_geometry(files.geometry, files.geometry_path), constants, ())
    values = constants.values(np.zeros(len(constants)))
    materials = study.declared(setup, values, study.masses(values, {}))
    stage = stage_model(setup, list(tests.values()), [materials], uniform(1))
    return Hypothesis(study.with_stages((stage,)))


def measured(empty: Hypothesis, shifts: dict[tuple[int, int], float]) -> Hypothesis:
    """The same with named modes that lie by so much above the model's own."""
    (stage,) = empty.study.stages
    values = empty.study.constants.values(np.zeros(empty.constants))
    known = predicted(empty.study, stage, values, ())
    own = {name: known[*name, 0].log_f + shift for name, shift in shifts.items()}
    rows = sorted(own.items(), key=lambda row: row[1])
    modes = tuple(
        MeasuredMode(i + 2, str(i), float(np.exp(log_f)), order=name[0], axial=name[1], frequency_sd_hz=1.0)
        for i, (name, log_f) in enumerate(rows)
    )
    test = MeasuredTest(0, stage.tests[0].name, "free", modes, False)
    return replace(empty, study=empty.study.with_stages((replace(stage, tests=(test,)),)))


def partners_at_rest(hypothesis: Hypothesis) -> dict[str, tuple[int, ...] | None]:
    paired = hypothesis.paired(np.zeros(len(hypothesis)))
    (stage,) = paired.study.stages
    (test,) = stage.tests
    assert paired.held is not None
    return {f"{m.order}, {m.axial}": key for m, key in zip(test.modes, paired.held[test.name], strict=True)}


def test_a_stray_mode_is_no_partner_where_the_others_agree(empty: Hypothesis) -> None:
    found = partners_at_rest(measured(empty, {(2, 0): 0.0, (3, 0): 0.001, (2, 1): STRAY}))
    assert found == {"2, 0": (2, 0, 0), "3, 0": (3, 0, 0), "2, 1": None}


def test_it_is_one_where_all_are_as_far_off(empty: Hypothesis) -> None:
    wide = replace(measured(empty, {(2, 0): STRAY, (3, 0): STRAY, (2, 1): STRAY}), discrepancy=0.03)
    assert partners_at_rest(wide) == {"2, 0": (2, 0, 0), "3, 0": (3, 0, 0), "2, 1": (2, 1, 0)}
