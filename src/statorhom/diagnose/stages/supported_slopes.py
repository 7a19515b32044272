"""How supported frequencies follow the materials: the energy of every Hooke entry and the mass of every region.

A supported mode is no mean of free ones: springs bend the core between them, and what is rigid when free is not when
held. A few vectors per harmonic hold the shapes on springs of all stiffnesses; their energies are summed once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.diagnose.bases.ring_basis import RingProblem, affine_terms, grown
from statorhom.model.affine import AffineModel, Materials, hooke_coefficients
from statorhom.model.blas_threads import one_blas_thread
from statorhom.model.broken.problem_basis import ProblemBasis
from statorhom.model.broken.solve import BrokenModes
from statorhom.model.radial_profile import radial_profile

ROUNDING = 1e-13  # of a norm
LEAST = 1e-3  # part of the energy of a mode below which a direction is left out


@dataclass(frozen=True, eq=False)
class HeldShapes:
    """Shapes of supported modes, in the order of the broken basis's problems.

    Parameters
    ----------
    problems : energies of the vectors.
    images : per problem (w + s, k): what takes coordinates and surface loads of a mode to those of the vectors.
    """

    problems: tuple[RingProblem, ...]
    images: tuple[np.ndarray, ...]

    def slopes(self, modes: BrokenModes, held: np.ndarray, materials: Materials) -> np.ndarray:
        """d ln f of supported modes by the Hooke entries and the density of all regions, (modes, entries).

        Parameters
        ----------
        modes : on their springs.
        held : (modes,) share of the springs in the potential energy.
        materials : at which they were solved.
        """
        elastic = {r: np.zeros((9, len(modes))) for r in materials}
        inertial = {r: np.zeros(len(modes)) for r in materials}
        for number, (problem, image) in enumerate(zip(self.problems, self.images, strict=True)):
            for x in _coordinates(modes, number):
                c = image.T @ x
                for r in materials:
                    elastic[r] += np.sum(c * (problem.stiffness[r] @ c), axis=1)
                    inertial[r] += np.sum(c * (problem.mass[r] @ c), axis=0)
        # what the vectors leave out is small and follows the materials as the rest does
        energy = sum(hooke_coefficients(m.hooke) @ elastic[r] for r, m in materials.items())
        mass = sum(m.density * inertial[r] for r, m in materials.items())
        rows = [
            np.vstack([0.5 * (1.0 - held) * elastic[r] / energy, -0.5 * inertial[r] / mass])
            for r in materials
        ]
        return np.vstack(rows).T


def held_shapes(model: AffineModel, trainings: Sequence[BrokenModes]) -> HeldShapes:
    """Vectors that hold the shapes of some solutions in one basis, on whatever springs."""
    terms, profile = affine_terms(model), radial_profile(model.mesh)
    problems, images = [], []
    with one_blas_thread():
        for number, problem in enumerate(trainings[0].basis.problems):
            vectors, image = _directions(problem, trainings, number)
            space = problem.sector.space
            empty = RingProblem(space, np.zeros((space.size, 0)), {}, {}, np.zeros((0, 0)))
            problems.append(grown(empty, vectors, terms, profile))
            images.append(image)
    return HeldShapes(tuple(problems), tuple(images))


def _coordinates(modes: BrokenModes, number: int) -> list[np.ndarray]:
    """Of one problem and each family: coordinates of the basis, then loads on the surface, (w + s, modes)."""
    size, own = len(modes.basis.values), modes.coupled.statics
    q, f = modes.coordinates[:size], modes.coordinates[size:]
    places, loads = modes.basis.places[number], own.loads[number]
    return [np.vstack([q[place], loads[sine] @ f]) for sine, place in places.items()]


def _directions(
    problem: ProblemBasis, trainings: Sequence[BrokenModes], number: int
) -> tuple[np.ndarray, np.ndarray]:
    """Vectors (m, k), orthonormal in K + σM, and the image of coordinates in them."""
    sector = problem.sector
    snapshots = np.hstack([x / np.sqrt(t.eigenvalues) for t in trainings for x in _coordinates(t, number)])
    trace = problem.vectors[sector.loaded]
    inner = np.diag(problem.values + sector.shift)
    norm = np.block([[inner, trace.T], [trace, sector.answers.flexibility]])
    chosen = _principal(norm, snapshots)
    count = problem.vectors.shape[1]
    vectors = problem.vectors @ chosen[:count] + sector.answers.responses @ chosen[count:]
    return vectors, norm @ chosen


def _principal(norm: np.ndarray, snapshots: np.ndarray) -> np.ndarray:
    """Orthonormal coordinates (n, k) of what some snapshots (n, m) have in common, in a norm (n, n)."""
    if snapshots.shape[1] <= len(norm):
        values, rotation = _largest(snapshots.T @ norm @ snapshots)
        return np.asarray(snapshots @ rotation / np.sqrt(values))
    # a winding has more modes in the band than the basis has vectors
    # coordinates and loads have other units: without them every direction is seen
    unit = 1.0 / np.sqrt(np.diag(norm))
    norm, snapshots = unit[:, None] * norm * unit, snapshots / unit[:, None]
    sizes, axes = np.linalg.eigh((norm + norm.T) / 2)
    sizes, axes = sizes[sizes > ROUNDING * sizes[-1]], axes[:, sizes > ROUNDING * sizes[-1]]
    seen = np.sqrt(sizes)[:, None] * (axes.T @ snapshots)
    _, rotation = _largest(seen @ seen.T)
    return np.asarray(unit[:, None] * (axes @ (rotation / np.sqrt(sizes)[:, None])))


def _largest(gram: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues and vectors above `LEAST`."""
    values, rotation = np.linalg.eigh((gram + gram.T) / 2)
    return values[values > LEAST], rotation[:, values > LEAST]
