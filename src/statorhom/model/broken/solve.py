"""Modes of the broken stator, with an error estimate of every frequency, enriched until the errors are small."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.stats import chi2

from statorhom.errors import SolverError
from statorhom.model.blas_threads import one_blas_thread
from statorhom.model.broken.basis import SymmetricBasis
from statorhom.model.broken.change import Change, PieceChange
from statorhom.model.broken.coupling import Coupled, couple
from statorhom.model.broken.dense_modes import lowest_coupled
from statorhom.model.broken.enrich import enriched
from statorhom.model.broken.problem_basis import PROBES
from statorhom.model.broken.soften import softened
from statorhom.model.eigen import frequency_hz
from statorhom.model.stator_mode import RIGID_HZ
from statorhom.model.supported_shapes import ShapePart, SupportedModes
from statorhom.model.surface import SurfacePoints

TOLERANCE = 1e-3  # relative error of every frequency in the band
EXPECTED = (
    1.2  # eigenvalues of the basis up to this many times the band's end tell about how many modes there are
)
BEYOND = 1.1  # how much higher than the band's end modes are looked at
ROUNDS = 12  # enrichments before giving up
NEARLY = 0.3  # of the tolerance: errors from which on modes take part in an enrichment
# The first enrichment leaves out directions that would lower the frequencies together by less than this part of the
# tolerance, the next one by its square.
NEGLIGIBLE = 0.2
CONFIDENCE = 0.95  # of the error estimates
_MIRROR = np.array([1.0, -1.0, 1.0])
DEPENDENT = 1e-10  # part of its mass by which a static response must differ from the basis


@dataclass(frozen=True, eq=False)
class BrokenModes:
    """Modes of a stator whose symmetry is broken, of unit modal mass, by ascending frequency.

    Parameters
    ----------
    basis : in which they were solved; other angles and strengths of the same changes need no further enrichment.
    coupled : the problem in that basis.
    eigenvalues : (modes,) rad²/s².
    coordinates : (n, modes).
    errors : (modes,) estimated relative errors of the frequencies against the mesh's own.
    """

    basis: SymmetricBasis
    coupled: Coupled
    eigenvalues: np.ndarray
    coordinates: np.ndarray
    errors: np.ndarray

    def __post_init__(self) -> None:
        for array in (self.eigenvalues, self.coordinates, self.errors):
            array.setflags(write=False)

    def __len__(self) -> int:
        return len(self.eigenvalues)

    @property
    def frequencies_hz(self) -> np.ndarray:
        """(modes,) natural frequencies."""
        return frequency_hz(self.eigenvalues)

    @cached_property
    def participation(self) -> np.ndarray:
        """(w, modes) of the symmetric stator's modes in these: products by mass, in which static responses have a part.

        Coordinates alone may exceed what a mode has of another one, where a static response takes it back.
        """
        size, statics = len(self.basis.values), self.coupled.statics
        modal = self.coordinates[:size]
        return modal if len(statics) == 0 else modal + statics.answers.products @ self.coordinates[size:]

    def motion(self, points: SurfacePoints) -> np.ndarray:
        """Motion (u_r, u_θ, u_z) of all modes at points of the outer surface, (p, 3, modes) in 1/√kg.

        The same as that of the shapes, without making these: only the surface's coordinates move the surface.
        """
        straight, mirrored = self._surface_waves()
        surface, slots = self.basis.problems[0].sector.surface, self.basis.mesh.slots
        on_surface = points.matrix[:, surface]
        side = np.repeat(points.mirrored, 3)
        total = np.zeros((3 * len(points), len(self)))
        for order, wave in straight.items():
            local = np.empty(total.shape, dtype=complex)
            local[~side] = on_surface[~side] @ wave
            local[side] = on_surface[side] @ mirrored[order]
            turn = np.exp(2j * np.pi / slots * (order * points.pitch % slots))
            total += (local * np.repeat(turn, 3)[:, None]).real
        sign = np.where(points.mirrored[:, None, None], _MIRROR[:, None], 1.0)
        return np.asarray(sign * total.reshape(len(points), 3, len(self)))

    def _surface_waves(self) -> tuple[dict[int, np.ndarray], dict[int, np.ndarray]]:
        """Per harmonic: (d, modes) complex motion of the surface of a straight half pitch, and of a mirrored one.

        Its real part, turned by the pitch's phase, is the motion: that of the cosine and -i times that of the sine
        family, each conjugate where the half pitch is mirrored.
        """
        size, own = len(self.basis.values), self.coupled.statics
        q, f = self.coordinates[:size], self.coordinates[size:]
        straight: dict[int, np.ndarray] = {}
        mirrored: dict[int, np.ndarray] = {}
        for number, (problem, places) in enumerate(zip(self.basis.problems, self.basis.places, strict=True)):
            sector, order = problem.sector, problem.sector.space.order
            for sine, place in places.items():
                loaded = problem.surface_parts[0] @ q[place]
                if len(own):
                    loaded = loaded + sector.answers.flexibility @ (own.loads[number][sine] @ f)
                moved, factor = sector.moved @ loaded, -1j if sine else 1.0
                straight[order] = straight.get(order, 0.0) + factor * moved
                mirrored[order] = mirrored.get(order, 0.0) + factor * np.conj(moved)
        return straight, mirrored

    @property
    def shapes(self) -> SupportedModes:
        """The modes' motion of the surface and of the whole stator."""
        parts = []
        size = len(self.basis.values)
        q, f = self.coordinates[:size], self.coordinates[size:]
        own = self.coupled.statics
        for number, (problem, places) in enumerate(zip(self.basis.problems, self.basis.places, strict=True)):
            part = own.responses[number] if len(own) else {}
            used = [problem.vectors, *part.values()]
            families: list[np.ndarray | None] = [None, None]
            for sine, place in places.items():
                forces = [f if other is sine else np.zeros_like(f) for other in part]
                families[int(sine)] = np.vstack([q[place], *forces])
            parts.append(ShapePart(problem.sector.space, np.hstack(used), *families))
        return SupportedModes(self.frequencies_hz, self.errors, tuple(parts))


