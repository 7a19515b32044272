"""Modes of the symmetric stator at any materials near some that were solved: a small basis per harmonic problem."""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
import scipy.sparse as sp

from statorhom.diagnose.bases.small_pairs import small_pairs
from statorhom.diagnose.processes.side_by_side import side_by_side, workers
from statorhom.model.affine import AffineModel, Materials, hooke_coefficients
from statorhom.model.blas_threads import one_blas_thread
from statorhom.model.cyclic.half_pitch import half_pitches
from statorhom.model.cyclic.modes import modes_of
from statorhom.model.free_modes import total_mass
from statorhom.model.harmonic import Harmonic, harmonic_spaces
from statorhom.model.pitch_parts import pitch_parts
from statorhom.model.radial_profile import RadialProfile, node_planes, radial_profile
from statorhom.model.stator_mode import StatorMode, name_modes

DEPENDENT = 1e-7  # part of the norm by which a snapshot must differ from the others
REACH = 1.15  # snapshots reach this much higher than the band
MOST = 10  # modes of one problem per snapshot
UNSOLVED = np.zeros((0, 0)), np.zeros((0, 0))  # matrices of a problem whose modes nobody wants


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
        coefficients = np.concatenate([hooke_coefficients(materials[r].hooke) for r in self.stiffness])
        mass = self.mass_matrix(materials)
        return (coefficients @ self._flat[0]).reshape(mass.shape), mass

    def mass_matrix(self, materials: Materials) -> np.ndarray:
        """M (k, k)."""
        density = np.array([materials[r].density for r in self.stiffness])
        return np.asarray((density @ self._flat[1]).reshape((self.basis.shape[1],) * 2))

    @cached_property
    def _flat(self) -> tuple[np.ndarray, np.ndarray]:
        """Parts of K and M as rows, region by region."""
        stiffness = [part.reshape(9, -1) for part in self.stiffness.values()]
        return np.concatenate(stiffness), np.stack([self.mass[region].ravel() for region in self.stiffness])

    def slope(self, q: np.ndarray, value: float, materials: Materials) -> np.ndarray:
        """What a vector (k,) of a mode of λ = `value` gives to d ln f by Hooke entries and density of all regions."""
        return material_slope(q, value, self._flat, tuple(self.stiffness), materials)


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

    @property
    def sizes(self) -> tuple[int, ...]:
        """Vectors of every problem: what was made of a basis holds as long as these stay."""
        return tuple(p.basis.shape[1] for p in self.problems)

    def solve(self, materials: Materials, numbers: Container[int] | None = None) -> RingModes:
        """Modes of the band.

        Parameters
        ----------
        materials : of all regions.
        numbers : of the problems whose modes are wanted; those of all by default.

        Raises
        ------
        SolverError
            If a mass or stiffness is not definite.
        """
        matrices = [
            p.matrices(materials) if numbers is None or i in numbers else UNSOLVED
            for i, p in enumerate(self.problems)
        ]
        return self.solve_matrices(matrices, materials)

    def solve_matrices(
        self, matrices: Sequence[tuple[np.ndarray, np.ndarray]], materials: Materials
    ) -> RingModes:
        """The same of given K and M (k, k) per problem.

        Raises
        ------
        SolverError
            If a mass or stiffness is not definite.
        """
        mass = total_mass(self.model, materials)
        with one_blas_thread():
            solved = [small_pairs(K, M) for K, M in matrices]
        values_of, vectors = zip(*solved, strict=True) if solved else ((), ())
        return RingModes(self._named(values_of, vectors, mass), values_of, vectors, self.problems)

    def _named(
        self, values: Sequence[np.ndarray], vectors: Sequence[np.ndarray], mass: float
    ) -> tuple[StatorMode, ...]:
        """Modes of the band by frequency."""
        top = (2 * np.pi * self.highest_hz) ** 2
        counts = [int(np.count_nonzero(v <= top)) for v in values]
        numbers = [i for i, count in enumerate(counts) for _ in range(count)]
        if not numbers:
            return ()
        used = list(zip(self.problems, values, vectors, counts, strict=True))
        amplitudes = np.hstack([p.profile @ x[:, :count] for p, _, x, count in used if count])
        spaces = [self.problems[i].space for i in numbers]
        found = name_modes(
            np.concatenate([v[:count] for _, v, _, count in used]),
            amplitudes,
            node_planes(amplitudes),
            order=[space.order for space in spaces],
            multiplicity=[space.multiplicity for space in spaces],
            mass=mass,
            problem=numbers,
            column=[column for count in counts for column in range(count)],
        )
        return tuple(sorted(found, key=lambda mode: mode.frequency_hz))

    def extended(self, snapshots: Sequence[Materials], joints: Sequence[sp.csr_array] = ()) -> RingBasis:
        """With the modes at further materials, each with every one of some joints of the half pitch (N/m)."""
        profile = radial_profile(self.model.mesh)
        bonded = [(self.model.stiffness_matrix(m), self.model.mass_matrix(m)) for m in snapshots]
        matrices = [(sp.csr_array(K + joint), M) for K, M in bonded for joint in joints] or bonded
        terms = affine_terms(self.model)
        top = REACH * self.highest_hz
        solved = _solved(self.model, [p.space for p in self.problems], matrices, top)
        energy = _energy(matrices, top)
        problems = []
        with one_blas_thread():
            for problem, vectors in zip(self.problems, solved, strict=True):
                added = independent(problem.basis, vectors, sp.csr_array(problem.space.project(energy)))
                problems.append(grown(problem, added, terms, profile))
        return replace(self, problems=tuple(problems))


