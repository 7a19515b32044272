"""What no row tells: the angle of a lone effect in tables of free tests."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.physics.parameter import EffectParameter
from statorhom.study.study_file import FREE


def untold_angles(parameters: Sequence[EffectParameter], tests: Sequence[MeasuredTest]) -> tuple[int, ...]:
    """Numbers of parameters that turn all that breaks the symmetry together, where no test knows an angle.

    What teeth make of it says where within a slot pitch the effect would fit best. Laplace's volume would take the
    slope from one edge of a tooth to the next for knowledge of a whole turn.

    Parameters
    ----------
    parameters : of all effects.
    tests : of all steps.
    """
    angles = tuple(k for k, parameter in enumerate(parameters) if parameter.scale == "angle")
    seen = any(test.recorded or test.support != FREE for test in tests)
    return () if seen or len(angles) != 1 else angles
