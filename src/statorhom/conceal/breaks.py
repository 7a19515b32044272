"""What breaks a true stator's symmetry, before there is a mesh."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import Material, Materials, hooke_coefficients
from statorhom.model.broken.attachments import footed_lump, point_springs
from statorhom.model.broken.cells import Sectors, cells
from statorhom.model.broken.change import Attachment, Change, PieceChange
from statorhom.model.broken.interface import Contact
from statorhom.model.broken.layers import radial_layers
from statorhom.model.broken.pieces import Pieces, elements_in
from statorhom.model.broken.variations import gradient, strip, wave
from statorhom.model.surface import surface_points

STRIP_LAYERS = 6  # an element: more than a diagnosis takes, on a finer mesh


class Ground(Protocol):
    """The symmetric stator that something breaks."""

    @property
    def mesh(self) -> HalfPitchMesh:
        """Of the half pitch."""
        ...

    @property
    def materials(self) -> Materials:
        """Of all regions."""
        ...

    @property
    def contact(self) -> Contact | None:
        """Joint that is not rigid."""
        ...

    def pieces(self, region: str) -> Pieces:
        """Stiffness of a region's elements."""
        ...

    def masses(self, region: str) -> Pieces:
        """Mass of a region's elements."""
        ...


class Break(Protocol):
    """Something that breaks the symmetry."""

    def changes(self, ground: Ground) -> tuple[Change, ...]:
        """On a mesh."""
        ...


@dataclass(frozen=True)
class Wave:
    """Stiffness of the lamination outside a radius times 1 + ε cos n(θ − α)."""

    harmonic: int
    amplitude: float
    angle: float
    inner: float = 0.0

    def changes(self, ground: Ground) -> tuple[Change, ...]:
        """On a mesh."""
        pieces = ground.pieces("lamination")
        return (
            wave(
                ground.mesh,
                pieces,
                self.angle,
                harmonic=self.harmonic,
                amplitude=self.amplitude,
                inner=self.inner,
            ),
        )


@dataclass(frozen=True)
class Lump:
    """A rigid cube on the back of the core."""

    angle: float
    z: float
    mass_kg: float
    foot: float
    height: float

    def changes(self, ground: Ground) -> tuple[Change, ...]:
        """On a mesh."""
        return (
            footed_lump(ground.mesh, self.angle, self.z, self.mass_kg, foot=self.foot, height=self.height),
        )


@dataclass(frozen=True)
class Strip:
    """An axial strip of the back of the core of another modulus."""

    angle: float
    width: float
    depth: float
    ratio: float

    def changes(self, ground: Ground) -> tuple[Change, ...]:
        """On a mesh."""
        return (self._of(ground, hooke_coefficients(ground.materials["lamination"].hooke))[0],)

    def along(self, slope: AxialSlope, ground: Ground) -> tuple[Change, ...]:
        """What it takes of the lamination's change along the core: its modulus is a part of that beside it.

        Without this the soft end of a soft strip would have no stiffness left, or less than none.
        """
        found = []
        for surplus, share in slope.parts(ground):
            one, heights = self._of(ground, surplus, by_height=True)
            found.append(replace(one, weights=one.weights * share(heights)[:, None]))
        return tuple(found)

    def _of(
        self, ground: Ground, entries: np.ndarray, *, by_height: bool = False
    ) -> tuple[PieceChange, np.ndarray]:
        """Of a material or of a change of it, and the heights of its pieces."""
        inner = ground.mesh.outer_radius - self.depth
        core = radial_layers(ground.mesh, "lamination", entries, STRIP_LAYERS, inner, by_height=by_height)
        found = strip(core, self.angle, width=self.width, depth=self.depth, ratio=self.ratio)
        return found, core.place.z.mean(axis=1)


@dataclass(frozen=True)
class Cords:
    """Springs to the ground at points of the surface; stiffness (radial, tangential, axial) of each (N/m)."""

    angles: tuple[float, ...]
    z: tuple[float, ...]
    stiffness: tuple[float, float, float]

    def changes(self, ground: Ground) -> tuple[Change, ...]:
        """On a mesh."""
        return (
            point_springs(ground.mesh, np.array(self.angles), np.array(self.z), np.array(self.stiffness)),
        )


