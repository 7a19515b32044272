import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from measured_points import Z_M, complex_noise, cylinder, radial_values
from statorhom.errors import IdentificationError
from statorhom.modes.amplitude_noise import amplitude_sd
from statorhom.modes.antinode import antinode
from statorhom.modes.measured_shape import measured_shapes
from statorhom.modes.order_spectrum import order_spectrum
from statorhom.modes.point_layout import lay_out

DOFS = cylinder(2 * np.pi * np.arange(24) / 24)
LAYOUT = lay_out(DOFS)


def found(r, angle, noise=0.0, seed=0, n=1):
    values = radial_values(DOFS, lambda a, z: 1j * np.cos(n * np.pi * z / 0.08) * np.cos(r * (a - angle)))
    values = values + complex_noise(np.random.default_rng(seed), values.shape, noise)
    (shape,) = measured_shapes(LAYOUT, values, np.full(len(DOFS), max(noise, 1e-6)))
    spectrum = order_spectrum(shape.radial, shape.angles_rad)
    return antinode(spectrum, r, amplitude_sd(shape, spectrum))


@settings(deadline=None, max_examples=25)
@given(st.integers(1, 11), st.floats(0.0, 6.28))
def test_the_angle_is_found_modulo_its_period(r, angle):
    place = found(r, angle)
    assert np.sin(r * (place.angle_rad - angle)) == pytest.approx(0.0, abs=1e-6)
    assert 0 <= place.angle_rad < np.pi / r
    assert place.standing_share == pytest.approx(1.0)


@pytest.mark.parametrize(("r", "n"), [(2, 0), (3, 1)])
def test_its_standard_deviation_is_what_repeats_show(r, n):
    places = [found(r, 0.3, noise=0.1, seed=seed, n=n) for seed in range(80)]
    z = np.array([(place.angle_rad - 0.3) / place.sd_rad for place in places])
    assert np.mean(z) == pytest.approx(0.0, abs=0.35)
    assert np.std(z) == pytest.approx(1.0, abs=0.25)


def test_orders_without_an_angle():
    values = radial_values(DOFS, lambda a, z: 1.0 + 0 * (a + z))
    (shape,) = measured_shapes(LAYOUT, values)
    spectrum = order_spectrum(shape.radial, shape.angles_rad)
    for order in (0, 12, 13):
        with pytest.raises(IdentificationError):
            antinode(spectrum, order, np.zeros((len(Z_M), 13, 2)))
