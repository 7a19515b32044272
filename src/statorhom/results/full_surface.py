"""The visible surface of the whole stator or block, copied from its part, and mode shapes on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.mesh.hex_mesh import MIRRORED, HalfPitchMesh
from statorhom.mesh.mirror_mesh import MirrorMesh

# the six faces of a hexahedron: corners counterclockwise seen from outside, then the nodes between them
_FACES = np.array(
    [
        [0, 3, 2, 1, 11, 10, 9, 8],
        [4, 5, 6, 7, 16, 17, 18, 19],
        [0, 1, 5, 4, 8, 13, 16, 12],
        [1, 2, 6, 5, 9, 14, 17, 13],
        [2, 3, 7, 6, 10, 15, 18, 14],
        [3, 0, 4, 7, 11, 12, 19, 15],
    ]
)
# the same face seen from the other side: what a mirrored element needs to keep its normal outwards
_TURNED = np.array([0, 3, 2, 1, 7, 6, 5, 4])
_MIRROR = np.array([1.0, -1.0, 1.0])
# a doublet's real and imaginary part are equally large; of a singlet one of them is nothing
_IMAGINARY_SINGLET = 2.0


@dataclass(frozen=True)
class FullSurface:
    """Outer faces of the whole stator's elements.

    Parameters
    ----------
    nodes : (f, 3) Cartesian positions (m), in the order of the whole mesh's numbering (`HalfPitchMesh.full`).
    quads : (q, 8) node numbers: four corners counterclockwise seen from outside, then the mid-side nodes.
    region : (q,) index into the mesh's regions.
    full_node : (f,) number of each node in the whole mesh.
    source : (f,) node of the half pitch it was copied from.
    copy : (f,) half pitch it belongs to: 2 k, or 2 k + 1 for the mirror image, in pitch k. Of a block: bit i is set
        where it was mirrored at plane i.
    """

    nodes: np.ndarray
    quads: np.ndarray
    region: np.ndarray
    full_node: np.ndarray
    source: np.ndarray
    copy: np.ndarray

    def __post_init__(self) -> None:
        for array in (self.nodes, self.quads, self.region, self.full_node, self.source, self.copy):
            array.setflags(write=False)


def full_surface(mesh: HalfPitchMesh | MirrorMesh) -> FullSurface:
    """The whole body's outer faces, without those between its copied parts."""
    if isinstance(mesh, MirrorMesh):
        return _mirrored_surface(mesh)
    full, source, copy = mesh.full()
    element, local = _outer_faces(mesh)
    numbers = np.arange(2 * mesh.slots)[:, None] * len(mesh.elements) + element
    upright = full.elements[numbers[0::2, :, None], local]
    mirrored = full.elements[numbers[1::2, :, None], MIRRORED[local]][..., _TURNED]
    quads = np.concatenate([upright, mirrored]).reshape(-1, 8)
    used, compact = np.unique(quads, return_inverse=True)
    region = np.tile(mesh.region[element], 2 * mesh.slots)
    return FullSurface(full.nodes[used], compact.reshape(quads.shape), region, used, source[used], copy[used])


def _mirrored_surface(mesh: MirrorMesh) -> FullSurface:
    full, source, mirrored = mesh.full()
    element, local = _boundary(full.elements)
    quads = full.elements[element[:, None], local]
    used, compact = np.unique(quads, return_inverse=True)
    copy = mirrored[used] @ 2 ** np.arange(mirrored.shape[1])
    region = full.region[element]
    return FullSurface(full.nodes[used], compact.reshape(quads.shape), region, used, source[used], copy)


def expand_mirrored(
    surface: FullSurface, mesh: MirrorMesh, parities: int, displacement: np.ndarray
) -> np.ndarray:
    """Displacement (f, 3) on the whole surface of a shape (n, 3) of the part with given parities."""
    moved = displacement[surface.source].real
    for i, sign in enumerate(mesh.signs(parities)):
        moved = np.where((surface.copy >> i & 1)[:, None] == 1, moved * sign, moved)
    return np.asarray(moved)


def expand_cyclic(surface: FullSurface, slots: int, harmonic: int, displacement: np.ndarray) -> np.ndarray:
    """Real displacement on the whole surface of a shape of one circumferential harmonic.

    Parameters
    ----------
    surface : FullSurface
    slots : number of slots N.
    harmonic : h; pitch k moves as û e^{2πi k h / N}, its mirrored half as S conj û, S = diag(1, -1, 1).
    displacement : (n, 3) complex cylindrical components û (u_r, u_θ, u_z) of the half pitch.

    Returns
    -------
    ndarray, shape (f, 3)
        Cylindrical components of the real part (the imaginary one of a singlet that has no other).
    """
    local = displacement[surface.source]
    odd = (surface.copy % 2 == 1)[:, None]
    local = np.where(odd, np.conj(local) * _MIRROR, local)
    moved = local * np.exp(2j * np.pi * harmonic / slots * (surface.copy // 2))[:, None]
    singlet = np.sum(moved.imag**2) > _IMAGINARY_SINGLET * np.sum(moved.real**2)
    return np.asarray(moved.imag if singlet else moved.real)


def pitch_surface(mesh: HalfPitchMesh) -> FullSurface:
    """One slot pitch cut out of the stator, closed by its cut faces."""
    full, source, copy = mesh.full()
    count = len(mesh.elements)
    elements = full.elements[: 2 * count]
    element, local = _boundary(elements)
    quads = elements[element[:, None], local]
    used, compact = np.unique(quads, return_inverse=True)
    region = np.tile(mesh.region, 2)[element]
    return FullSurface(full.nodes[used], compact.reshape(quads.shape), region, used, source[used], copy[used])


def _outer_faces(mesh: HalfPitchMesh) -> tuple[np.ndarray, np.ndarray]:
    """Element (k,) and local nodes (k, 8) of the faces that no element and no half pitch touches."""
    element, local = _boundary(mesh.elements)
    corners = mesh.elements[element[:, None], local[:, :4]]
    between = np.zeros(len(element), dtype=bool)
    for plane in (mesh.tooth_plane, mesh.slot_plane):
        between |= np.isin(corners, plane).all(axis=1)
    return element[~between], local[~between]


def _boundary(elements: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Element and local nodes of the faces that belong to one element only."""
    key = np.sort(elements[:, _FACES[:, :4]].reshape(-1, 4), axis=1)
    _, inverse, count = np.unique(key, axis=0, return_inverse=True, return_counts=True)
    numbers = np.flatnonzero(count[inverse.ravel()] == 1)
    return numbers // len(_FACES), _FACES[numbers % len(_FACES)]