def solve_broken(
    basis: SymmetricBasis, changes: Sequence[Change], tolerance: float | None = TOLERANCE
) -> BrokenModes:
    """Modes of the basis's band, rigid bodies left out.

    Parameters
    ----------
    basis : of the symmetric stator.
    changes : all that breaks its symmetry.
    tolerance : largest estimated relative error of a frequency; the basis is enriched until it is met. None:
        solve in the basis as it is.

    Raises
    ------
    SolverError
        If the tolerance cannot be met, or the changes leave a mass or a stiffness that is not definite.
    """
    with one_blas_thread():
        if tolerance is None:
            return _within(_solve(basis, changes))
        basis = softened(basis, [c for c in changes if isinstance(c, PieceChange)])
        modes = _solve(basis, changes)
        for trial in range(1, ROUNDS + 1):
            poor = _in_band(modes) & (modes.errors > tolerance)
            if not np.any(poor):
                return _within(modes)
            # what is nearly good enough gains too
            poor |= _in_band(modes) & (modes.errors > NEARLY * tolerance)
            values, x = modes.eigenvalues[poor], modes.coordinates[:, poor]
            basis = enriched(basis, modes.coupled, values, x, NEGLIGIBLE**trial * tolerance)
            modes = _solve(basis, changes)
    worst = modes.errors[_in_band(modes)].max(initial=0.0)
    if worst > tolerance:
        raise SolverError(
            f"the broken symmetry is solved to {100 * worst:.2g} % only; widen the margin of its basis"
        )
    return _within(modes)


def _solve(basis: SymmetricBasis, changes: Sequence[Change]) -> BrokenModes:
    """Modes up to `BEYOND` the band: a mode that the basis represents badly may lie above it and belong inside."""
    coupled = couple(basis, changes)
    values, x = _eigenpairs(coupled, basis)
    keep = frequency_hz(values) > RIGID_HZ
    values, x = values[keep], x[:, keep]
    return BrokenModes(basis, coupled, values, x, _errors(basis, coupled, values, x))


