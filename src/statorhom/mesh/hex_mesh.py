"""20-node hexahedra of half a slot pitch, and the whole stator copied from it."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import ClassVar, Literal, Self

import numpy as np

# Local numbering: corners 0-3 at the bottom, 4-7 above them, then the mid-sides of the four bottom edges
# (01, 12, 23, 30), of the four upright edges (04, 15, 26, 37) and of the four top edges. Mirroring an
# element turns its bottom round the other way.
MIRRORED = np.array([0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 12, 15, 14, 13, 19, 18, 17, 16])


def _freeze(mesh: HexMesh) -> None:
    for field in fields(mesh):
        value = getattr(mesh, field.name)
        if isinstance(value, np.ndarray):
            value.setflags(write=False)


@dataclass(frozen=True, eq=False)
class HexMesh:
    """A mesh of 20-node hexahedra.

    Parameters
    ----------
    nodes : (n, 3) Cartesian positions (m).
    elements : (m, 20) node numbers; the local numbering is described in this module.
    region : (m,) index into `regions` for every element.
    regions : region names.
    """

    nodes: np.ndarray
    elements: np.ndarray
    region: np.ndarray
    regions: tuple[str, ...]

    def __post_init__(self) -> None:
        _freeze(self)

    def elements_of(self, region: str) -> np.ndarray:
        """(k, 20) elements of one region."""
        return self.elements[self.region == self.regions.index(region)]

    def with_region(self, name: str, elements: np.ndarray) -> Self:
        """The same mesh with elements, given by number or by a mask, moved to a (new) region."""
        regions = self.regions if name in self.regions else (*self.regions, name)
        region = self.region.copy()
        region[elements] = regions.index(name)
        return replace(self, region=region, regions=regions)


@dataclass(frozen=True, eq=False)
class PointMasses:
    """Masses that belong to points of elements.

    Parameters
    ----------
    elements : (k,) their numbers.
    places : (k, 3) local coordinates in them, 0 … 1.
    masses : (k,) kg.
    """

    elements: np.ndarray
    places: np.ndarray
    masses: np.ndarray


@dataclass(frozen=True, eq=False)
class PartMesh(HexMesh):
    """Mesh of the part that a symmetric body is copied from.

    `axes` are those of its materials; its stiffness is integrated at Gauss points exact for the order `quadrature`.
    """

    axes: ClassVar[Literal["cylindrical", "cartesian"]]
    quadrature: ClassVar[int] = 5

    def cell_axes(self, numbers: np.ndarray) -> np.ndarray | None:  # noqa: ARG002
        """Materials' axes (k, 3, 3) of some elements as columns, in components of `axes`; None where they are these."""
        return None

    def point_masses(self) -> PointMasses | None:
        """Masses without volume or stiffness; their region is called `LUMPS`."""
        return None

    @property
    def copies(self) -> int:
        """How many copies make the body."""
        raise NotImplementedError

    @property
    def full_dof(self) -> int:
        """Degrees of freedom of the whole body's mesh."""
        raise NotImplementedError


@dataclass(frozen=True, eq=False)
class HalfPitchMesh(PartMesh):
    """Mesh of half a slot pitch, from the centre of a tooth to the centre of the next slot.

    Parameters
    ----------
    slots : number of slots N; 2 N copies, mirrored in turn, make the stator.
    length, outer_radius : of the core (m).
    tooth_plane, slot_plane : node numbers on θ = 0 and on θ = π/N.
    """

    slots: int
    length: float
    outer_radius: float
    tooth_plane: np.ndarray
    slot_plane: np.ndarray

    axes = "cylindrical"

    @property
    def copies(self) -> int:
        """Half pitches of the stator."""
        return 2 * self.slots

    @property
    def full_dof(self) -> int:
        """Degrees of freedom of the whole stator's mesh."""
        inner = len(self.nodes) - len(self.tooth_plane) - len(self.slot_plane)
        return 3 * self.slots * (2 * inner + len(self.tooth_plane) + len(self.slot_plane))

    def full(self) -> tuple[HexMesh, np.ndarray, np.ndarray]:
        """The whole stator.

        Returns
        -------
        mesh : HexMesh
        source : (n,) node of the half pitch from which each node was copied.
        copy : (n,) number of the half pitch it belongs to: 2 k the one from the centre of tooth k to the next
            slot, 2 k + 1 its mirror image.
        """
        mapping, source, copy = self._numbering()
        nodes = self._positions(source, copy)
        elements = np.concatenate(
            [
                mapping[c][self.elements if c % 2 == 0 else self.elements[:, MIRRORED]]
                for c in range(2 * self.slots)
            ]
        )
        region = np.tile(self.region, 2 * self.slots)
        return HexMesh(nodes, elements, region, self.regions), source, copy

    def _numbering(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        n, copies = len(self.nodes), 2 * self.slots
        owner = np.tile(np.arange(copies)[:, None], (1, n))
        # a mirrored half shares the tooth's plane with its own pitch and the slot's plane with the one before
        owner[1::2, self.tooth_plane] -= 1
        owner[1::2, self.slot_plane] = (owner[1::2, self.slot_plane] - 3) % copies
        flat = owner * n + np.arange(n)
        unique, mapping = np.unique(flat, return_inverse=True)
        return mapping.reshape(copies, n), unique % n, unique // n

    def _positions(self, source: np.ndarray, copy: np.ndarray) -> np.ndarray:
        x, y, z = self.nodes[source].T
        y = np.where(copy % 2 == 0, y, -y)
        turn = 2 * np.pi / self.slots * (copy // 2)
        return np.column_stack([x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn), z])
