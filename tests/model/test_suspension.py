"""Rigid-body modes on cords: closed forms, and what they do to elastic modes."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.errors import SupportError
from statorhom.model.suspension import GRAVITY_M_S2, Cord, stiffened, suspend

CORNERS = [(x, y, 0.0) for x in (-0.4, 0.4) for y in (-0.1, 0.1)]


def cords(stiffness: float = 100.0, length: float | None = None) -> list[Cord]:
    return [Cord(place, stiffness, length_m=length) for place in CORNERS]


def test_heave_roll_and_pitch_of_a_plate_on_four_cords() -> None:
    inertia = (0.05, 0.9, 0.95)
    found = suspend(cords(), 3.0, inertia)
    heave, roll, pitch = 400 / 3, 400 * 0.01 / 0.05, 400 * 0.16 / 0.9
    expected = np.sqrt(sorted([heave, roll, pitch])) / (2 * np.pi)
    np.testing.assert_allclose(found.frequency_hz[:3], 0.0)
    np.testing.assert_allclose(found.frequency_hz[3:], expected)
    assert set(found.names[3:]) == {"along z", "about x", "about y"}


def test_long_cords_swing_like_a_pendulum() -> None:
    found = suspend(cords(length=1.5), 3.0, (0.05, 0.9, 0.95))
    pendulum = np.sqrt(GRAVITY_M_S2 / 1.5) / (2 * np.pi)
    for axis in ("along x", "along y"):
        assert pendulum * 0.8 < found.frequency_hz[found.names.index(axis)] < pendulum * 1.001
    assert found.frequency_hz[0] > 0.0


def test_cords_beside_the_centre_of_gravity_couple_heave_and_pitch() -> None:
    middle = suspend(cords(), 3.0, (0.05, 0.9, 0.95))
    beside = suspend(cords(), 3.0, (0.05, 0.9, 0.95), centre_m=(0.1, 0.0, 0.0))
    assert beside.frequency_hz[-1] >= middle.frequency_hz[-1]
    assert not np.allclose(beside.frequency_hz[3:], middle.frequency_hz[3:])


def test_without_an_inertia_the_mass_lies_where_the_cords_are() -> None:
    """Then all three motions that the cords resist have the frequency of the heave."""
    found = suspend(cords(), 3.0)
    np.testing.assert_allclose(found.frequency_hz[3:], np.sqrt(400 / 3) / (2 * np.pi), rtol=1e-6)


@pytest.mark.parametrize(
    ("elastic", "words"), [(50.3, "as good as free"), (12.0, "softer ones"), (5.0, "not free")]
)
def test_the_verdict(elastic: float, words: str) -> None:
    found = suspend(cords(), 3.0, (0.3, 0.9, 0.95))
    assert words in found.verdict(elastic)
    assert found.ratio(elastic) == pytest.approx(found.frequency_hz[-1] / elastic)


def test_cords_raise_an_elastic_frequency_as_springs_do() -> None:
    """Against the exact eigenvalues of a free chain of three masses."""
    k, m = 4000.0, 1.0
    chain = k * np.array([[1.0, -1, 0], [-1, 2, -1], [0, -1, 1]])
    bare, shapes = np.linalg.eigh(chain / m)
    held = np.linalg.eigvalsh(chain / m + np.diag([20.0, 0, 20.0]) / m)
    on_cords = np.sqrt(held[2]) / (2 * np.pi)
    amplitude = np.zeros((2, 3))
    amplitude[:, 2] = shapes[[0, 2], 2] / np.sqrt(m)
    ends = [Cord((x, 0.0, 0.0), 20.0) for x in (0.0, 1.0)]
    frequency, raised = stiffened(on_cords, ends, amplitude)
    assert frequency == pytest.approx(np.sqrt(bare[2]) / (2 * np.pi), rel=1e-5)
    assert raised == pytest.approx(on_cords - np.sqrt(bare[2]) / (2 * np.pi), rel=0.02)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: suspend([], 3.0), "one cord"),
        (lambda: suspend(cords(), -3.0), "positive mass"),
        (lambda: suspend(cords(), 3.0, (1.0, -1.0, 1.0)), "inertia"),
        (lambda: cords(-100.0), "stiffness"),
        (lambda: cords(100.0, 0.0), "length"),
        (lambda: Cord((0.0, 0.0, 0.0), 1.0, (0.0, 0.0, 0.0)), "direction"),
        (lambda: suspend(cords(), 3.0).verdict(0.0), "first elastic"),
        (lambda: stiffened(10.0, cords(), np.zeros((3, 3))), "amplitudes"),
        (lambda: stiffened(0.1, cords(), np.ones((4, 3))), "no elastic mode"),
    ],
)
def test_what_is_no_suspension_is_one_clear_line(make, words) -> None:
    with pytest.raises(SupportError, match=words):
        make()
