"""Modes of the supported stator in the basis of its symmetric free modes of all harmonics.

A support holds the points L u of the stator with springs S, or rigidly. The supported mode obeys
u = (λ + σ)(K + σM + LᵀSL)⁻¹ M u; with M u developed in the free modes φ_j, it is a sum of

    ψ_j = φ_j - Y X_j,  Y = (K + σM)⁻¹ Lᵀ,  X = S (1 + G S)⁻¹ L Φ,  G = L Y,

the free modes as the support lets them move: static responses to the support's own loads bring them back
(rigid: X = G⁻¹ L Φ, so that L ψ = 0). Y takes one small factorization per harmonic; the whole stator is never
factorized. Frequencies are upper bounds, and λ_j > λ_c, the cut of the free modes, are all that is missing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.linalg import cho_factor, cho_solve, eigh
from threadpoolctl import threadpool_limits

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.eigen import frequency_hz
from statorhom.model.end_faces import EndFaces, face_stiffness, held_spaces
from statorhom.model.harmonic import Harmonic, all_orders
from statorhom.model.point_flexibility import flexibility
from statorhom.model.point_response import (
    LocalPoints,
    PointResponse,
    local_points,
    point_response,
    static_shift,
)
from statorhom.model.ritz import standard_pairs
from statorhom.model.stator_mode import RIGID_HZ
from statorhom.model.supported_shapes import ShapePart, SupportedModes
from statorhom.model.supports import Support
from statorhom.study.regions import core_region

MARGIN = 2.0  # free modes reach this much higher than the band
# Below this part of its ring frequency a stator is rigid: of such a band the basis would be nothing but bodies,
# which a rigid support leaves nothing of.
LOWEST_BAND = 0.1
FIRST_GUESS = 10  # modes of a harmonic's first problem
DEPENDENT = 1e-10  # part of the largest eigenvalue below which directions are linear combinations of others

Map = Callable[
    [Callable[[int], tuple[PointResponse, ...]], Iterable[int]], Iterable[tuple[PointResponse, ...]]
]


@dataclass(frozen=True)
class HarmonicTask:
    """What a harmonic contributes; can be sent to other processes.

    Parameters
    ----------
    mesh : of the half pitch.
    K, M : of the half pitch, with the springs on the core's ends.
    ends : held end faces.
    points : held points.
    modes_hz : highest frequency of the free modes.
    shift : σ of the static responses.
    """

    mesh: HalfPitchMesh
    K: sp.csr_array
    M: sp.csr_array
    ends: EndFaces | None
    points: LocalPoints
    modes_hz: float
    shift: float

    def __call__(self, order: int) -> tuple[PointResponse, ...]:
        """All problems of a harmonic."""
        found: list[PointResponse] = []
        with threadpool_limits(limits=1, user_api="blas"):
            for space in held_spaces(self.mesh, order, self.ends):
                # the problems of one harmonic have about as many modes
                expected = len(found[-1].eigenvalues) + 2 if found else FIRST_GUESS
                found.append(self._response(space, expected))
        return tuple(found)

    def _response(self, space: Harmonic, expected: int) -> PointResponse:
        return point_response(
            space, self.K, self.M, self.points, modes_hz=self.modes_hz, shift=self.shift, expected=expected
        )


def solve_supported(
    model: AffineModel,
    materials: Materials,
    support: Support,
    highest_hz: float,
    *,
    margin: float = MARGIN,
    mapper: Map = map,
) -> SupportedModes:
    """All modes of the supported stator up to a frequency.

    Parameters
    ----------
    model : of the half pitch.
    materials : of every region of the model.
    support : on the model's mesh (`statorhom.model.supports.support_on`).
    highest_hz : upper end of the band.
    margin : the free modes taken reach up to `margin` times `highest_hz` (in a band below the stator's
        first modes: up to there).
    mapper : `map`, or the parallel map of an executor; it is called with a picklable function and the orders.

    Raises
    ------
    SolverError
        If a harmonic's problem cannot be solved.
    SupportError
        If the support leaves nothing that moves.
    """
    K, M = model.stiffness_matrix(materials), model.mass_matrix(materials)
    if support.ends is not None:
        K = sp.csr_array(K + face_stiffness(model.mesh, support.ends))
    points = local_points(model.mesh, support.points)
    basis_hz = max(highest_hz, LOWEST_BAND * _ring_hz(model, materials))
    modes_hz, shift = margin * basis_hz, static_shift(basis_hz)
    task = HarmonicTask(model.mesh, K, M, support.ends, points, modes_hz, shift)
    responses = [r for group in mapper(task, all_orders(model.mesh.slots)) for r in group]
    with threadpool_limits(limits=1, user_api="blas"):
        return _couple(points, support.points.stiffness, responses, highest_hz, modes_hz, shift)


def _ring_hz(model: AffineModel, materials: Materials) -> float:
    """Frequency at which a wave runs once round the core."""
    core = materials[core_region(materials)]
    return float(np.sqrt(core.hooke.matrix[1, 1] / core.density) / (2 * np.pi * model.mesh.outer_radius))


def _couple(
    points: LocalPoints,
    springs: sp.csr_array | None,
    responses: Sequence[PointResponse],
    highest_hz: float,
    modes_hz: float,
    shift: float,
) -> SupportedModes:
    free = np.concatenate([r.eigenvalues for r in responses for _ in r.families])
    motion = _motion(points, responses)
    G, H = flexibility(points, responses)
    X = _reaction(G, motion, springs)
    # with B = (Λ + σ)⁻¹ (L Φ)ᵀ the mass products of the free modes and the static responses
    B = motion.T / (free + shift)[:, None]
    A = np.diag(free + shift) - motion.T @ X
    mass = np.eye(len(free)) - B @ X - (B @ X).T + X.T @ H @ X
    values, q = _eigenpairs(A, mass, (2 * np.pi * highest_hz) ** 2 + shift)
    values = values - shift
    keep = frequency_hz(values) > RIGID_HZ
    values, q = values[keep], q[:, keep]
    forces = -X @ q
    error = _error(values, q, forces, free, B, H, shift, (2 * np.pi * modes_hz) ** 2)
    return SupportedModes(frequency_hz(values), error, _parts(points, responses, q, forces))


def _motion(points: LocalPoints, responses: Sequence[PointResponse]) -> np.ndarray:
    """L Φ: motion of the held points (3 p, …) in the modes of all problems and families."""
    columns = []
    for response in responses:
        weights = points.weights(response.harmonic.order)
        columns += [weights[int(sine)] @ response.rows for sine in response.families]
    return np.hstack(columns)


def _reaction(G: np.ndarray, motion: np.ndarray, springs: sp.csr_array | None) -> np.ndarray:
    """X: forces with which the support answers the modes' motion."""
    if len(motion) == 0:
        return motion
    if springs is None:
        values, vectors = eigh(G)
        # what some points can do is determined by what the others do
        keep = values > DEPENDENT * values[-1]
        return np.asarray(vectors[:, keep] @ ((vectors[:, keep].T @ motion) / values[keep, None]))
    values, vectors = eigh(springs.toarray())
    keep = values > DEPENDENT * values[-1]
    factor = vectors[:, keep] * np.sqrt(values[keep])
    inner = np.eye(factor.shape[1]) + factor.T @ G @ factor
    return np.asarray(factor @ cho_solve(cho_factor(inner), factor.T @ motion))


