import numpy as np
import pytest

from measured_points import Z_M, cylinder, dof, radial_values
from statorhom.errors import IdentificationError
from statorhom.modes.measured_shape import measured_shapes
from statorhom.modes.point_layout import lay_out

ANGLES = 2 * np.pi * np.arange(12) / 12


def motion(angle, z):
    return (1 + 0.2j) * np.cos(2 * angle - 0.3) * (1 + 5 * z)


def test_radial_motion_stands_at_its_place():
    dofs = cylinder(ANGLES)
    (shape,) = measured_shapes(lay_out(dofs), radial_values(dofs, motion))
    expected = motion(ANGLES[None], np.array(Z_M)[:, None])
    np.testing.assert_allclose(shape.radial, expected, atol=1e-12)
    assert np.isnan(shape.tangential).all()
    assert shape.remarks == ()


def test_cartesian_sensors_are_resolved():
    angles = ANGLES + 0.2  # else x and y are themselves radial and tangential at some points
    dofs = [*cylinder(angles, component="x"), *cylinder(angles, component="y")]
    u, v = (lambda a: np.cos(2 * a)), (lambda a: -0.5 * np.sin(2 * a))
    values = [
        u(d.angle) * (np.array([np.cos(d.angle), np.sin(d.angle)]) @ d.direction[:2])
        + v(d.angle) * (np.array([-np.sin(d.angle), np.cos(d.angle)]) @ d.direction[:2])
        for d in dofs
    ]
    (shape,) = measured_shapes(lay_out(dofs), values)
    np.testing.assert_allclose(shape.radial, np.tile(u(angles), (4, 1)), atol=1e-12)
    np.testing.assert_allclose(shape.tangential, np.tile(v(angles), (4, 1)), atol=1e-12)


def test_missing_and_repeated_points():
    dofs = cylinder(ANGLES)
    values = radial_values(dofs, motion)
    again = [*dofs[1:], dofs[5]]
    (shape,) = measured_shapes(lay_out(again), np.append(values[1:], values[5]))
    assert np.isnan(shape.radial[0, 0])
    assert np.isfinite(shape.radial).sum() == 47
    assert shape.radial[0, 5] == pytest.approx(values[5])
    assert shape.remarks == ()


def test_contradictory_repeats_are_said_and_make_the_mean_uncertain():
    dofs = cylinder(ANGLES)
    values = radial_values(dofs, motion)
    (shape,) = measured_shapes(
        lay_out([*dofs, dofs[5]]), np.append(values, -values[5]), np.full(len(dofs) + 1, 1e-3)
    )
    assert "contradict each other at 150° at z = 4 mm" in shape.remarks[-1]
    assert shape.sd[0, 0, 5] > 0.5 * abs(values[5])
    assert shape.sd[0, 0, 4] == pytest.approx(1e-3)


def test_skew_sensors_are_said():
    dofs = cylinder(ANGLES)
    skew = dof(999, ANGLES[1], Z_M[0], component="x")
    (shape,) = measured_shapes(lay_out([*dofs[:1], skew, *dofs[2:]]), radial_values(dofs, motion))
    assert np.isnan(shape.radial[0, 1])
    assert "1 points have sensors" in shape.remarks[-1]


def test_sizes_must_fit():
    with pytest.raises(IdentificationError, match="48 degrees of freedom"):
        measured_shapes(lay_out(cylinder(ANGLES)), np.zeros(47))
