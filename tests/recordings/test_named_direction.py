"""Directions by their names."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from statorhom.recordings.dof import Dof
from statorhom.recordings.named_direction import DIRECTIONS, direction_name, direction_vector


@given(
    name=st.sampled_from([sign + name for name in DIRECTIONS for sign in ("", "-")]),
    angle=st.floats(0.1, 1.4),
    radius=st.floats(1e-3, 10.0),
)
def test_names_come_back(name, angle, radius):
    position = (radius * float(np.cos(angle)), radius * float(np.sin(angle)), 0.3)
    vector = direction_vector(name, position)
    assert vector is not None and np.linalg.norm(vector) == pytest.approx(1.0)
    assert direction_name(Dof(1, position, vector)) == name


def test_radial_is_outwards_and_tangential_counts_from_x_to_y():
    assert direction_vector("r", (0.0, -2.0, 1.0)) == (0.0, -1.0, 0.0)
    assert direction_vector("+theta", (2.0, 0.0, 1.0)) == (0.0, 1.0, 0.0)


def test_what_has_no_direction_or_no_name():
    assert direction_vector("r", None) is None and direction_vector("theta", (0.0, 0.0, 1.0)) is None
    assert direction_name(Dof(1)) == ""
    assert direction_name(Dof(1, (1.0, 0.0, 0.0), (0.6, 0.8, 0.0))) is None
    for name in ("", "radial", "--z", "-"):
        with pytest.raises(ValueError):
            direction_vector(name, None)
