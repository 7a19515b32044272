"""Whether a body on cords is as good as free: its rigid-body frequencies against the first elastic one.

A cord along d with stiffness k and tension T resists the displacement of its lower end by
k ddᵀ + (T/L)(1 − ddᵀ) for a length L: along itself as a spring, across as a pendulum. Source of the limit: Ewins,
Modal Testing, 2000, section 3.2: the highest rigid-body frequency below 10 … 20 % of the first elastic one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.linalg import eigh

from statorhom.errors import SupportError

FloatArray = npt.NDArray[np.float64]
Vector = tuple[float, float, float]

GRAVITY_M_S2 = 9.80665
FREE, DOUBTFUL = 0.1, 0.2  # highest rigid-body over lowest elastic frequency
_NAMES = ("along x", "along y", "along z", "about x", "about y", "about z")


@dataclass(frozen=True)
class Cord:
    """A cord that carries a body.

    Attributes
    ----------
    position_m : (x, y, z)
        Where it holds the body, in the frame in which the centre of gravity is given (m).
    stiffness_n_per_m : float
    direction : (x, y, z)
        From the body to the cord's other end, any length.
    length_m : float or None
        Where given, the cord resists sideways motion like a pendulum.

    Raises
    ------
    SupportError
        When the stiffness or the length is not positive or the direction has none.
    """

    position_m: Vector
    stiffness_n_per_m: float
    direction: Vector = (0.0, 0.0, 1.0)
    length_m: float | None = None

    def __post_init__(self) -> None:
        if not (np.isfinite(self.stiffness_n_per_m) and self.stiffness_n_per_m > 0.0):
            raise SupportError(f"a cord's stiffness must be positive (N/m), not {self.stiffness_n_per_m:g}")
        if self.length_m is not None and not self.length_m > 0.0:
            raise SupportError(f"a cord's length must be positive (m), not {self.length_m:g}")
        if not np.isfinite([*self.position_m, *self.direction]).all() or not np.any(self.direction):
            raise SupportError("a cord needs a position and a direction, three numbers each")

    def matrix(self, tension_n: float) -> FloatArray:
        """Stiffness of the lower end against displacement (N/m), shape (3, 3)."""
        d = np.asarray(self.direction) / np.linalg.norm(self.direction)
        along = np.outer(d, d)
        across = 0.0 if self.length_m is None else tension_n / self.length_m
        return np.asarray(self.stiffness_n_per_m * along + across * (np.eye(3) - along))


@dataclass(frozen=True)
class Suspension:
    """Rigid-body modes of a suspended body.

    Attributes
    ----------
    frequency_hz : array, shape (6,)
        Ascending; 0 for motions that nothing resists.
    motion : array, shape (6, 6)
        Of each mode in columns: displacement of the centre of gravity (x, y, z), rotation about it times the
        radius of gyration; of unit length.
    """

    frequency_hz: FloatArray
    motion: FloatArray

    def __post_init__(self) -> None:
        self.frequency_hz.setflags(write=False)
        self.motion.setflags(write=False)

    @property
    def names(self) -> tuple[str, ...]:
        """What each mode mostly is: "along z", "about x" …"""
        return tuple(_NAMES[i] for i in np.argmax(np.abs(self.motion), axis=0).tolist())

    def ratio(self, first_elastic_hz: float) -> float:
        """Highest rigid-body frequency over the lowest elastic one."""
        return float(self.frequency_hz[-1]) / first_elastic_hz

    def verdict(self, first_elastic_hz: float) -> str:
        """One line: free, doubtful or not free.

        Raises
        ------
        SupportError
            When the elastic frequency is not positive.
        """
        if not first_elastic_hz > 0.0:
            raise SupportError(f"the first elastic frequency must be positive (Hz), not {first_elastic_hz:g}")
        ratio = self.ratio(first_elastic_hz)
        line = (
            f"the highest rigid-body mode ({self.names[-1]}, {self.frequency_hz[-1]:.2f} Hz) lies at "
            f"{100 * ratio:.1f} % of the first elastic mode ({first_elastic_hz:g} Hz): "
        )
        if ratio <= FREE:
            return line + "as good as free"
        if ratio <= DOUBTFUL:
            return line + "count the cords as springs, or take softer ones"
        return line + "not free; take softer or longer cords, or model them"


def suspend(
    cords: Sequence[Cord],
    mass_kg: float,
    inertia_kg_m2: npt.ArrayLike | None = None,
    centre_m: Vector | None = None,
) -> Suspension:
    """Rigid-body modes of a body on cords.

    Parameters
    ----------
    cords : sequence of Cord
    mass_kg : float
    inertia_kg_m2 : array_like, shape (3, 3) or (3,), optional
        About the centre of gravity; by default that of the mass spread evenly over the places of the cords,
        which is too small for a body that reaches beyond them.
    centre_m : (x, y, z), optional
        Centre of gravity; by default the middle of the cords.

    Raises
    ------
    SupportError
        When there are no cords, or mass or inertia are not those of a body.
    """
    if not cords or not (np.isfinite(mass_kg) and mass_kg > 0.0):
        raise SupportError("a suspension needs one cord at least and a body with a positive mass (kg)")
    places = np.array([cord.position_m for cord in cords], dtype=float)
    arms = places - (places.mean(axis=0) if centre_m is None else np.asarray(centre_m))
    inertia = _inertia(arms, mass_kg) if inertia_kg_m2 is None else _given(inertia_kg_m2)
    stiffness = np.zeros((6, 6))
    tension = mass_kg * GRAVITY_M_S2 / len(cords)
    for cord, arm in zip(cords, arms, strict=True):
        to_point = np.hstack([np.eye(3), -_cross(arm)])  # displacement of the cord's place
        stiffness += to_point.T @ cord.matrix(tension) @ to_point
    mass = np.zeros((6, 6))
    mass[:3, :3], mass[3:, 3:] = mass_kg * np.eye(3), inertia
    values, vectors = eigh(stiffness, mass)
    size = np.sqrt(np.diag(mass))[:, None] * vectors
    rounding = 1e-12 * float(np.abs(values).max())
    frequency = np.sqrt(np.where(values > rounding, values, 0.0)) / (2 * np.pi)
    return Suspension(frequency, size / np.linalg.norm(size, axis=0))


def stiffened(frequency_hz: float, cords: Sequence[Cord], amplitude: npt.ArrayLike) -> tuple[float, float]:
    """Frequency of an elastic mode without its cords, and by how much they raise it (Hz), to first order.

    Each cord adds kφ² to ω², φ the mass-normalised amplitude along it (physics of a ground spring).

    Parameters
    ----------
    frequency_hz : float
        As measured on the cords.
    amplitude : array_like, shape (cords, 3)
        Mass-normalised motion (1/√kg) where the cords hold the body.

    Raises
    ------
    SupportError
        When the amplitudes do not fit the cords, or the cords would carry the whole frequency.
    """
    phi = np.asarray(amplitude, dtype=float)
    if phi.shape != (len(cords), 3):
        raise SupportError(f"{len(cords)} cords need amplitudes of shape ({len(cords)}, 3), not {phi.shape}")
    added = sum(float(row @ cord.matrix(0.0) @ row) for row, cord in zip(phi, cords, strict=True))
    square = (2 * np.pi * frequency_hz) ** 2 - added
    if square <= 0.0:
        raise SupportError(
            f"the cords alone would hold this mode at {frequency_hz:g} Hz: it is no elastic mode"
        )
    bare = float(np.sqrt(square)) / (2 * np.pi)
    return bare, frequency_hz - bare


def _inertia(arms: FloatArray, mass_kg: float) -> FloatArray:
    share = mass_kg / len(arms)
    moments = sum(share * (arm @ arm * np.eye(3) - np.outer(arm, arm)) for arm in arms)
    least = 1e-9 * mass_kg * max(float(np.abs(arms).max()), 1e-3) ** 2
    return np.asarray(moments + least * np.eye(3))


def _given(inertia: npt.ArrayLike) -> FloatArray:
    array = np.asarray(inertia, dtype=float)
    matrix: FloatArray = np.diag(array) if array.ndim == 1 else array
    symmetric = matrix.shape == (3, 3) and np.isfinite(matrix).all() and np.allclose(matrix, matrix.T)
    if not symmetric or np.linalg.eigvalsh(matrix)[0] <= 0.0:
        raise SupportError(
            "an inertia (kg m²) is three positive numbers or a positive symmetric 3 × 3 matrix"
        )
    return matrix


def _cross(arm: FloatArray) -> FloatArray:
    x, y, z = arm
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
