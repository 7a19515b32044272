"""Springs and lumps on a stator's surface."""

from __future__ import annotations

import numpy as np

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.broken.change import Attachment
from statorhom.model.supports import HeldPoints
from statorhom.model.surface import surface_points, surface_radius


def springs(mesh: HalfPitchMesh, held: HeldPoints) -> Attachment:
    """Elastic lines and arcs to the ground, as `statorhom.model.supports.support_on` makes them."""
    assert held.stiffness is not None, "rigid supports are statorhom.model.supported_modes'"
    points = surface_points(mesh, held.angles, held.z)
    stiffness = held.stiffness.toarray()
    return Attachment(points, np.eye(len(stiffness)), stiffness, np.zeros_like(stiffness))


def point_springs(
    mesh: HalfPitchMesh, angles: np.ndarray, z: np.ndarray, stiffness: np.ndarray
) -> Attachment:
    """Springs to the ground at points of the outer surface, as of a suspension.

    Parameters
    ----------
    angles, z : (p,) positions (rad, m).
    stiffness : (3,) radial, tangential and axial (N/m), of each point.
    """
    points = surface_points(mesh, angles, z)
    diagonal = np.diag(np.tile(stiffness, len(points)))
    return Attachment(points, np.eye(len(diagonal)), diagonal, np.zeros_like(diagonal))


def lump(mesh: HalfPitchMesh, angle: float, z: float, mass_kg: float) -> Attachment:
    """A point mass on the outer surface at an angle (rad) and a height (m)."""
    points = surface_points(mesh, np.array([angle]), np.array([z]))
    return Attachment(points, np.eye(3), np.zeros((3, 3)), mass_kg * np.eye(3))


def footed_lump(
    mesh: HalfPitchMesh, angle: float, z: float, mass_kg: float, *, foot: float, height: float
) -> Attachment:
    """A rigid cube on a square foot, which follows the foot's mean motion and mean rotation.

    Parameters
    ----------
    angle, z : of the foot's centre (rad, m).
    foot : side of the square and of the cube (m).
    height : of the centre of gravity above the surface (m).
    """
    radius = surface_radius(mesh)
    along, up = (axis.ravel() for axis in np.meshgrid([-0.5, 0.0, 0.5], [-0.5, 0.0, 0.5]))
    turn = foot * along / radius
    points = surface_points(mesh, angle + turn, z + foot * up)
    # the points' positions from the foot's centre and their axes, both in the centre's axes (r, θ, z)
    position = np.column_stack([radius * (np.cos(turn) - 1), radius * np.sin(turn), foot * up])
    rigid = np.zeros((3 * len(turn), 6))
    for i, (t, p) in enumerate(zip(turn, position, strict=True)):
        axes = np.array([[np.cos(t), np.sin(t), 0.0], [-np.sin(t), np.cos(t), 0.0], [0.0, 0.0, 1.0]])
        rigid[3 * i : 3 * i + 3] = axes @ _rigid_motion(p)
    centre = _rigid_motion(np.array([height, 0.0, 0.0]))
    mass = mass_kg * centre.T @ centre
    mass[3:, 3:] += mass_kg * foot**2 / 6 * np.eye(3)
    return Attachment(points, np.linalg.pinv(rigid), np.zeros((6, 6)), mass)


def _rigid_motion(position: np.ndarray) -> np.ndarray:
    """Motion (3, 6) of a point under three translations and three small rotations about the origin."""
    a, b, c = position
    return np.hstack([np.eye(3), [[0.0, c, -b], [-c, 0.0, a], [b, -a, 0.0]]])
