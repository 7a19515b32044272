"""All Ritz modes of a true stator in one test: rigid bodies, those of the band, and those above it as residuals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import eigh

from statorhom.conceal.ground import StageGround
from statorhom.conceal.truth import Absorber
from statorhom.model.broken.change import Attachment, Change, PieceChange
from statorhom.model.broken.coupling import piece_matrices
from statorhom.model.broken.grams import project
from statorhom.model.broken.pieces import Pieces
from statorhom.model.broken.solve import BrokenModes, solve_broken
from statorhom.model.eigen import frequency_hz
from statorhom.model.stator_mode import RIGID_HZ
from statorhom.model.supported_shapes import SupportedModes
from statorhom.model.surface import SurfacePoints, surface_points

# estimated errors of the frequencies against the mesh's own; what rattles within a lost contact has so many local
# shapes that an accurate solution takes gigabytes
TOLERANCE, LOOSE_TOLERANCE = 1e-3, 2e-2
DEPENDENT = 1e-9  # part of a coordinate's mass below which it repeats others
REFERENCE_HZ = 1000.0  # where a modulus that varies with frequency has its declared value
LEAST = 0.05  # of the modulus stays
ROUNDS = 30


@dataclass(frozen=True)
class Losses:
    """Loss factors: of the regions, and of every attachment by its number."""

    regions: Mapping[str, float]
    attachments: Mapping[int, float]


@dataclass(frozen=True, eq=False)
class RitzModes:
    """Modes of unit modal mass, by ascending frequency.

    Parameters
    ----------
    ground : of the symmetric stator.
    modes : coordinates of all modes in the broken problem.
    loss_factors : (m,).
    """

    ground: StageGround
    modes: BrokenModes
    loss_factors: np.ndarray

    def __post_init__(self) -> None:
        self.loss_factors.setflags(write=False)

    @property
    def eigenvalues(self) -> np.ndarray:
        """(m,) rad²/s²; of rigid bodies 0."""
        return self.modes.eigenvalues

    @property
    def in_band(self) -> np.ndarray:
        """Numbers of the elastic modes of the band."""
        f = self.modes.frequencies_hz
        return np.flatnonzero((f > RIGID_HZ) & (f <= self.ground.highest_hz))

    @property
    def band_shapes(self) -> SupportedModes:
        """Shapes of the band's modes."""
        keep = self.in_band
        chosen = replace(
            self.modes,
            eigenvalues=self.modes.eigenvalues[keep],
            coordinates=self.modes.coordinates[:, keep],
            errors=self.modes.errors[keep],
        )
        return chosen.shapes

    def motion(self, angles: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Motion (p, 3, m) of points of the surface (u_r, u_θ, u_z), 1/√kg."""
        return self.modes.shapes.motion(surface_points(self.ground.mesh, angles, z))


def ritz_modes(
    ground: StageGround,
    changes: Sequence[Change],
    weak: Sequence[PieceChange],
    losses: Losses,
    absorbers: Sequence[Absorber] = (),
    slopes: Mapping[str, float] | None = None,
) -> RitzModes:
    """Solve a test.

    Parameters
    ----------
    ground : of the stage.
    changes : what breaks the symmetry.
    weak : what hardly does, by parts in a thousand of the stiffness: felt by the symmetric modes that the solution is
        made of, not by the local fields of springs and lumps.
    losses : of regions and attachments.
    absorbers : on the surface.
    slopes : region → relative change of its modulus per decade of frequency.

    Raises
    ------
    SolverError
        If the changes are too strong for the basis.
    """
    solved = solve_broken(ground.basis, changes, TOLERANCE if ground.contact is None else LOOSE_TOLERANCE)
    K = solved.coupled.K.copy()
    size, basis = len(solved.basis.values), solved.basis
    for change in weak:
        assert change.stiffness is not None, "scatter is one of stiffness"
        K[:size, :size] += project(basis.grams, change.stiffness, change.weights, basis.waves, basis.waves)
    K, M = _with_absorbers(ground, solved, K, absorbers)
    size = len(solved.coupled.K)
    if slopes:
        values, x = _frequency_dependent(ground, solved, (K, M), slopes)
    else:
        values, x = _all_pairs(K, M)
    own = x[:size]
    modes = replace(solved, eigenvalues=values, coordinates=own, errors=np.zeros(len(values)))
    eta = _loss_factors(ground, modes, changes, losses)
    eta = _with_absorber_losses(eta, x[size:], values, absorbers)
    return RitzModes(ground, modes, eta)


def _all_pairs(K: np.ndarray, M: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """All eigenpairs in coordinates that may depend on each other."""
    scale = 1 / np.sqrt(np.diag(M))
    weights, rotation = np.linalg.eigh(M * scale * scale[:, None])
    keep = weights > DEPENDENT
    basis = scale[:, None] * rotation[:, keep] / np.sqrt(weights[keep])
    values, x = eigh(basis.T @ K @ basis)
    rigid = values < (2 * np.pi * RIGID_HZ) ** 2
    return np.where(rigid, 0.0, values), basis @ x


def _with_absorbers(
    ground: StageGround, solved: BrokenModes, K: np.ndarray, absorbers: Sequence[Absorber]
) -> tuple[np.ndarray, np.ndarray]:
    """K and M with one coordinate more for every absorber: the radial motion of its mass."""
    M = solved.coupled.M
    size = len(K)
    unit = replace(solved, eigenvalues=np.ones(size), coordinates=np.eye(size), errors=np.zeros(size))
    for absorber in absorbers:
        point = surface_points(ground.mesh, np.array([absorber.angle]), np.array([absorber.z]))
        row = np.zeros(len(K) + 1)
        row[:size] = unit.shapes.motion(point)[0, 0]
        row[-1] = -1.0
        stiffness = absorber.mass_kg * (2 * np.pi * absorber.relative_frequency * ground.elliptic_hz) ** 2
        K = np.pad(K, (0, 1)) + stiffness * np.outer(row, row)
        M = np.pad(M, (0, 1))
        M[-1, -1] = absorber.mass_kg
    return K, M


def _frequency_dependent(
    ground: StageGround,
    solved: BrokenModes,
    matrices: tuple[np.ndarray, np.ndarray],
    slopes: Mapping[str, float],
) -> tuple[np.ndarray, np.ndarray]:
    """Eigenpairs of K(ω): every mode at the stiffness of its own frequency; those above the band at the band's end."""
    K, M = matrices
    parts = [(slope, _region_matrix(ground, solved, region, len(K))) for region, slope in slopes.items()]

    def at(frequency: float) -> tuple[np.ndarray, np.ndarray]:
        decades = np.log10(frequency / REFERENCE_HZ)
        factors = [max(slope * decades, LEAST - 1.0) for slope, _ in parts]
        return _all_pairs(K + sum(f * part for f, (_, part) in zip(factors, parts, strict=True)), M)

    values, x = at(ground.highest_hz)
    values, x = values.copy(), x.copy()
    f = frequency_hz(values)
    for mode in np.flatnonzero((f > RIGID_HZ) & (f <= 1.1 * ground.highest_hz)):
        guess = f[mode]
        for _ in range(ROUNDS):
            own, vectors = at(guess)
            new = float(frequency_hz(own)[mode])
            done = abs(new - guess) < 1e-7 * guess
            guess = new
            if done:
                break
        values[mode], x[:, mode] = own[mode], vectors[:, mode]
    return values, x


def _region_matrix(ground: StageGround, solved: BrokenModes, region: str, size: int) -> np.ndarray:
    """Stiffness of a region in the coordinates of the problem."""
    part: Pieces = ground.pieces(region)
    weights = np.ones((len(part), 2 * ground.mesh.slots))
    inner, _ = piece_matrices(solved.basis, solved.coupled.statics, part, weights)
    return np.pad(inner, (0, size - len(inner)))


def _loss_factors(
    ground: StageGround, modes: BrokenModes, changes: Sequence[Change], losses: Losses
) -> np.ndarray:
    """Loss factors by the shares of the strain energy (modal strain energy method)."""
    shapes = modes.shapes
    values = np.maximum(modes.eigenvalues, 1.0)
    shares = shapes.strain_energy_shares(ground.model, ground.materials)
    own = sum(losses.regions[region] * share for region, share in shares.items())
    springs, lost = np.zeros(len(values)), np.zeros(len(values))
    for number, change in enumerate(changes):
        if isinstance(change, Attachment) and np.any(change.stiffness):
            share = _spring_share(shapes, change.rows, change.stiffness, change.points, values)
            springs += share
            lost += share * losses.attachments.get(number, 0.0)
    elastic = modes.frequencies_hz > RIGID_HZ
    return np.where(elastic, np.asarray(own) * (1 - np.minimum(springs, 1.0)) + lost, 0.0)


def _spring_share(
    shapes: SupportedModes, rows: np.ndarray, stiffness: np.ndarray, points: SurfacePoints, values: np.ndarray
) -> np.ndarray:
    u = rows @ shapes.motion(points).reshape(-1, len(shapes))
    return np.asarray(np.sum(u * (stiffness @ u), axis=0) / values)


def _with_absorber_losses(
    eta: np.ndarray, own: np.ndarray, values: np.ndarray, absorbers: Sequence[Absorber]
) -> np.ndarray:
    """Absorbers dissipate by their share of the kinetic energy, which near resonance is that of strain."""
    for absorber, row in zip(absorbers, own, strict=True):
        share = np.minimum(absorber.mass_kg * row**2, 1.0)
        eta = eta * (1 - share) + share * absorber.loss_factor
    return np.where(values > 0, eta, 0.0)