def _eigenpairs(A: np.ndarray, mass: np.ndarray, top: float) -> tuple[np.ndarray, np.ndarray]:
    """Eigenpairs up to `top`; a support that fixes a mode leaves a direction without mass."""
    weights, directions = eigh((mass + mass.T) / 2)
    keep = weights > DEPENDENT * weights[-1]
    basis = directions[:, keep] / np.sqrt(weights[keep])
    reduced = basis.T @ A @ basis
    values, vectors = standard_pairs((reduced + reduced.T) / 2, top)
    return values, basis @ vectors


def _error(
    values: np.ndarray,
    q: np.ndarray,
    forces: np.ndarray,
    free: np.ndarray,
    B: np.ndarray,
    H: np.ndarray,
    shift: float,
    cut: float,
) -> np.ndarray:
    """Relative frequency errors from the residual M d, ‖d‖² / (λ_c - λ) / 2 λ.

    Supports only stiffen: the supported modes that the basis lacks lie above the cut of the free ones.
    """
    own = q * (free[:, None] - values)
    squared = np.sum(own**2, axis=0) - 2 * (values + shift) * np.sum(own * (B @ forces), axis=0)
    squared += (values + shift) ** 2 * np.sum(forces * (H @ forces), axis=0)
    return np.maximum(squared, 0.0) / (cut - values) / (2 * values)


def _parts(
    points: LocalPoints, responses: Sequence[PointResponse], q: np.ndarray, forces: np.ndarray
) -> tuple[ShapePart, ...]:
    """Coordinates of the supported modes in every problem's own basis."""
    parts, first = [], 0
    for response in responses:
        weights = points.weights(response.harmonic.order)
        families: list[np.ndarray | None] = [None, None]
        for sine in response.families:
            last = first + len(response.eigenvalues)
            loads = response.patterns.T @ (weights[int(sine)].T @ forces)
            families[int(sine)] = np.vstack([q[first:last], loads])
            first = last
        parts.append(ShapePart(response.harmonic, response.basis, *families))
    return tuple(parts)
