"""20-node hexahedra of the part of a body that its planes of symmetry leave, and the whole body mirrored from it."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from statorhom.mesh.hex_mesh import MIRRORED, HexMesh, PartMesh

TOLERANCE = 1e-9  # m: nodes on a plane of symmetry


@dataclass(frozen=True, eq=False)
class MirrorMesh(PartMesh):
    """Mesh of the part of a body beside its planes of symmetry.

    Parameters
    ----------
    mirrors : (axis, position) of every plane of symmetry: x = position for axis 0, and so on (m); at most one per
        axis, none for a body without symmetry.
    """

    mirrors: tuple[tuple[int, float], ...]

    axes = "cartesian"

    @property
    def copies(self) -> int:
        """2 for each plane."""
        return int(2 ** len(self.mirrors))

    @property
    def full_dof(self) -> int:
        """Degrees of freedom of the whole body's mesh: nodes on a plane are their own image."""
        planes = range(len(self.mirrors))
        shared = sum((self.on_plane(i).astype(int) for i in planes), np.zeros(len(self.nodes), dtype=int))
        return 3 * int(np.sum(2 ** (len(self.mirrors) - shared)))

    def on_plane(self, number: int) -> np.ndarray:
        """(n,) whether a node lies on a plane of symmetry."""
        axis, position = self.mirrors[number]
        return np.asarray(np.abs(self.nodes[:, axis] - position) < TOLERANCE)

    def signs(self, parities: int) -> np.ndarray:
        """(planes, 3) factors of the components at the image of a point; bit i: the motion is odd at plane i."""
        signs = np.ones((len(self.mirrors), 3))
        for i, (axis, _) in enumerate(self.mirrors):
            signs[i, axis] = -1.0
            signs[i] *= -1.0 if parities >> i & 1 else 1.0
        return signs

    def full(self) -> tuple[HexMesh, np.ndarray, np.ndarray]:
        """The whole body.

        Returns
        -------
        mesh : HexMesh
        source : (m,) node of the part from which each node was copied.
        mirrored : (m, planes) whether it was mirrored at each plane.
        """
        n, planes = len(self.nodes), len(self.mirrors)
        flips = np.array(list(itertools.product((False, True), repeat=planes)), dtype=bool)
        # a node on a plane is its own image: of its copies the one that is not mirrored there counts
        own = np.column_stack([self.on_plane(i) for i in range(planes)]) if planes else np.zeros((n, 0), bool)
        weights = 2 ** np.arange(planes, dtype=np.int64)
        number = (flips[:, None, :] & ~own[None]) @ weights * n + np.arange(n)
        used, mapping = np.unique(number, return_inverse=True)
        mapping = mapping.reshape(number.shape)
        source, code = used % n, used // n
        mirrored = (code[:, None] & weights) > 0
        # an odd number of mirrors turns elements inside out, whichever they are
        elements = [
            mapping[c][self.elements[:, MIRRORED] if flip.sum() % 2 else self.elements]
            for c, flip in enumerate(flips)
        ]
        mesh = HexMesh(
            self.mirrored_positions(source, mirrored),
            np.concatenate(elements),
            np.tile(self.region, len(flips)),
            self.regions,
        )
        return mesh, source, mirrored

    def mirrored_positions(self, source: np.ndarray, mirrored: np.ndarray) -> np.ndarray:
        """Positions (m, 3) of nodes of the part, mirrored at the planes that (m, planes) names."""
        nodes = self.nodes[source].copy()
        for i, (axis, position) in enumerate(self.mirrors):
            nodes[mirrored[:, i], axis] = 2 * position - nodes[mirrored[:, i], axis]
        return nodes
