"""Shapes of the supported stator's modes: on the outer surface, in the whole stator, and their energies."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import scipy.sparse as sp

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.harmonic import Harmonic
from statorhom.model.surface import SurfacePoints

_MIRROR = np.array([1.0, -1.0, 1.0])


@dataclass(frozen=True)
class ShapePart:
    """What one harmonic problem contributes to the modes.

    Its displacement is Re(û e^{i k h α}) of the cosine family and Im(û e^{i k h α}) of the sine family.

    Parameters
    ----------
    harmonic : the problem.
    basis : (m, b) coordinates in the problem.
    cosine, sine : (b, modes) coordinates of the modes in the basis; None where there is no such family.
    """

    harmonic: Harmonic
    basis: np.ndarray
    cosine: np.ndarray | None
    sine: np.ndarray | None

    @property
    def families(self) -> tuple[tuple[bool, np.ndarray], ...]:
        """Whether it is the sine family, and its coordinates."""
        both = ((False, self.cosine), (True, self.sine))
        return tuple((sine, part) for sine, part in both if part is not None)


class SurfaceModes(Protocol):
    """Modes whose motion on the outer surface is known."""

    @property
    def frequencies_hz(self) -> np.ndarray: ...

    def __len__(self) -> int: ...

    def motion(self, points: SurfacePoints) -> np.ndarray: ...


@dataclass(frozen=True)
class SupportedModes:
    """Modes of the supported stator, of unit modal mass, by ascending frequency.

    A symmetric support leaves doublets: two modes of equal frequencies.

    Parameters
    ----------
    frequencies_hz : (modes,).
    errors : (modes,) estimated relative errors of the frequencies against the mesh's own; they are too high.
    parts : of the shapes.
    """

    frequencies_hz: np.ndarray
    errors: np.ndarray
    parts: tuple[ShapePart, ...]

    def __post_init__(self) -> None:
        for array in (self.frequencies_hz, self.errors):
            array.setflags(write=False)

    def __len__(self) -> int:
        return len(self.frequencies_hz)

    def motion(self, points: SurfacePoints) -> np.ndarray:
        """Motion (u_r, u_θ, u_z) of all modes at points of the outer surface, (p, 3, modes) in 1/√kg."""
        total = np.zeros((len(points), 3, len(self)))
        for part in self.parts:
            local = points.evaluate(part.harmonic, part.harmonic.expand(part.basis))
            for sine, coordinates in part.families:
                total += (local.imag if sine else local.real) @ coordinates
        return total

    def full_shape(self, mesh: HalfPitchMesh, mode: int) -> np.ndarray:
        """Cylindrical components (n, 3) of a mode at the nodes of the whole stator, `mesh.full()`."""
        _, source, copy = mesh.full()
        mirrored = (copy % 2 == 1)[:, None]
        total = np.zeros((len(source), 3))
        for part in self.parts:
            phase = np.exp(2j * np.pi * part.harmonic.order / mesh.slots * (copy // 2))[:, None]
            for sine, coordinates in part.families:
                shape = part.harmonic.expand(part.basis @ coordinates[:, mode]).reshape(-1, 3)[source]
                shape = np.where(mirrored, np.conj(shape) * _MIRROR, shape) * phase
                total += shape.imag if sine else shape.real
        return total

    def strain_energy_shares(self, model: AffineModel, materials: Materials) -> Mapping[str, np.ndarray]:
        """Share of each region in the strain energy of the structure, springs left out, (modes,) each."""
        return self._shares({r: model.region_stiffness(r, materials[r]) for r in model.stiffness})

    def kinetic_energy_shares(self, model: AffineModel, materials: Materials) -> Mapping[str, np.ndarray]:
        """Share of each region in the kinetic energy, (modes,) each."""
        return self._shares({r: materials[r].density * model.mass_term(r) for r in model.mass})

    def _shares(self, matrices: Mapping[str, sp.csr_array]) -> Mapping[str, np.ndarray]:
        energies = {region: self._energy(matrix) for region, matrix in matrices.items()}
        total = sum(energies.values())
        return {region: energy / total for region, energy in energies.items()}

    def _energy(self, matrix: sp.csr_array) -> np.ndarray:
        total = np.zeros(len(self))
        for part in self.parts:
            gram = part.basis.T @ (part.harmonic.project(matrix) @ part.basis)
            for _, coordinates in part.families:
                total += part.harmonic.copies * np.sum(coordinates * (gram @ coordinates), axis=0)
        return total
