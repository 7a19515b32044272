"""Full solution at the identified constants: named modes with their order spectra, for pairing and pictures."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.free_modes import FreeModes
from statorhom.model.harmonic import Harmonic
from statorhom.model.radial_profile import PLANES, usual_planes
from statorhom.model.stator_mode import StatorMode
from statorhom.model.surface import SurfacePoints, surface_points
from statorhom.modes.naming import ModeName, name_shape
from statorhom.modes.order_spectrum import order_spectrum
from statorhom.results.shape_file import ModeShape

ANGLES = 36  # of the grid on which simulated shapes are analysed: orders up to 18


@dataclass(frozen=True)
class ShapeGrid:
    """Points on the whole outer surface, planes slowest."""

    angles: np.ndarray
    planes: np.ndarray
    points: SurfacePoints


def shape_grid(mesh: HalfPitchMesh) -> ShapeGrid:
    """A regular grid over the core's outer surface."""
    angles = np.arange(ANGLES) * 2 * np.pi / ANGLES
    planes = usual_planes(mesh.length)
    return ShapeGrid(angles, planes, surface_points(mesh, np.tile(angles, PLANES), np.repeat(planes, ANGLES)))


def surface_motion(grid: ShapeGrid, solution: FreeModes, mode: StatorMode) -> np.ndarray:
    """Real motion (planes, angles, 3) of a free mode; of a doublet the shape with an antinode at tooth 0."""
    harmonic = solution.harmonics[mode.problem]
    assert isinstance(harmonic, Harmonic)
    motion = grid.points.evaluate(harmonic, solution.shape(mode))
    real = motion.imag if harmonic.parity == "odd" else motion.real
    return np.asarray(real.reshape(len(grid.planes), len(grid.angles), 3))


def name_and_spectrum(grid: ShapeGrid, motion: np.ndarray) -> tuple[ModeName, np.ndarray]:
    """Name of a shape and its signed order amplitudes (planes, orders)."""
    name = name_shape(
        motion[..., 0], grid.angles, grid.planes, tangential=motion[..., 1], axial_motion=motion[..., 2]
    )
    orders = ANGLES // 2 + 1
    if not np.any(motion[..., 0]):
        return name, np.zeros((len(grid.planes), orders))
    found = order_spectrum(motion[..., 0], grid.angles)
    return name, np.column_stack([np.real(found.signed_amplitudes(r)) for r in range(orders)])


def mode_shape(grid: ShapeGrid, solution: FreeModes, mode: StatorMode) -> ModeShape:
    """What the report draws of a free mode."""
    harmonic = solution.harmonics[mode.problem]
    name, spectrum = name_and_spectrum(grid, surface_motion(grid, solution, mode))
    shape = solution.shape(mode).reshape(-1, 3)
    return ModeShape(
        frequency_hz=mode.frequency_hz,
        displacement=shape,
        harmonic=harmonic.order,
        parity=harmonic.parity,
        order=mode.order,
        axial=mode.axial,
        kind=mode.kind if mode.order is not None else name.kind,
        share=name.share,
        spectrum=spectrum,
    )


def block_shape(solution: FreeModes, mode: StatorMode, kind: str) -> ModeShape:
    """What the report draws of a plate's or a beam's mode."""
    space = solution.harmonics[mode.problem]
    return ModeShape(
        frequency_hz=mode.frequency_hz,
        displacement=solution.shape(mode).reshape(-1, 3),
        harmonic=space.order,
        parity=space.parity,
        order=None,
        axial=None,
        kind=kind,
        share=0.0,
        spectrum=np.zeros((0, 0)),
    )
