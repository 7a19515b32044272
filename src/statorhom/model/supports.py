"""What a declared support holds: points of the outer surface and end faces of the core."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from statorhom.errors import SupportError
from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.arc_support import arc_points, arc_stiffness
from statorhom.model.end_faces import EndFaces
from statorhom.model.line_support import line_points, line_stiffness
from statorhom.model.surface_grid import surface_grid
from statorhom.study.supports import LineSupport, SupportKeys

MERGED_DEG = 1e-6  # lines and arcs closer than this are one


@dataclass(frozen=True)
class HeldPoints:
    """Points of the outer surface that are held.

    Parameters
    ----------
    angles, z : (p,) positions (rad, m).
    stiffness : (3 p, 3 p) of the springs (N/m) between the points' displacements (u_r, u_θ, u_z) and the
        ground, semidefinite; None: the points do not move.
    """

    angles: np.ndarray
    z: np.ndarray
    stiffness: sp.csr_array | None

    def __post_init__(self) -> None:
        for array in (self.angles, self.z):
            array.setflags(write=False)

    def __len__(self) -> int:
        return len(self.angles)


@dataclass(frozen=True)
class Support:
    """A support on a mesh.

    Parameters
    ----------
    points : of the outer surface; may be none.
    ends : what holds the core's end faces, None where they are free.
    """

    points: HeldPoints
    ends: EndFaces | None


def support_on(mesh: HalfPitchMesh, keys: SupportKeys) -> Support:
    """Apply a study's support to a mesh.

    Lines and arcs reach over the full length of the outer surface. A rigid arc fixes the nodes within it and
    its two ends; an elastic one is integrated over exactly its own area.

    Raises
    ------
    SupportError
        If an elastic support has no stiffness.
    """
    if isinstance(keys, LineSupport):
        stiffness = _stiffness(keys, keys.normal_stiffness_n_per_m2, "normal_stiffness_n_per_m2")
        return Support(_lines(mesh, keys.angles_deg, stiffness), None)
    stiffness = _stiffness(keys, keys.normal_stiffness_n_per_m3, "normal_stiffness_n_per_m3")
    ends = EndFaces("lower_end" in keys.faces, "upper_end" in keys.faces, stiffness) if keys.faces else None
    return Support(_arcs(mesh, keys.arcs_deg, stiffness), ends)


def _stiffness(keys: SupportKeys, normal: float | None, key: str) -> np.ndarray | None:
    """Radial, tangential and axial stiffness on the outer surface per metre or square metre; None: rigid."""
    if keys.declared == "rigid":
        return None
    if normal is None:
        raise SupportError(
            f'support "{keys.name}" is declared elastic without a stiffness; add {key} = … to it in the '
            'study file, or write declared = "rigid"'
        )
    return normal * np.array([1.0, keys.tangential_ratio, keys.tangential_ratio])


def _lines(mesh: HalfPitchMesh, angles_deg: tuple[float, ...], stiffness: np.ndarray | None) -> HeldPoints:
    grid = surface_grid(mesh)
    angles = np.deg2rad(_distinct(np.asarray(angles_deg)))
    theta, z = line_points(grid, angles)
    return HeldPoints(theta, z, None if stiffness is None else line_stiffness(grid, len(angles), stiffness))


def _arcs(
    mesh: HalfPitchMesh, arcs_deg: tuple[tuple[float, float], ...], stiffness: np.ndarray | None
) -> HeldPoints:
    grid = surface_grid(mesh)
    arcs = np.deg2rad(np.array(arcs_deg).reshape(-1, 2))
    if stiffness is None:
        return HeldPoints(*arc_points(grid, arcs), None)
    return HeldPoints(*arc_stiffness(grid, arcs, stiffness))


def _distinct(angles_deg: np.ndarray) -> np.ndarray:
    places = np.round(np.mod(angles_deg, 360.0) / MERGED_DEG).astype(np.int64) % round(360.0 / MERGED_DEG)
    return np.asarray(angles_deg[np.unique(places, return_index=True)[1]])
