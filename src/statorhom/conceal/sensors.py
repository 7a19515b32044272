"""Where accelerometers and hammer are, and where the file says they are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.broken.attachments import point_springs
from statorhom.model.broken.change import Attachment
from statorhom.recordings.dof import Dof, Vector

PLANES = (0.05, 0.35, 0.65, 0.95)  # of the core's length
ANGLES = 24
JITTER_DEG = 0.5
FIRST_HAMMER = 901
# A spring too weak to be felt, which puts the static response to the hammer's force among the Ritz vectors: it stands
# for all modes that are left out (MacNeal 1971, Comput. Struct. 1, 581).
FAINT_N_PER_M = 1e-3


@dataclass(frozen=True, eq=False)
class Sensors:
    """A test's points.

    Parameters
    ----------
    angles, z : (p,) true positions of the accelerometers (rad, m).
    responses : what the file says of them.
    hammer_angles, hammer_z : (h,) of the hits.
    hammers : what the file says of them.
    """

    angles: np.ndarray
    z: np.ndarray
    responses: tuple[Dof, ...]
    hammer_angles: np.ndarray
    hammer_z: np.ndarray
    hammers: tuple[Dof, ...]

    def __post_init__(self) -> None:
        for array in (self.angles, self.z, self.hammer_angles, self.hammer_z):
            array.setflags(write=False)

    def faint_springs(self, mesh: HalfPitchMesh) -> Attachment:
        """What brings the hammer's static response into the basis."""
        return point_springs(mesh, self.hammer_angles, self.hammer_z, np.array([FAINT_N_PER_M, 0.0, 0.0]))


def sensors(radius: float, length: float, hits: int, rng: np.random.Generator) -> Sensors:
    """A grid of accelerometers and the places where the hammer hits.

    Parameters
    ----------
    radius, length : of the core (m).
    hits : number of hammer points.
    rng : source of the jitter and of the hammer's places.
    """
    nominal = np.tile(2 * np.pi * np.arange(ANGLES) / ANGLES, len(PLANES))
    z = np.repeat(np.array(PLANES) * length, ANGLES)
    angles = nominal + np.deg2rad(rng.uniform(-JITTER_DEG, JITTER_DEG, len(nominal)))
    numbers = [100 * (i // ANGLES + 1) + i % ANGLES + 1 for i in range(len(nominal))]
    responses = tuple(
        _dof(n, radius, float(a), float(h), 1.0) for n, a, h in zip(numbers, nominal, z, strict=True)
    )
    first = rng.uniform(0, 2 * np.pi)
    # two hits a little more or less than an eighth of a turn apart excite different doublet members
    hammer_angles = np.array([first, first + rng.uniform(0.6, 1.0)])[:hits]
    hammer_z = rng.uniform(0.03, 0.10, hits) * length
    sign = float(rng.choice([-1.0, 1.0]))
    hammers = tuple(
        _dof(FIRST_HAMMER + i, radius, float(a), float(h), sign)
        for i, (a, h) in enumerate(zip(hammer_angles, hammer_z, strict=True))
    )
    return Sensors(angles, z, responses, hammer_angles, hammer_z, hammers)


def _dof(node: int, radius: float, angle: float, z: float, sign: float) -> Dof:
    cos, sin = float(np.cos(angle)), float(np.sin(angle))
    direction: Vector = (sign * cos, sign * sin, 0.0)
    return Dof(node, (radius * cos, radius * sin, z), direction)
