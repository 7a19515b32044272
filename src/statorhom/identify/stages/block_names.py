"""Names of the modes of plates, beams and wings: what the body does, and the nodal lines (i, j) over its plan form."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.errors import IdentificationError
from statorhom.mesh.mirror_mesh import TOLERANCE, MirrorMesh
from statorhom.mesh.wing import WingMesh
from statorhom.model.convergence import ModeKey, mode_keys
from statorhom.model.free_modes import FreeModes
from statorhom.model.mirror_names import PLATE, mirror_kind
from statorhom.model.stator_mode import StatorMode
from statorhom.modes.plan_form import name_plan_form

X, Y, Z = np.eye(3)
# span, chord and normal of the plan form that tells a beam's motion
_BEAM_AXES = {"bending along y": (X, Z, Y), "bending along z": (X, Y, Z), "torsion about x": (X, Y, Z)}


def block_names(mesh: MirrorMesh, solution: FreeModes) -> dict[ModeKey, str]:
    """Names of all modes of a solution; empty where the motion of the surface does not tell one.

    Parameters
    ----------
    mesh : of the part beside the planes of symmetry.
    solution : its modes.
    """
    surface = _Surface.of(mesh)
    return {key: surface.name(solution, mode) for key, mode in mode_keys(solution.modes).items()}


@dataclass(frozen=True, eq=False)
class _Surface:
    """Corners of elements on the face of the whole body that the plan form is seen on.

    Parameters
    ----------
    mesh : of the part beside the planes of symmetry.
    points : ndarray, shape (points, 3); on the whole body.
    source : ndarray, shape (points,); node of the part that each is or is mirrored from.
    mirrored : ndarray of bool, shape (points, planes); at which planes.
    """

    mesh: MirrorMesh
    points: np.ndarray
    source: np.ndarray
    mirrored: np.ndarray

    @classmethod
    def of(cls, mesh: MirrorMesh) -> _Surface:
        """The upper face."""
        full, source, mirrored = mesh.full()
        if isinstance(mesh, WingMesh):
            chosen = np.isin(source, mesh.upper)
        else:
            chosen = np.abs(full.nodes[:, 2] - full.nodes[:, 2].max()) < TOLERANCE
            chosen &= np.isin(source, np.unique(mesh.elements[:, :8]))
        return cls(mesh, full.nodes[chosen], source[chosen], mirrored[chosen])

    def name(self, solution: FreeModes, mode: StatorMode) -> str:
        """Name of a mode."""
        parities = mode.parities or 0
        motion = self._motion(solution, mode, parities)
        if isinstance(self.mesh, WingMesh):
            return _statement(self.points, motion, (Y, X, Z), with_symmetry=True)
        kind = mirror_kind(self.mesh, parities)
        if self.mesh.regions[0] == PLATE:
            return (_statement(self.points, motion, (X, Y, Z)) or kind) if kind == "bending" else kind
        axes = _BEAM_AXES.get(kind)
        if axes is None:
            return kind
        found = _statement(self.points, motion * axes[2], axes)
        return f"{kind} {found[found.index('(') :]}" if found else kind

    def _motion(self, solution: FreeModes, mode: StatorMode, parities: int) -> np.ndarray:
        """Displacements (points, 3) of the whole body's points."""
        moved = solution.shape(mode).real.reshape(-1, 3)[self.source]
        for i, sign in enumerate(self.mesh.signs(parities)):
            moved = np.where(self.mirrored[:, i, None], moved * sign, moved)
        return np.asarray(moved)


Axes = tuple[np.ndarray, np.ndarray, np.ndarray]


def _statement(points: np.ndarray, motion: np.ndarray, axes: Axes, *, with_symmetry: bool = False) -> str:
    try:
        found = name_plan_form(points, motion, np.array(axes))
    except IdentificationError:
        return ""
    if found.kind is None or found.span_nodes is None:
        return ""
    words = f"{found.kind} ({found.span_nodes}, {found.chord_nodes})"
    return f"{found.symmetry} {words}" if with_symmetry and found.symmetry else words
