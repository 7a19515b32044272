"""Points and directions of measurements."""

import numpy as np
import pytest

from statorhom.recordings.dof import Dof


def test_a_cartesian_direction_is_resolved_at_its_point():
    dof = Dof(7, position=(0.0, 0.06, 0.02), direction=(0.0, 1.0, 0.0))
    assert dof.cylindrical_direction == pytest.approx((1.0, 0.0, 0.0), abs=1e-15)
    assert dof.angle == pytest.approx(np.pi / 2)


def test_what_the_file_does_not_say_stays_unknown():
    assert Dof(7).angle is None
    assert Dof(7, direction=(1.0, 0.0, 0.0)).cylindrical_direction is None