@dataclass(frozen=True)
class AxialSlope:
    """The lamination's material changes along the core.

    Parameters
    ----------
    materials : at equal distances from z = 0 to the other end, an odd number of them; Hooke's matrices are linear in
        between, and in the middle the material is the stage's own.
    """

    materials: tuple[Material, ...]

    def changes(self, ground: Ground) -> tuple[Change, ...]:
        """On a mesh."""
        return tuple(
            gradient(radial_layers(ground.mesh, "lamination", surplus, 1, by_height=True), share)
            for surplus, share in self.parts(ground)
        )

    def parts(self, ground: Ground) -> Iterator[tuple[np.ndarray, Callable[[np.ndarray], np.ndarray]]]:
        """What materials beside the middle's add to its Hooke entries, and how much of each there is at a height."""
        own = hooke_coefficients(ground.materials["lamination"].hooke)
        count = len(self.materials)
        heights = np.linspace(0.0, ground.mesh.length, count)
        for k, material in enumerate(self.materials):
            if k != count // 2:
                yield hooke_coefficients(material.hooke) - own, _share(heights, k)


def _share(heights: np.ndarray, number: int) -> Callable[[np.ndarray], np.ndarray]:
    """Height → share of the material at one of some heights."""
    own = np.eye(len(heights))[number]
    return lambda z: np.interp(z, heights, own)


@dataclass(frozen=True)
class LostContact:
    """A joint whose stiffness keeps a ratio between two angles (rad)."""

    start: float
    end: float
    ratio: float

    def changes(self, ground: Ground) -> tuple[Change, ...]:
        """On a mesh."""
        joint = ground.contact
        assert joint is not None, "the effect gives its stage a contact"
        # all faces of a half pitch are lost alike: one projection serves them all
        half = Sectors(np.array([[0.0, np.pi / ground.mesh.slots]]), ground.mesh.slots)
        weights = (self.ratio - 1.0) * half.share_of_arc(self.start, self.end)
        return (PieceChange(joint.pieces, None, np.repeat(weights, len(joint.pieces), axis=0)),)


@dataclass(frozen=True, eq=False)
class Patchwork:
    """Stiffness and mass of the lamination differ from pitch to pitch, as where its thickness does.

    Parameters
    ----------
    factors : (N,) relative surplus of every slot pitch.
    """

    factors: np.ndarray

    def changes(self, ground: Ground) -> tuple[Change, ...]:
        """On a mesh."""
        pieces, masses = ground.pieces("lamination"), ground.masses("lamination")
        copies = np.repeat(np.resize(self.factors, ground.mesh.slots), 2)
        weights = np.tile(copies, (len(pieces), 1))
        return (PieceChange(pieces, masses, weights),)


@dataclass(frozen=True)
class Helix:
    """Stiffness of the lamination times 1 + ε cos(n(θ − α) − κ z/L), as of skewed welds."""

    harmonic: int
    amplitude: float
    angle: float
    twist: float

    def changes(self, ground: Ground) -> tuple[Change, ...]:
        """On a mesh."""
        place = cells(ground.mesh, elements_in(ground.mesh, ("lamination",)))
        middle = place.angles.mean(axis=-1)
        phase = self.twist * place.z.mean(axis=1)[:, None] / ground.mesh.length
        weights = self.amplitude * np.cos(self.harmonic * (middle - self.angle) - phase)
        return (PieceChange(ground.pieces("lamination"), None, weights),)


@dataclass(frozen=True)
class Tether:
    """A rod from the surface to the ground that is stiff along one slanted direction only.

    Parameters
    ----------
    direction : (radial, tangential, axial).
    stiffness : along it (N/m).
    """

    angle: float
    z: float
    direction: tuple[float, float, float]
    stiffness: float

    def changes(self, ground: Ground) -> tuple[Change, ...]:
        """On a mesh."""
        points = surface_points(ground.mesh, np.array([self.angle]), np.array([self.z]))
        row = np.array([self.direction]) / np.linalg.norm(self.direction)
        return (Attachment(points, row, np.array([[self.stiffness]]), np.zeros((1, 1))),)


def all_changes(breaks: Sequence[Break], ground: Ground) -> list[Change]:
    """Of everything that breaks a stator's symmetry; a strip is a part of a modulus that varies along the core."""
    found = [change for one in breaks for change in one.changes(ground)]
    slopes = [one for one in breaks if isinstance(one, AxialSlope)]
    for one in breaks:
        if isinstance(one, Strip):
            found += [change for slope in slopes for change in one.along(slope, ground)]
    return joined(found)


def joined(changes: Sequence[Change]) -> list[Change]:
    """The same changes, those of the same pieces as one: each costs a projection onto the whole basis."""
    found: list[Change] = []
    for change in changes:
        twin = next((i for i, other in enumerate(found) if _same_pieces(other, change)), None)
        if twin is None:
            found.append(change)
        else:
            other = found[twin]
            assert isinstance(other, PieceChange) and isinstance(change, PieceChange)
            found[twin] = PieceChange(other.stiffness, None, other.weights + change.weights)
    return found


def _same_pieces(one: Change, other: Change) -> bool:
    both = isinstance(one, PieceChange) and isinstance(other, PieceChange)
    return bool(both and one.stiffness is other.stiffness and one.mass is None and other.mass is None)
