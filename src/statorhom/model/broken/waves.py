"""Columns of the whole stator's motion, each a wave of one circumferential harmonic.

A column û of harmonic h moves half pitch 2 k as û e^{i k h α} and its mirrored neighbour 2 k + 1, in that half's own
mirrored axes, as conj(û) e^{i k h α}. The real part is its cosine, the imaginary part its sine family.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from statorhom.model.surface import SurfacePoints

_MIRROR = np.array([1.0, -1.0, 1.0])


@dataclass(frozen=True, eq=False)
class Waves:
    """Columns of all harmonics; coordinates count the cosine families first, then the sine families.

    Parameters
    ----------
    shapes : (3 n, w) complex displacements û of the half pitch.
    order : (w,) harmonic of each column.
    cosine, sine : numbers of the columns that have that family.
    slots : N.
    """

    shapes: np.ndarray
    order: np.ndarray
    cosine: np.ndarray
    sine: np.ndarray
    slots: int

    def __post_init__(self) -> None:
        for array in (self.shapes, self.order, self.cosine, self.sine):
            array.setflags(write=False)

    def __len__(self) -> int:
        return len(self.cosine) + len(self.sine)

    @cached_property
    def phases(self) -> np.ndarray:
        """e^{i k h α} of pitch k and column, (N, w)."""
        turn = np.outer(np.arange(self.slots), self.order) % self.slots
        return np.asarray(np.exp(2j * np.pi / self.slots * turn))

    def families(self, complex_rows: np.ndarray) -> np.ndarray:
        """Real rows (…, coordinates) of complex ones (…, w)."""
        return np.concatenate(
            [complex_rows.real[..., self.cosine], complex_rows.imag[..., self.sine]], axis=-1
        )

    def spread(self, coordinates: np.ndarray) -> np.ndarray:
        """Complex weights (w, …) c such that the motion is Re(Σ c û e^{i k h α})."""
        weights = np.zeros((len(self.order), *coordinates.shape[1:]), dtype=complex)
        weights[self.cosine] += coordinates[: len(self.cosine)]
        # Im z = Re(-i z)
        weights[self.sine] -= 1j * coordinates[len(self.cosine) :]
        return weights

    def at_points(self, points: SurfacePoints) -> np.ndarray:
        """Motion (3 p, coordinates) of points of the stator."""
        local = (points.matrix @ self.shapes).reshape(len(points), 3, -1)
        mirrored = points.mirrored[:, None, None]
        local = np.where(mirrored, np.conj(local) * _MIRROR[:, None], local)
        turned = local * self.phases[points.pitch][:, None, :]
        return self.families(turned.reshape(3 * len(points), -1))

    def in_copies(self, dofs: np.ndarray, coordinates: np.ndarray) -> np.ndarray:
        """Motion (2 N, d, t) of some displacements in the axes of every half pitch."""
        weights = self.spread(coordinates)
        local = self.shapes[dofs]
        motion = np.empty((2 * self.slots, len(dofs), coordinates.shape[1]))
        motion[0::2] = self._turned(local, weights)
        motion[1::2] = self._turned(np.conj(local), weights)
        return motion

    def _turned(self, local: np.ndarray, weights: np.ndarray) -> np.ndarray:
        """Re(Σ c û e^{i k h α}) of all pitches k, (N, d, t)."""
        N = self.slots
        spectrum = np.zeros((N // 2 + 1, len(local), weights.shape[1]), dtype=complex)
        for order, own in self._of_order.items():
            # the transform counts these two harmonics once, others with their conjugate
            factor = N if order in (0, N / 2) else N / 2
            spectrum[order] = factor * (local[:, own] @ weights[own])
        return np.fft.irfft(spectrum, N, axis=0)

    def work(self, dofs: np.ndarray, forces: np.ndarray) -> np.ndarray:
        """Work (coordinates, t) of forces (2 N, d, t) on some displacements in the axes of every half pitch."""
        # Σ e^{i k h α} F of real forces
        straight, mirrored = (np.conj(np.fft.rfft(forces[side::2], axis=0)) for side in (0, 1))
        rows = np.empty((forces.shape[2], len(self.order)), dtype=complex)
        for order, own in self._of_order.items():
            local = self.shapes[np.ix_(dofs, own)]
            rows[:, own] = straight[order].T @ local + mirrored[order].T @ np.conj(local)
        return self.families(rows).T

    @cached_property
    def _of_order(self) -> dict[int, np.ndarray]:
        """Harmonic → numbers of its columns."""
        return {int(order): np.flatnonzero(self.order == order) for order in np.unique(self.order)}
