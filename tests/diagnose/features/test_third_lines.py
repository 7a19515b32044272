"""Which lost lines are the third ones of a name, and at what price."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.features.mode_features import free_features
from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.identify.residuals.model_error import ModelError
from statorhom.model.broken.named_response import Way
from statorhom.model.convergence import ModeKey
from statorhom.model.stator_mode import StatorMode
from statorhom.study.modal_table import MeasuredMode

KEY = (4, 1, 0)
DOUBLET = (-0.01, 0.01)  # lines about the mode's mean, ln f


def lines(*away: float, axial: int = 1, recorded: bool = False) -> MeasuredTest:
    """A doublet and further lines, the last of which have no partner."""
    rows = tuple(
        MeasuredMode(i, str(i), 5000.0 * float(np.exp(x)), 0.003, order=4, axial=axial if i > 1 else 1)
        for i, x in enumerate((*DOUBLET, *away))
    )
    return MeasuredTest(0, "t", "free", rows, recorded)


def features(test: MeasuredTest, *called: Way) -> list[Feature]:
    """With a mode of which these lines may be called by its name."""
    doublet = StatorMode(5000.0, 4, 1, "radial", 1.0, 2, 0, 0)
    mode = PredictedMode(KEY, doublet, float(np.log(5000.0)), 0.04 + 0j, 1e-3, lines=called)
    keys: tuple[ModeKey | None, ...] = (KEY, KEY, *(None for _ in test.modes[2:]))
    return free_features(test, test.modes, keys, {KEY: mode}, {}, ModelError())


OWN = tuple(Way(x, 0j, 0.9) for x in DOUBLET)


def test_a_third_line_that_stands_where_the_model_has_one_leaves_nothing() -> None:
    (third,) = [f for f in features(lines(0.03), *OWN, Way(0.03, 0j, 0.95)) if f.rows == ("2",)]
    assert not third.lost and third.key == KEY
    assert abs(third.residual) < 1e-6 and third.chance == 0.95
    assert third.least <= third.sd < 4e-3


@pytest.mark.parametrize(
    ("test", "called"),
    [
        (lines(0.03), OWN),
        (lines(0.012), OWN),
        (lines(0.03), (*OWN, Way(0.06, 0j, 0.95))),
        (lines(0.03), (*OWN, Way(0.03, 0j, 1e-6))),
        (lines(0.03, axial=2), (*OWN, Way(0.03, 0j, 0.95))),
    ],
    ids=["no line is there", "the lines are its mates'", "far away", "hardly called so", "another name"],
)
def test_what_is_no_third_line_is_lost(test: MeasuredTest, called: tuple[Way, ...]) -> None:
    (third,) = [f for f in features(test, *called) if f.rows == ("2",)]
    assert third.lost and third.key is None


def test_a_line_is_no_third_one_of_what_has_one_line_itself() -> None:
    """Then it would have been its partner."""
    test = lines(0.03)
    doublet = StatorMode(5000.0, 4, 1, "radial", 1.0, 2, 0, 0)
    mode = PredictedMode(
        KEY, doublet, float(np.log(5000.0)), 0.04 + 0j, 1e-3, lines=(*OWN, Way(0.03, 0j, 0.95))
    )
    found = free_features(test, test.modes, (KEY, None, None), {KEY: mode}, {}, ModelError())
    assert sum(f.lost for f in found) == 2


def test_the_list_of_features_is_as_long_with_a_third_line_as_with_a_lost_one() -> None:
    """Whatever is left out of it: a line that became a third one while its mode was left out was one row too many."""
    test = lines(0.03)
    with_it, without = features(test, *OWN, Way(0.03, 0j, 0.95)), features(test, *OWN)
    assert [(f.kind, f.rows, f.group) for f in with_it] == [(f.kind, f.rows, f.group) for f in without]
    assert {f.group for f in with_it} == {("t", KEY), ("t", None)}
