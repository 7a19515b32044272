import numpy as np
import pytest

from measured_points import complex_noise, cylinder, radial_values
from statorhom.errors import IdentificationError
from statorhom.modes.measured_shape import measured_shapes
from statorhom.modes.point_layout import lay_out
from statorhom.modes.shape_features import shape_features

DOFS = cylinder(2 * np.pi * np.arange(16) / 16)
MIDDLE, HALF = 0.04, 0.036


def mixed(a, z):
    height = (z - MIDDLE) / HALF
    return -2 * np.exp(1.1j) * (np.cos(2 * a - 0.6) + 0.05 * np.sin(3 * a) - 0.03 * height * np.cos(a))


def features(values, sd=None):
    (shape,) = measured_shapes(lay_out(DOFS), values, sd)
    return shape_features(shape)


def test_sidebands_of_both_parities_are_those_put_in():
    found = features(radial_values(DOFS, mixed))
    assert found.order == 2
    assert found.antinode.angle_rad == pytest.approx(0.3)
    assert found.phase_collinearity == pytest.approx(1.0)
    assert (found.sideband_cosine[0, 2], found.sideband_sine[0, 2]) == pytest.approx(
        (np.cos(0.6), np.sin(0.6))
    )
    assert found.sideband_sine[0, 3] == pytest.approx(0.05)
    assert found.sideband_cosine[1, 1] == pytest.approx(-0.03)
    others = np.abs(found.sideband_cosine) + np.abs(found.sideband_sine)
    others[0, [2, 3]] = others[1, 1] = 0
    assert others.max() < 1e-9


def test_standard_deviations_are_what_repeats_show():
    rng, clean = np.random.default_rng(2), radial_values(DOFS, mixed)
    sd = np.full(clean.size, 0.06)
    runs = [features(clean + complex_noise(rng, clean.shape, 0.06), sd) for _ in range(80)]
    for row, order in ((0, 3), (1, 1), (0, 5)):
        observed = np.std([run.sideband_sine[row, order] for run in runs])
        assert np.mean([run.sideband_sd[row, order, 1] for run in runs]) == pytest.approx(observed, rel=0.25)


def test_one_plane_has_no_odd_part_and_order_zero_no_angle():
    dofs = cylinder(2 * np.pi * np.arange(16) / 16, z_m=(0.02,))
    (shape,) = measured_shapes(lay_out(dofs), np.ones(16))
    found = shape_features(shape)
    assert found.antinode is None
    assert np.isnan(found.sideband_cosine[1]).all()
    assert found.sideband_cosine[0, 0] == pytest.approx(1.0)


def test_without_an_order_there_are_no_features():
    values = radial_values(DOFS, mixed)
    values[[i for i in range(64) if i % 2 and i != 5]] = np.nan
    with pytest.raises(IdentificationError, match="cannot tell order"):
        features(values)
