"""Which angles no row tells."""

from __future__ import annotations

from dataclasses import replace

from statorhom.diagnose.fits.untold import untold_angles
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.physics.parameter import EffectParameter, angle

MASS = EffectParameter("mass_kg", 0.01, 1.0, 1e-3, 10.0, "log", (0.1,), 0.0)
TABLE = MeasuredTest(0, "t", "free", (), False)


def test_a_table_tells_none_of_a_lone_effect() -> None:
    assert untold_angles((MASS, angle()), (TABLE,)) == (1,)


def test_between_two_effects_it_tells_the_angle() -> None:
    assert untold_angles((MASS, angle(), MASS, angle()), (TABLE,)) == ()


def test_recordings_and_supports_tell_it() -> None:
    for other in (replace(TABLE, recorded=True), replace(TABLE, support="clamped")):
        assert untold_angles((MASS, angle()), (TABLE, other)) == ()


def test_what_is_nowhere_has_none() -> None:
    assert untold_angles((MASS,), (TABLE,)) == ()
