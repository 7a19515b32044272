"""Where most modes agree, a mode of the same name far away is no partner; where none does, it is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from template_hypothesis import template_hypothesis

from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import predicted
from statorhom.study.modal_table import MeasuredMode

STRAY = 0.15  # of ln f: how far a mode with the name of another lies off


@pytest.fixture(scope="module")
def empty(tmp_path_factory: pytest.TempPathFactory) -> Hypothesis:
    """The declared model of a stack whose test is to be replaced."""
    table = "frequency_hz,order,axial\n1428,2,0\n3770,3,0\n"
    return template_hypothesis(tmp_path_factory.mktemp("study"), {"stack-free.csv": table})


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