def material_slope(
    q: np.ndarray,
    value: float,
    parts: tuple[np.ndarray, np.ndarray],
    regions: Sequence[str],
    materials: Materials,
) -> np.ndarray:
    """d ln f of a mode by the Hooke entries and the density of all regions, one after the other.

    Parameters
    ----------
    q : (k,) coordinates of unit mass.
    value : λ.
    parts : (9 regions, k²) K per unit Hooke entry and (regions, k²) M per unit density, as rows.
    regions : of the parts.
    materials : whose order counts.
    """
    both, (stiffness, mass) = np.outer(q, q).ravel(), parts
    slopes = np.empty((len(mass), 10))
    slopes[:, :9] = (0.5 / value * (stiffness @ both)).reshape(-1, 9)
    slopes[:, 9] = -0.5 * (mass @ both)
    places = {region: i for i, region in enumerate(regions)}
    return slopes[[places[region] for region in materials]].ravel()


def mark_of(materials: Materials) -> bytes:
    """Equal for equal materials."""
    return b"".join(m.hooke.matrix.tobytes() + np.float64(m.density).tobytes() for m in materials.values())


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


def _solved(
    model: AffineModel,
    spaces: Sequence[Harmonic],
    matrices: Sequence[tuple[sp.csr_array, sp.csr_array]],
    highest_hz: float,
) -> list[np.ndarray]:
    """Modes (m, j) of all snapshots, per problem."""
    parts = pitch_parts(model.mesh)
    found = side_by_side(
        lambda pair: modes_of(half_pitches(parts, *pair), spaces, highest_hz, MOST, workers()), matrices
    )
    return [np.hstack([pairs[number][1] for pairs in found]) for number in range(len(spaces))]


def _energy(matrices: Sequence[tuple[sp.csr_array, sp.csr_array]], highest_hz: float) -> sp.csr_array:
    """Energy K / λ + M of the half pitch that the snapshots have in the mean, λ the band's end.

    It is the energy that tells what a basis lacks: where a material hardly changes its volume, a small difference in
    shape is a large one in stiffness.
    """
    top = (2 * np.pi * highest_hz) ** 2
    whole = sum((K / top + M for K, M in matrices[1:]), start=matrices[0][0] / top + matrices[0][1])
    return sp.csr_array(whole / len(matrices))


def independent(basis: np.ndarray, added: np.ndarray, norm: sp.csr_array) -> np.ndarray:
    """Directions (m, k) of `added` that the basis lacks, orthonormal in the definite matrix `norm`."""
    if added.shape[1] == 0:
        return added
    added = added / np.sqrt(np.sum(added * (norm @ added), axis=0))
    for _ in range(2 if basis.shape[1] else 0):  # the second time for rounding
        heavy = norm @ basis
        added = added - basis @ np.linalg.solve(basis.T @ heavy, heavy.T @ added)
    values, rotation = np.linalg.eigh(added.T @ (norm @ added))
    keep = values > DEPENDENT
    return np.asarray(added @ (rotation[:, keep] / np.sqrt(values[keep])))


@dataclass(frozen=True)
class AffineTerms:
    """K per unit Hooke entry and M per unit density of every region of the half pitch."""

    stiffness: Mapping[str, tuple[sp.csr_array, ...]]
    mass: Mapping[str, sp.csr_array]


@lru_cache(maxsize=8)
def affine_terms(model: AffineModel) -> AffineTerms:
    """The matrices behind a model's affine form."""

    def compact(matrix: sp.csr_array) -> sp.csr_array:
        # the pattern is that of all regions
        matrix.eliminate_zeros()
        return matrix

    return AffineTerms(
        {r: tuple(compact(model.stiffness_term(r, q)) for q in range(9)) for r in model.stiffness},
        {r: compact(model.mass_term(r)) for r in model.mass},
    )


def grown(problem: RingProblem, added: np.ndarray, terms: AffineTerms, profile: RadialProfile) -> RingProblem:
    """The problem with further vectors in its basis; only their products are new."""
    space, old, count = problem.space, problem.basis, added.shape[1]
    if count == 0 and problem.stiffness:
        return problem
    shapes = np.hstack([space.real @ added, space.imaginary @ added])
    before = np.hstack([space.real @ old, space.imaginary @ old])
    size = old.shape[1]

    def products(left: np.ndarray, right: np.ndarray) -> np.ndarray:
        k = left.shape[1] // 2
        return np.asarray(left[:, :k].T @ right[:, :count] + left[:, k:].T @ right[:, count:])

    def larger(known: np.ndarray | None, term: sp.csr_array) -> np.ndarray:
        image = space.copies * (term @ shapes)
        mixed, own = products(before, image), products(shapes, image)
        inner = np.zeros((size, size)) if known is None else known
        return np.block([[inner, mixed], [mixed.T, own]])

    stiffness = {
        r: np.stack(
            [
                larger(known[q] if (known := problem.stiffness.get(r)) is not None else None, t)
                for q, t in enumerate(parts)
            ]
        )
        for r, parts in terms.stiffness.items()
    }
    mass = {r: larger(problem.mass.get(r), t) for r, t in terms.mass.items()}
    amplitudes = profile.orders(space, space.expand(added))
    if problem.stiffness:
        amplitudes = np.hstack([problem.profile, amplitudes])
    return RingProblem(space, np.hstack([old, added]), stiffness, mass, amplitudes)
