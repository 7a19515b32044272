"""How the points of a support answer in one harmonic: its free modes there and its static flexibility.

A point of the stator is the image of a point of the half pitch, its local point. Its displacement in harmonic
h is ℓ y with the complex row ℓ = s e^{i k h α} (A ± i B): k is its pitch, A + i B the interpolation at the
local point; the lower sign and s = diag(1, -1, 1) belong to mirrored halves. The cosine family of a doublet's
shapes moves it by Re ℓ y, the sine family by Im ℓ y. Static solutions are needed for the local points only.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.eigen import SHIFT, factorize, modes_below
from statorhom.model.harmonic import Harmonic
from statorhom.model.supports import HeldPoints
from statorhom.model.surface import surface_points

_MIRROR = np.array([1.0, -1.0, 1.0])
DEPENDENT = 1e-12  # part of the largest eigenvalue below which combinations of rows vanish
_SAME = 1e-9  # rad and m: local points closer than this are one


@dataclass(frozen=True)
class LocalPoints:
    """The held points' images in the half pitch.

    Parameters
    ----------
    matrix : (3 l, 3 n) cylindrical components at each local point.
    row : (3 p,) row of `matrix` of each component of each held point.
    pitch : (3 p,) number of its slot pitch.
    side : (3 p,) -1 in the pitch's mirrored half, else 1.
    sign : (3 p,) what mirroring does to the component.
    slots : N.
    """

    matrix: sp.csr_array
    row: np.ndarray
    pitch: np.ndarray
    side: np.ndarray
    sign: np.ndarray
    slots: int

    def __len__(self) -> int:
        return len(self.row)

    def phase(self, order: int) -> np.ndarray:
        """s e^{i k h α} of every component."""
        return np.asarray(self.sign * np.exp(2j * np.pi * order / self.slots * self.pitch))

    def weights(self, order: int) -> tuple[sp.csr_array, sp.csr_array]:
        """Real and imaginary part of ℓ as combinations (3 p, 6 l) of the rows of A, then B."""
        phase, count = self.phase(order), self.matrix.shape[0]
        rows = np.tile(np.arange(len(self)), 2)
        columns = np.concatenate([self.row, self.row + count])
        shape = (len(self), 2 * count)
        turned = 1j * self.side * phase
        return (
            sp.csr_array((np.concatenate([phase.real, turned.real]), (rows, columns)), shape=shape),
            sp.csr_array((np.concatenate([phase.imag, turned.imag]), (rows, columns)), shape=shape),
        )


def local_points(mesh: HalfPitchMesh, points: HeldPoints) -> LocalPoints:
    """Images of held points."""
    alpha = 2 * np.pi / mesh.slots
    pitch = np.round(points.angles / alpha).astype(int)
    offset = points.angles - pitch * alpha
    keys = np.round(np.column_stack([np.abs(offset), points.z]) / _SAME).astype(np.int64)
    _, first, place = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    local = surface_points(mesh, np.abs(offset)[first], points.z[first])
    mirrored = offset < 0
    return LocalPoints(
        matrix=local.matrix,
        row=(3 * place.reshape(-1, 1) + np.arange(3)).ravel(),
        pitch=np.repeat(pitch % mesh.slots, 3),
        side=np.where(np.repeat(mirrored, 3), -1.0, 1.0),
        sign=np.where(mirrored[:, None], _MIRROR, 1.0).ravel(),
        slots=mesh.slots,
    )


@dataclass(frozen=True)
class PointResponse:
    """One harmonic problem's modes and what unit forces on the local points do.

    Parameters
    ----------
    harmonic : the problem.
    eigenvalues : (k,) of the modes without the points' support (rad²/s²).
    basis : (m, k + r) coordinates of these modes, of unit modal mass in the whole stator, then of the static
        responses (K + σ M)⁻¹ (A, B)ᵀ to the load patterns.
    patterns : (6 l, r) orthonormal combinations of the rows of (A, B) that span them.
    rows : (6 l, k) motion (A, B) of the local points in the modes.
    flexibility : (6 l, 6 l) motion of the local points under unit forces.
    inertia : (6 l, 6 l) mass products of the static responses.
    """

    harmonic: Harmonic
    eigenvalues: np.ndarray
    basis: np.ndarray
    patterns: np.ndarray
    rows: np.ndarray
    flexibility: np.ndarray
    inertia: np.ndarray

    @property
    def families(self) -> tuple[bool, ...]:
        """The shapes of a mode: False for the cosine, True for the sine family."""
        return {"pair": (False, True), "even": (False,), "odd": (True,)}[self.harmonic.parity]


def static_shift(highest_hz: float) -> float:
    """σ of the static responses of a band."""
    return SHIFT * (2 * np.pi * highest_hz) ** 2


def point_response(
    harmonic: Harmonic,
    K: sp.csr_array,
    M: sp.csr_array,
    points: LocalPoints,
    *,
    modes_hz: float,
    shift: float,
    expected: int,
) -> PointResponse:
    """Solve one harmonic problem.

    Parameters
    ----------
    harmonic : the problem.
    K, M : of the half pitch (3 n, 3 n).
    points : of the support.
    modes_hz : highest frequency of the modes.
    shift : σ of the static responses.
    expected : about how many modes there are.
    """
    stiffness, mass = harmonic.project(K), harmonic.project(M)
    values, vectors = modes_below(stiffness, mass, modes_hz, expected)
    vectors = vectors / np.sqrt(harmonic.copies)
    rows = sp.csr_array(sp.vstack([points.matrix @ harmonic.real, points.matrix @ harmonic.imaginary]))
    patterns = _independent(rows)
    loads = rows.T @ patterns
    statics = np.zeros(loads.shape)
    if loads.shape[1]:
        statics = factorize(sp.csr_array(stiffness + shift * mass))(loads) / harmonic.copies
    inertia = statics.T @ (mass @ statics) * harmonic.copies
    return PointResponse(
        harmonic,
        values,
        np.hstack([vectors, statics]),
        patterns,
        rows @ vectors,
        patterns @ (loads.T @ statics) @ patterns.T,
        patterns @ inertia @ patterns.T,
    )


def _independent(rows: sp.csr_array) -> np.ndarray:
    """Orthonormal combinations (6 l, r) of the rows: symmetries make many of them vanish or repeat others."""
    values, vectors = np.linalg.eigh((rows @ rows.T).toarray())
    return np.asarray(vectors[:, values > DEPENDENT * values.max(initial=0.0)])