def _in_band(modes: BrokenModes) -> np.ndarray:
    """Modes whose true frequencies may lie in the band."""
    return np.asarray(modes.frequencies_hz * (1 - np.minimum(modes.errors, 1.0)) <= modes.basis.highest_hz)


def _within(modes: BrokenModes) -> BrokenModes:
    return _chosen(modes, modes.frequencies_hz <= modes.basis.highest_hz)


def _chosen(modes: BrokenModes, keep: np.ndarray) -> BrokenModes:
    values, x, errors = modes.eigenvalues[keep], modes.coordinates[:, keep], modes.errors[keep]
    return replace(modes, eigenvalues=values, coordinates=x, errors=errors)


def _eigenpairs(coupled: Coupled, basis: SymmetricBasis) -> tuple[np.ndarray, np.ndarray]:
    K, M = coupled.K, coupled.M
    top = (2 * np.pi * BEYOND * basis.highest_hz) ** 2
    # softer pieces bring modes down into the band
    expected = int(np.count_nonzero(basis.values < EXPECTED * top)) + 8
    change = _orthogonal(coupled, len(basis.values))
    if change is not None:
        K, M = (_turned(A, change, len(basis.values)) for A in (K, M))
    try:
        values, x = lowest_coupled((K + K.T) / 2, (M + M.T) / 2, top, basis.shift, expected)
    except np.linalg.LinAlgError:
        raise SolverError(
            "the changes leave a mass or a stiffness that is not positive; check their magnitudes"
        ) from None
    return values, x if change is None else change @ x


def _orthogonal(coupled: Coupled, size: int) -> np.ndarray | None:
    """Coordinates (n, k) in which the static responses are orthonormal among each other and to the basis."""
    statics = coupled.statics
    if len(statics) == 0:
        return None
    inside, inertia = statics.answers.products, statics.answers.inertia
    scale = 1 / np.sqrt(np.diag(inertia))
    outside = (inertia - inside.T @ inside) * scale * scale[:, None]
    values, vectors = np.linalg.eigh(outside)
    keep = values > DEPENDENT
    columns = scale[:, None] * vectors[:, keep] / np.sqrt(values[keep])
    return np.block([[np.eye(size), -inside @ columns], [np.zeros((len(statics), size)), columns]])


def _turned(matrix: np.ndarray, change: np.ndarray, size: int) -> np.ndarray:
    """cᵀAc of a symmetric A where c leaves the first coordinates, of which there are many more, as they are."""
    columns = change[:, size:]
    right = matrix @ columns
    return np.block([[matrix[:size, :size], right[:size]], [right[:size].T, columns.T @ right]])


def _errors(basis: SymmetricBasis, coupled: Coupled, values: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Relative frequency errors: the residual in the norm of (K + σM)⁻¹, over what lies above the cut.

    λ̃ - λ = Σ c²(λ_i - λ) and ‖r‖² = Σ c²(λ_i - λ)²/(λ_i + σ) over the missing modes i, all above the cut.
    Without probes nobody knows.
    """
    if len(coupled.probe_mass) == 0:
        return np.full(len(values), np.nan)
    residual = (coupled.probe_stiffness @ x - (coupled.probe_mass @ x) * values) ** 2
    squared = np.sum(residual, axis=0) / PROBES
    # the fewer samples carry the sum the more it scatters: its upper confidence limit counts
    samples = np.sum(residual, axis=0) ** 2 / np.maximum(np.sum(residual**2, axis=0), np.finfo(float).tiny)
    squared = squared * samples / chi2.ppf(1 - CONFIDENCE, samples)
    cut = (2 * np.pi * basis.cut_hz) ** 2
    return np.asarray(0.5 * squared * (cut + basis.shift) / (cut - values) / values)
