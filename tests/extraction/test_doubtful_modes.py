"""Which poles of a fit are no modes."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest

from statorhom.extraction.doubtful_modes import drop_doubtful, plausible, repeats
from statorhom.extraction.modal_model import Modes, Window, steady_modes
from statorhom.extraction.window_fit import WindowFit, fit_window

ComplexArray = npt.NDArray[np.complex128]

POINTS = 24
PLACE = 1.0 + 0.02j
NONE = steady_modes(np.zeros(0, dtype=complex), np.zeros((0, 2), dtype=complex))
ANGLES = 2 * np.pi * np.arange(POINTS) / POINTS
DOUBLET = np.stack([np.cos(3 * ANGLES), np.sin(3 * ANGLES)])  # (modes, points)


def recorded(residue: npt.NDArray[np.float64], quiet: bool = False, noise: float = 1e-3) -> Window:
    """Receptance of poles of one place: their residues' sum, shape (points, references), is all it shows."""
    rng = np.random.default_rng(4)
    squared = np.linspace(0.8, 1.2, 200) ** 2
    values = residue[:, :, None] / (PLACE - squared) + 0j
    sd = noise * np.abs(values).max()
    values += sd * (rng.normal(size=values.shape) + 1j * rng.normal(size=values.shape)) / np.sqrt(2)
    return Window(squared, values, np.full(values.shape, sd**-2.0), 1.0, quiet=quiet)


def as_two(window: Window, parts: ComplexArray) -> WindowFit:
    """Two poles at the place, with participations of anyone's choice: shapes that suit them follow."""
    poles = np.array([PLACE, PLACE + 1e-9])
    return fit_window(window, steady_modes(poles, parts), NONE, 0)


@pytest.mark.parametrize("quiet", [False, True])
def test_a_doublet_is_two_modes_in_whatever_shapes_it_is_written(quiet: bool) -> None:
    """Participations that hardly differ make two large shapes that nearly cancel, and are almost equal."""
    window = recorded(DOUBLET.T @ np.array([[1.0, 0.2], [0.1, 0.8]]), quiet)
    chosen = as_two(window, np.array([[1.0, 0.80], [1.0, 0.85]], dtype=complex))
    shapes = chosen.linear.coefficients / chosen.linear.norms
    mac = np.abs(np.vdot(shapes[:, 0], shapes[:, 1])) ** 2 / np.prod(
        np.sum(np.abs(shapes[:, :2]) ** 2, axis=0)
    )
    assert mac > 0.95
    assert not any(repeats(window, chosen, NONE, m) for m in range(2))
    assert len(drop_doubtful(window, chosen, NONE).modes) == 2


@pytest.mark.parametrize("quiet", [False, True])
def test_one_shape_in_one_place_is_one_mode(quiet: bool) -> None:
    window = recorded(np.outer(DOUBLET[0], [1.0, 0.6]), quiet)
    chosen = as_two(window, np.array([[1.0, 0.55], [1.0, 0.65]], dtype=complex))
    assert sum(repeats(window, chosen, NONE, m) for m in range(2)) == 1
    assert len(drop_doubtful(window, chosen, NONE).modes) == 1


def test_two_references_tell_no_third_mode_in_one_place() -> None:
    """Of three poles within a tenth of a bandwidth any two may hold both shapes of a doublet."""
    window = recorded(DOUBLET.T @ np.array([[1.0, 0.2], [0.1, 0.8]]))
    parts = np.array([[1.0, 0.1], [0.2, 1.0], [1.0, -0.9]], dtype=complex)
    three = steady_modes(PLACE + 0.02 * np.array([0.0, 0.04, 0.09]), parts)
    fit = fit_window(window, three, NONE, 3)
    assert sum(repeats(window, fit, NONE, m) for m in range(3)) == 1
    assert len(drop_doubtful(window, fit, NONE).modes) == 2


def test_what_a_ripple_could_be_is_a_mode_at_noise_alone() -> None:
    """A second shape of a twentieth of the first: beyond the noise it may be what the model lacks."""
    residue = np.outer(DOUBLET[0], [1.0, 0.6]) + 0.05 * np.outer(DOUBLET[1], [-0.6, 1.0])
    parts = np.array([[0.4, 1.6], [1.6, -0.4]], dtype=complex)
    heard = recorded(residue)
    assert not any(repeats(heard, as_two(heard, parts), NONE, m) for m in range(2))
    quiet = recorded(residue, quiet=True)
    assert any(repeats(quiet, as_two(quiet, parts), NONE, m) for m in range(2))


@pytest.mark.parametrize(
    ("pole", "expected"),
    [
        (1.0 + 0.02j, True),
        (-1.0 + 0.02j, False),
        (9.0 + 0.2j, False),
        (1.0 + 0.9j, False),
        (1.0 + 1e-6j, False),
    ],
    ids=["a mode", "unstable", "far beyond", "broader than the window", "narrower than a line"],
)
def test_a_window_shows_what_lies_in_it_and_is_neither_too_broad_nor_too_narrow(
    pole: complex, expected: bool
) -> None:
    assert plausible(recorded(DOUBLET.T), pole) is expected


def test_a_mode_that_is_removed_leaves_the_others() -> None:
    window = recorded(np.outer(DOUBLET[0], [1.0, 0.6]))
    narrow = steady_modes(np.array([PLACE, 0.81 + 1e-7j]), np.ones((2, 2), dtype=complex))
    kept: Modes = drop_doubtful(window, fit_window(window, narrow, NONE, 0), NONE).modes
    assert len(kept) == 1
    assert abs(kept.poles[0] - PLACE) < 1e-3
