import numpy as np
import pytest

from measured_points import Z_M, complex_noise, cylinder, radial_values
from statorhom.modes.amplitude_noise import amplitude_sd, point_sd
from statorhom.modes.measured_name import name_measured
from statorhom.modes.measured_shape import measured_shapes
from statorhom.modes.order_spectrum import order_spectrum
from statorhom.modes.point_layout import lay_out


def mode(r, n):
    return lambda a, z: np.cos(n * np.pi * z / 0.08) * np.cos(r * a - 0.4) * np.exp(0.6j)


def named(r, n, count=24, noise=0.0, seed=0, sd=None, z_m=Z_M, missing=()):
    dofs = cylinder(2 * np.pi * np.arange(count) / count, z_m)
    values = radial_values(dofs, mode(r, n))
    values = values + complex_noise(np.random.default_rng(seed), values.shape, noise)
    values[list(missing)] = np.nan
    (shape,) = measured_shapes(lay_out(dofs), values, None if sd is None else np.full(len(dofs), sd))
    return name_measured(shape)


@pytest.mark.parametrize(("r", "n"), [(0, 0), (1, 1), (2, 0), (2, 1), (4, 1), (5, 2)])
def test_clear_shapes_are_certain(r, n):
    found = named(r, n, noise=0.02)
    assert (found.name.order, found.name.axial) == (r, n)
    assert found.confidence > 0.99


def test_aliases_are_said():
    found = named(2, 0)
    assert "24 equidistant angles show orders up to 12" in found.statement
    assert "2 could also be 22 or 26" in found.statement
    assert "4 planes show up to 3 node planes" in found.statement
    assert "one phase" in named(4, 0, count=8).statement
    assert "one plane does not show n" in named(2, 0, z_m=(0.01,)).statement


def test_what_cannot_be_told_is_not_named():
    every_other = [i for i in range(96) if i % 2]
    found = named(2, 0, missing=every_other[:-1])  # one point left of the other half
    assert found.name.order is None and found.confidence is None
    assert "cannot tell order" in found.statement
    few = named(2, 0, count=2)
    assert few.name is None and "2 different angles" in few.statement


def test_confidence_is_honest_where_noise_decides():
    # noise as large as the motion: names are often wrong, and their confidence must say so
    outcomes = [
        (found.name.order == 2, found.confidence)
        for seed in range(60)
        if (found := named(2, 0, count=8, noise=1.4, seed=seed, sd=1.4, z_m=(0.01,))).name is not None
        and found.confidence is not None
    ]
    right = np.array([ok for ok, _ in outcomes], dtype=float)
    claimed = np.array([confidence for _, confidence in outcomes])
    assert right.mean() < 0.95
    assert claimed.mean() < right.mean() + 3 * np.sqrt(0.25 / len(right))


@pytest.mark.parametrize("missing", [(), (3, 30, 41)])
def test_noise_of_amplitudes_is_what_repeats_show(missing):
    dofs = cylinder(2 * np.pi * np.arange(12) / 12)
    layout, rng = lay_out(dofs), np.random.default_rng(5)
    amplitudes, spreads, points = [], [], []
    for _ in range(100):
        values = radial_values(dofs, mode(2, 0)) + complex_noise(rng, len(dofs), 0.05)
        values[list(missing)] = np.nan
        (shape,) = measured_shapes(layout, values)
        spectrum = order_spectrum(shape.radial, shape.angles_rad)
        amplitudes.append(spectrum.cosine[:, 2])
        spreads.append(amplitude_sd(shape, spectrum)[:, 2, 0])
        points.append(np.nanmean(point_sd(shape, spectrum)))
    observed = np.sqrt(np.var(amplitudes, axis=0).mean())
    assert np.mean(spreads) == pytest.approx(observed, rel=0.3)
    assert np.mean(points) == pytest.approx(0.05, rel=0.3)
