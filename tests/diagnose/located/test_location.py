"""What tells where an effect sits."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from statorhom.diagnose.located.location import located
from statorhom.diagnose.measured.measured_test import MeasuredSplit, MeasuredTest
from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.physics.parameter import EffectParameter, angle

MASS = EffectParameter("mass_kg", 0.01, 1.0, 1e-3, 10.0, "log", (0.1,))
SPLIT = MeasuredSplit("1", "2", 0.01 + 0j, 1e-4)


def explanation(test: MeasuredTest, action: Action) -> SimpleNamespace:
    """A lump at 1 rad, its angle well known to the optimum's curvature."""
    candidate = Candidate("attached_mass", "stack", (MASS, angle()))
    stage = SimpleNamespace(name="stack", tests=(test,))
    hypothesis = SimpleNamespace(
        study=SimpleNamespace(stages=(stage,)),
        candidates=(candidate,),
        parameters=((0, 0), (0, 1)),
        constants=0,
        actions=lambda _: (action,),
        effect_values=lambda _: ({"mass_kg": 0.1, "angle_rad": 1.0},),
        features=lambda _: [],
    )
    refit = SimpleNamespace(hypothesis=hypothesis, z=np.zeros(2), covariance=1e-4 * np.eye(2))
    return SimpleNamespace(candidates=(candidate,), refit=refit)


@pytest.mark.parametrize(
    ("test", "action", "known"),
    [
        (MeasuredTest(0, "t", "free", ()), Action(), False),
        (MeasuredTest(0, "t", "free", (), True, (SPLIT,)), Action(), True),
        (MeasuredTest(0, "t", "clamp", ()), Action(), True),
        (MeasuredTest(0, "t", "free", (), True, (SPLIT,)), Action(tests=frozenset({"other"})), False),
    ],
)
def test_bare_frequencies_of_a_free_ring_tell_no_place(
    test: MeasuredTest, action: Action, known: bool
) -> None:
    found = located(explanation(test, action), 0)  # type: ignore[arg-type]
    assert (found is not None) == known
    if found is not None:
        assert found.angle_deg == pytest.approx(np.rad2deg(1.0), abs=1e-3)
