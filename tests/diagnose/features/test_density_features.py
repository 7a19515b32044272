"""What weights say of densities: of a wrong weight or length, sheets would have to be of what nobody makes."""

from __future__ import annotations

import numpy as np
import pytest
from template_hypothesis import template_hypothesis

from statorhom.diagnose.features.density_features import density_features
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.stages.masses import KNOWN
from statorhom.physics.action import Action


@pytest.fixture(scope="module")
def stack(tmp_path_factory: pytest.TempPathFactory) -> Hypothesis:
    table = "frequency_hz,order,axial\n1428,2,0\n3770,3,0\n"
    return template_hypothesis(tmp_path_factory.mktemp("study"), {"stack-free.csv": table})


def feature(stack: Hypothesis, *actions: Action) -> Feature:
    values = stack.study.constants.values(np.zeros(stack.constants))
    (found,) = density_features(stack.study, values, actions)
    return found


def test_it_is_the_weight_over_the_volume_beside_what_is_usual_of_sheets(stack: Hypothesis) -> None:
    (stage,) = stack.study.stages
    weight = stack.study.files.study.stages[0].mass_kg
    found = feature(stack)
    assert found.measured == pytest.approx(weight / stack.study.volumes(stage.setup)["lamination"])
    assert (found.kind, found.key) == ("density", None)
    assert (found.predicted, found.sd) == KNOWN["stack"]


def test_a_corrected_weight_changes_it_in_proportion(stack: Hypothesis) -> None:
    weight = stack.study.files.study.stages[0].mass_kg
    heavier = feature(stack, Action(masses={stack.study.stages[0].name: 1.1 * weight}))
    assert heavier.measured == pytest.approx(1.1 * feature(stack).measured)


def test_a_corrected_length_changes_it_inversely(stack: Hypothesis) -> None:
    length = stack.study.files.drawing.core.length_mm
    longer = feature(stack, Action(dimensions={"core.length_mm": 1.25 * length}))
    assert longer.measured == pytest.approx(feature(stack).measured / 1.25)
