"""Modes of the symmetric stator at any materials near some that were solved: a small basis per harmonic problem."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from scipy.linalg import eigh

from statorhom.errors import SolverError
from statorhom.model.affine import AffineModel, Materials, hooke_coefficients
from statorhom.model.blas_threads import one_blas_thread
from statorhom.model.eigen import modes_below
from statorhom.model.harmonic import Harmonic, harmonic_spaces
from statorhom.model.radial_profile import node_planes, radial_profile
from statorhom.model.stator_mode import StatorMode, name_modes

DEPENDENT = 1e-6  # part of its mass by which a snapshot must differ from the others
REACH = 1.15  # snapshots reach this much higher than the band
MOST = 10  # modes of one problem per snapshot

Gradient = Mapping[str, tuple[np.ndarray, float]]


@dataclass(frozen=True, eq=False)
class RingProblem:
    """One harmonic problem in its basis.

    Parameters
    ----------
    space : the problem.
    basis : (m, k) coordinates.
    stiffness : region → (9, k, k) per unit Hooke entry.
    mass : region → (k, k) per unit density.
    profile : (p, k) radial order amplitudes of the basis's vectors.
    """

    space: Harmonic
    basis: np.ndarray
    stiffness: Mapping[str, np.ndarray]
    mass: Mapping[str, np.ndarray]
    profile: np.ndarray

    def matrices(self, materials: Materials) -> tuple[np.ndarray, np.ndarray]:
        """K and M (k, k)."""
        K = sum(
            np.tensordot(hooke_coefficients(materials[r].hooke), part, axes=1)
            for r, part in self.stiffness.items()
        )
        M = sum(materials[r].density * part for r, part in self.mass.items())
        return np.asarray(K), np.asarray(M)

    def slope(self, q: np.ndarray, value: float, materials: Materials) -> np.ndarray:
        """What a vector (k,) of a mode of λ = `value` gives to d ln f by Hooke entries and density of all regions."""
        return np.concatenate(
            [
                np.r_[0.5 / value * (self.stiffness[r] @ q @ q), -0.5 * float(q @ self.mass[r] @ q)]
                for r in materials
            ]
        )


@dataclass(frozen=True, eq=False)
class RingModes:
    """Modes at given materials.

    Parameters
    ----------
    modes : sorted by frequency, rigid bodies left out.
    values : per problem (j,) λ (rad²/s²).
    vectors : per problem (k, j).
    problems : of the basis.
    """

    modes: tuple[StatorMode, ...]
    values: tuple[np.ndarray, ...]
    vectors: tuple[np.ndarray, ...]
    problems: tuple[RingProblem, ...]

    def slope(self, mode: StatorMode, materials: Materials) -> np.ndarray:
        """d ln f by the Hooke entries and the density of all regions, one after the other."""
        q = self.vectors[mode.problem][:, mode.column]
        return self.problems[mode.problem].slope(q, (2 * np.pi * mode.frequency_hz) ** 2, materials)

    def log_frequency_gradient(self, mode: StatorMode) -> Gradient:
        """Region → derivative of ln f with respect to its nine Hooke entries and its density."""
        problem, q = self.problems[mode.problem], self.vectors[mode.problem][:, mode.column]
        value = (2 * np.pi * mode.frequency_hz) ** 2
        return {
            region: (0.5 / value * (part @ q @ q), -0.5 * float(q @ problem.mass[region] @ q))
            for region, part in problem.stiffness.items()
        }


@dataclass(frozen=True, eq=False)
class RingBasis:
    """The symmetric stator in small bases.

    Parameters
    ----------
    model : on the mesh.
    problems : of the harmonics that matter.
    highest_hz : upper end of the band.
    """

    model: AffineModel
    problems: tuple[RingProblem, ...]
    highest_hz: float

    def solve(self, materials: Materials) -> RingModes:
        """Modes of the band.

        Raises
        ------
        SolverError
            If a mass or stiffness is not definite.
        """
        return self.solve_matrices([p.matrices(materials) for p in self.problems], materials)

    def solve_matrices(
        self, matrices: Sequence[tuple[np.ndarray, np.ndarray]], materials: Materials
    ) -> RingModes:
        """The same of given K and M (k, k) per problem.

        Raises
        ------
        SolverError
            If a mass or stiffness is not definite.
        """
        mass = sum(materials[r].density * v for r, v in self.model.volumes.items())
        top = (2 * np.pi * self.highest_hz) ** 2
        found: list[StatorMode] = []
        solved = []
        with one_blas_thread():
            for number, (problem, (K, M)) in enumerate(zip(self.problems, matrices, strict=True)):
                try:
                    values, x = eigh(K, M)
                except np.linalg.LinAlgError:
                    raise SolverError("the mass of a region must be positive") from None
                solved.append((values, x))
                count = int(np.count_nonzero(values <= top))
                found += _named(problem, number, values[:count], x[:, :count], mass)
        found.sort(key=lambda mode: mode.frequency_hz)
        values_of, vectors = zip(*solved, strict=True) if solved else ((), ())
        return RingModes(tuple(found), values_of, vectors, self.problems)

    def extended(self, snapshots: Sequence[Materials], joints: Sequence[sp.csr_array] = ()) -> RingBasis:
        """With the modes at further materials, each with every one of some joints of the half pitch (N/m)."""
        profile = radial_profile(self.model.mesh)
        bonded = [(self.model.stiffness_matrix(m), self.model.mass_matrix(m)) for m in snapshots]
        matrices = [(sp.csr_array(K + joint), M) for K, M in bonded for joint in joints] or bonded
        problems = []
        with one_blas_thread():
            for problem in self.problems:
                space = problem.space
                added = [
                    modes_below(
                        sp.csr_array(space.project(K)),
                        sp.csr_array(space.project(M)),
                        REACH * self.highest_hz,
                        most=MOST,
                    )[1]
                    for K, M in matrices
                ]
                unit = sp.csr_array(space.project(matrices[0][1]))
                basis = joined(problem.basis, np.hstack(added), unit)
                problems.append(
                    projected(self.model, space, basis, profile.orders(space, space.expand(basis)))
                )
        return replace(self, problems=tuple(problems))


def ring_basis(
    model: AffineModel,
    snapshots: Sequence[Materials],
    highest_hz: float,
    orders: Sequence[int],
    joints: Sequence[sp.csr_array] = (),
) -> RingBasis:
    """Bases of the problems with radial motion of some orders.

    Parameters
    ----------
    model : of the half pitch.
    snapshots : materials whose modes span the bases.
    highest_hz : upper end of the band.
    orders : harmonics.
    joints : stiffness of the half pitch beside the materials' (N/m), with each of which the snapshots are solved.
    """
    spaces = [s for order in orders for s in harmonic_spaces(model.mesh, order) if s.parity != "odd"]
    empty = tuple(RingProblem(s, np.zeros((s.size, 0)), {}, {}, np.zeros((0, 0))) for s in spaces)
    return RingBasis(model, empty, highest_hz).extended(snapshots, joints)


def joined(basis: np.ndarray, added: np.ndarray, M: sp.csr_array) -> np.ndarray:
    """M-orthonormal basis of both."""
    added = added / np.sqrt(np.sum(added * (M @ added), axis=0))
    if basis.shape[1]:
        basis = basis / np.sqrt(np.sum(basis * (M @ basis), axis=0))
    joined = np.hstack([basis, added])
    values, rotation = np.linalg.eigh(joined.T @ (M @ joined))
    keep = values > DEPENDENT
    return np.asarray(joined @ (rotation[:, keep] / np.sqrt(values[keep])))


def projected(model: AffineModel, space: Harmonic, basis: np.ndarray, profile: np.ndarray) -> RingProblem:
    """A harmonic problem in a basis."""
    real, imaginary = space.real @ basis, space.imaginary @ basis

    def onto(matrix: sp.csr_array) -> np.ndarray:
        return np.asarray(space.copies * (real.T @ (matrix @ real) + imaginary.T @ (matrix @ imaginary)))

    stiffness = {
        region: np.stack([onto(model.stiffness_term(region, entry)) for entry in range(9)])
        for region in model.stiffness
    }
    return RingProblem(space, basis, stiffness, {r: onto(model.mass_term(r)) for r in model.mass}, profile)


def _named(
    problem: RingProblem, number: int, values: np.ndarray, vectors: np.ndarray, mass: float
) -> list[StatorMode]:
    amplitudes = problem.profile @ vectors
    count = len(values)
    return name_modes(
        values,
        amplitudes,
        node_planes(amplitudes) if count else np.empty(0, int),
        order=[problem.space.order] * count,
        multiplicity=[problem.space.multiplicity] * count,
        mass=mass,
        problem=[number] * count,
        column=range(count),
    )
