"""All modes of the free stator or coupon in a band, problem by problem, on the full model."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from statorhom.mesh.hex_mesh import PartMesh
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.problems import eigenpairs_of, orders_of, profile_of
from statorhom.model.radial_profile import node_planes
from statorhom.model.space import MIRROR, Profile, Space
from statorhom.model.stator_mode import StatorMode, modes_of_parities, name_modes


@dataclass(frozen=True)
class FreeModes:
    """Modes of the free stator, sorted by frequency.

    Parameters
    ----------
    modes : the modes, rigid bodies left out.
    harmonics : the problems that `StatorMode.problem` counts.
    shapes : per problem (3 n, k) complex half-pitch displacements û of unit modal mass.
    profiles : per problem (p, k) radial order amplitudes in the profile's planes.
    """

    modes: tuple[StatorMode, ...]
    harmonics: tuple[Space, ...]
    shapes: tuple[np.ndarray, ...]
    profiles: tuple[np.ndarray, ...]

    def shape(self, mode: StatorMode) -> np.ndarray:
        """Complex half-pitch displacement of a mode, (3 n,)."""
        return np.asarray(self.shapes[mode.problem][:, mode.column])


def solve_free(
    model: AffineModel[PartMesh],
    materials: Materials,
    highest_hz: float,
    orders: Iterable[int] | None = None,
    most: int | None = None,
    jobs: int = 1,
) -> FreeModes:
    """Solve the full model.

    Parameters
    ----------
    model : of the half pitch.
    materials : of every region of the model.
    highest_hz : upper end of the band.
    orders : harmonics to solve (default: all, 0 … N/2).
    most : lowest modes of each harmonic problem that are enough; None for all of the band.
    jobs : threads; the modes do not depend on their number.
    """
    return problem_at(model, materials).solve(highest_hz, orders, most, jobs)


@dataclass(frozen=True)
class FreeProblem:
    """The half pitch at given materials; a tenth of the affine model's size, for workers in other processes.

    Parameters
    ----------
    mesh : of the half pitch.
    K, M : of the half pitch.
    mass : of the whole stator (kg).
    """

    mesh: PartMesh
    K: sp.csr_array
    M: sp.csr_array
    mass: float

    def solve(
        self,
        highest_hz: float,
        orders: Iterable[int] | None = None,
        most: int | None = None,
        jobs: int = 1,
    ) -> FreeModes:
        """Modes of the band; see `solve_free`."""
        profile = profile_of(self.mesh)
        wanted = orders_of(self.mesh) if orders is None else orders
        pairs = eigenpairs_of(self.mesh, self.K, self.M, highest_hz, wanted, most, jobs)
        found = [_solved(space, profile, values, vectors) for space, values, vectors in pairs]
        modes = [mode for i, part in enumerate(found) for mode in self._named(part, i)]
        modes.sort(key=lambda mode: mode.frequency_hz)
        return FreeModes(
            tuple(modes),
            tuple(part.harmonic for part in found),
            tuple(part.shape for part in found),
            tuple(part.amplitudes for part in found),
        )

    def _named(self, part: _Solved, number: int) -> list[StatorMode]:
        count = len(part.values)
        if part.harmonic.parity == MIRROR:
            return modes_of_parities(
                part.values,
                part.amplitudes,
                parities=[part.harmonic.order] * count,
                mass=self.mass,
                problem=[number] * count,
                column=range(count),
            )
        return name_modes(
            part.values,
            part.amplitudes,
            node_planes(part.amplitudes),
            order=[part.harmonic.order] * count,
            multiplicity=[part.harmonic.multiplicity] * count,
            mass=self.mass,
            problem=[number] * count,
            column=range(count),
        )


@dataclass(frozen=True)
class _Solved:
    """One harmonic problem: λ (k,), shapes (3 n, k) of unit modal mass, their amplitudes (planes, k)."""

    harmonic: Space
    values: np.ndarray
    shape: np.ndarray
    amplitudes: np.ndarray


def _solved(harmonic: Space, profile: Profile, values: np.ndarray, vectors: np.ndarray) -> _Solved:
    shape = harmonic.expand(vectors) / np.sqrt(harmonic.copies)
    return _Solved(harmonic, values, shape, profile.orders(harmonic, shape))


def problem_at(model: AffineModel[PartMesh], materials: Materials) -> FreeProblem:
    """The problem of a model at given materials."""
    K, M = model.stiffness_matrix(materials), model.mass_matrix(materials)
    return FreeProblem(model.mesh, K, M, total_mass(model, materials))


def total_mass(model: AffineModel[PartMesh], materials: Materials) -> float:
    """Mass of the whole stator's mesh (kg)."""
    return sum(materials[region].density * volume for region, volume in model.volumes.items())


def strain_energy_shares(
    model: AffineModel[PartMesh], materials: Materials, shape: np.ndarray
) -> dict[str, float]:
    """Share of each region in the strain energy of a half-pitch shape (3 n,) complex."""
    energy = {}
    for region in model.stiffness:
        K = model.region_stiffness(region, materials[region])
        energy[region] = float(np.real(np.vdot(shape, K @ shape)))
    total = sum(energy.values())
    return {region: value / total for region, value in energy.items()}
