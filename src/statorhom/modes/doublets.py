"""Pairs of modes of one (r, n): their rotation, and the complex split that symmetry breaking gives them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.modes.antinode import Antinode
from statorhom.modes.mac import mac

FloatArray = npt.NDArray[np.float64]

_WIDEST_SPLIT = 0.1  # of the frequency: farther apart they are modes of two kinds, such as absorber pairs
_LARGEST_TURN_ERROR = np.radians(40.0)  # of r times the rotation, from 90°


@dataclass(frozen=True)
class DoubletPair:
    """Two modes of one (r, n).

    Attributes
    ----------
    lower, upper : int
        Numbers of the modes.
    order, axial : int, int or None
        Their name.
    rotation_rad, rotation_sd_rad : float
        Angle between the two antinodes, 0 … π/(2r), and its standard deviation (rad).
    ideal_rotation_rad : float
        π/(2r), that of a doublet of a ring.
    mac : float
        MAC of the two shapes; 0 if orthogonal.
    split : complex
        b_r in (rad/s)²: its modulus is the difference of the squared angular frequencies, its angle 2r
        times that of the upper mode's antinode: 2rθ₀ for a local stiffness at θ₀, 2rθ₀ + π for a mass.
    split_covariance : ndarray, shape (2, 2)
        Covariance of its real and imaginary part.
    """

    lower: int
    upper: int
    order: int
    axial: int | None
    rotation_rad: float
    rotation_sd_rad: float
    ideal_rotation_rad: float
    mac: float
    split: complex
    split_covariance: FloatArray


def find_doublets(
    axial: Sequence[int | None],
    antinodes: Sequence[Antinode | None],
    frequency_hz: npt.ArrayLike,
    frequency_sd_hz: npt.ArrayLike,
    shapes: Sequence[npt.ArrayLike],
) -> tuple[DoubletPair, ...]:
    """Recognise doublets: modes of one (r, n), close in frequency, turned by about 90°/r.

    Parameters
    ----------
    axial : sequence of int or None
        n of every mode.
    antinodes : sequence of Antinode or None
        Order and angle of every mode; None where it has none.
    frequency_hz, frequency_sd_hz : array_like, shape (modes,)
        Natural frequencies and their standard deviations (Hz).
    shapes : sequence of array_like
        Complex shapes at common points.

    Returns
    -------
    tuple of DoubletPair
        Each mode in one at most; the closest in frequency first.
    """
    f, sd = np.asarray(frequency_hz, dtype=float), np.asarray(frequency_sd_hz, dtype=float)
    candidates = []
    for i, first in enumerate(antinodes):
        for j, second in enumerate(antinodes):
            if first is None or second is None or first.order != second.order or axial[i] != axial[j]:
                continue
            apart = float(f[j] / f[i] - 1)
            later = j > i if apart == 0.0 else apart > 0.0
            if later and apart <= _WIDEST_SPLIT and _turned(first, second):
                candidates.append((apart, i, j))
    pairs: list[DoubletPair] = []
    taken: set[int] = set()
    for _, i, j in sorted(candidates):
        if taken.isdisjoint((i, j)):
            taken.update((i, j))
            ends = (antinodes[i], antinodes[j])
            pairs.append(_pair(i, j, axial[i], ends, f, sd, mac(shapes[i], shapes[j])))
    return tuple(pairs)


def _rotation(first: Antinode, second: Antinode) -> float:
    """Angle between two antinodes that repeat every π/r, 0 … π/(2r)."""
    period = np.pi / first.order
    turn = (second.angle_rad - first.angle_rad) % period
    return float(min(turn, period - turn))


def _turned(first: Antinode, second: Antinode) -> bool:
    noise = 3 * first.order * float(np.hypot(first.sd_rad, second.sd_rad))
    return abs(first.order * _rotation(first, second) - np.pi / 2) <= _LARGEST_TURN_ERROR + noise


def _pair(
    lower: int, upper: int, axial: int | None, ends: tuple[Antinode | None, Antinode | None],
    f: FloatArray, sd: FloatArray, likeness: float,
) -> DoubletPair:  # fmt: skip
    first, second = ends
    assert first is not None and second is not None
    split, covariance = complex_split(first, second, (f[lower], f[upper]), (sd[lower], sd[upper]))
    return DoubletPair(
        lower,
        upper,
        first.order,
        axial,
        _rotation(first, second),
        float(np.hypot(first.sd_rad, second.sd_rad)),
        np.pi / (2 * first.order),
        likeness,
        split,
        covariance,
    )


def complex_split(
    lower: Antinode,
    upper: Antinode,
    frequency_hz: tuple[float, float],
    frequency_sd_hz: tuple[float, float],
) -> tuple[complex, FloatArray]:
    """Complex split b_r = φ_cᵀδZφ_c − φ_sᵀδZφ_s + 2i φ_cᵀδZφ_s of a doublet, in (rad/s)².

    In the basis (cos rθ, sin rθ) the two modes are the principal directions of the 2 × 2 perturbation, so
    b_r = (λ_upper − λ_lower) e^{2irα} with the upper mode's antinode α. Both modes tell α: the lower one's
    antinode lies π/(2r) beside it, and the two are averaged by their variances.

    Returns
    -------
    split : complex
    covariance : ndarray, shape (2, 2)
        Of its real and imaginary part, to first order.
    """
    r = upper.order
    (f1, f2), (s1, s2) = frequency_hz, frequency_sd_hz
    size = (2 * np.pi) ** 2 * (f2**2 - f1**2)
    size_sd = 8 * np.pi**2 * float(np.hypot(f1 * s1, f2 * s2))
    smallest = np.finfo(float).tiny
    weights = 1 / np.maximum(np.array([upper.sd_rad, lower.sd_rad]) ** 2, smallest**0.5)
    turns = np.exp(2j * r * np.array([upper.angle_rad, lower.angle_rad])) * np.array([1, -1])
    angle = float(np.angle(weights @ turns))
    angle_sd = 2 * r / float(np.sqrt(weights.sum()))
    rotation = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    covariance = rotation @ np.diag([size_sd**2, (size * angle_sd) ** 2]) @ rotation.T
    covariance.setflags(write=False)
    return complex(size * np.exp(1j * angle)), covariance
