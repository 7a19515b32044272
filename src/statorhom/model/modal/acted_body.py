"""Modes of a body in its modal basis with what an explanation adds to it: lumps, springs, patches, other dimensions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
import numpy.typing as npt

from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.modal.element_energy import ElementEnergy, element_energy
from statorhom.model.modal.modal_body import ModalBody, lowest_pairs
from statorhom.model.modal.point_residual import PointResiduals, point_residuals

FloatArray = npt.NDArray[np.float64]


class Attached(Protocol):
    """A lump or springs at a place (m, kg, N/m)."""

    @property
    def place(self) -> tuple[float, float, float]: ...
    @property
    def mass_kg(self) -> float: ...
    @property
    def stiffness(self) -> tuple[float, float, float]: ...


class Softened(Protocol):
    """A patch with another stiffness that fades out as exp(-r²/2)."""

    @property
    def centre(self) -> tuple[float, float]: ...
    @property
    def radius(self) -> float: ...
    @property
    def ratio(self) -> float: ...


@dataclass(frozen=True)
class BodyModes:
    """Lowest modes, rigid bodies included.

    Parameters
    ----------
    values : (m,) eigenvalues.
    vectors : (k, m) in the basis; local shapes of attachments left out.
    """

    values: FloatArray
    vectors: FloatArray


@dataclass(frozen=True, eq=False)
class ActedBody:
    """A body near reference materials.

    Parameters
    ----------
    model, reference : the body and the materials at which local shapes are computed.
    basis : its modal basis.
    like : a body of so similar materials that its local shapes are this one's but for their size; None to compute them.
    """

    model: AffineModel[MirrorMesh]
    reference: Materials
    basis: ModalBody
    like: ActedBody | None = None

    @cached_property
    def residuals(self) -> PointResiduals:
        """Local shapes of points."""
        b = self.basis
        if self.like is not None:
            return self.like.residuals.softened(b.yields_beside(self.like.basis))
        return point_residuals(self.model, self.reference, b.shapes, b.parities, b.highest_hz)

    @cached_property
    def energy(self) -> ElementEnergy:
        """Strain energies of the elements."""
        return element_energy(self.model, self.reference, self.basis.shapes, self.basis.parities)

    def modes(
        self,
        materials: Materials,
        count: int,
        attached: Sequence[Attached] = (),
        patches: Sequence[Softened] = (),
        scale: tuple[float, float, float] = (1.0, 1.0, 1.0),
    ) -> BodyModes:
        """The lowest modes.

        Parameters
        ----------
        materials : of every region.
        count : of modes, rigid bodies included.
        attached, patches : what is added.
        scale : see `ModalBody.matrices`.

        Raises
        ------
        SolverError
            If the mass or the stiffness is not positive.
        """
        K, M = self.basis.matrices(materials, scale)
        for patch in patches:
            K = K + (patch.ratio - 1.0) * self._faded(patch)
        parities = self.basis.parities
        if attached:
            K, M = self._with_attached(K, M, attached, scale)
        values, vectors = lowest_pairs(K, M, parities, count)
        return BodyModes(values, vectors[: self.basis.size])

    def _faded(self, patch: Softened) -> FloatArray:
        def weight(centres: FloatArray) -> FloatArray:
            away = (centres[:, :2] - patch.centre) / patch.radius
            return np.asarray(np.exp(-0.5 * np.sum(away**2, axis=1)))

        return self.energy.weighted(weight)

    def _with_attached(
        self, K: FloatArray, M: FloatArray, attached: Sequence[Attached], scale: tuple[float, float, float]
    ) -> tuple[FloatArray, FloatArray]:
        """K and M with three local shapes for every attachment."""
        # places and motions of the longer body, on its mesh
        size = np.array(scale)
        places = np.array([a.place for a in attached]) / size
        moved, (yields, inertia) = self.basis.motion(places), self.residuals.at(places)
        k, extra = self.basis.size, 3 * len(attached)
        wide, heavy = np.zeros((k + extra, k + extra)), np.zeros((k + extra, k + extra))
        wide[:k, :k], heavy[:k, :k] = K, M
        local = range(k, k + extra)
        wide[local, local], heavy[local, local] = yields.ravel(), inertia.ravel()
        for i, one in enumerate(attached):
            f = np.zeros((3, k + extra))
            f[:, :k] = moved[i]
            f[range(3), range(k + 3 * i, k + 3 * i + 3)] = yields[i]
            f /= size[:, None]
            heavy += one.mass_kg * f.T @ f
            if any(one.stiffness):
                wide += f.T @ (np.array(one.stiffness)[:, None] * f)
        return wide, heavy
