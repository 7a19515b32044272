"""Extrude the meshed section into the hexahedra of a fabrication step."""

from __future__ import annotations

import numpy as np

from statorhom.errors import GeometryError
from statorhom.geometry.parts import Span
from statorhom.geometry.stator import StepGeometry
from statorhom.mesh.density import MeshDensity
from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.mesh.quality import scaled_jacobians
from statorhom.mesh.section_mesh import SectionMesh, mesh_section

WINDING = "winding"  # region that fills the slots
PLANE_TOLERANCE = 1e-9  # rad: nodes on the planes of symmetry, which gmsh places to rounding
LEAST_JACOBIAN = 1e-3  # scaled; cells below are slivers, negative ones are folded


def mesh_step(step: StepGeometry, density: MeshDensity) -> HalfPitchMesh:
    """Mesh half a slot pitch of a step with 20-node hexahedra.

    Raises
    ------
    GeometryError
        If some dimensions are so far apart that cells become slivers.
    """
    if WINDING not in step.regions:
        density = density.of_empty_slots()
    flat = mesh_section(step.section, density)
    _check_cells(step, flat)
    columns = _Columns(len(flat.points))
    blocks, regions = [], []
    names = step.regions
    for part in step.parts:
        quads = np.concatenate([flat.quads[patch.name].reshape(-1, 8) for patch in part.patches])
        for span in part.spans:
            levels = [columns.level(z) for z in _levels(span, step.dimensions.outer_radius, density)]
            blocks.append(_extrude(quads, levels, columns.width))
            regions.append(np.full(len(blocks[-1]), names.index(part.region)))
    return _compact(step, flat, columns, np.concatenate(blocks), np.concatenate(regions))


def _check_cells(step: StepGeometry, flat: SectionMesh) -> None:
    for patch, quads in flat.quads.items():
        if scaled_jacobians(flat.points, quads).min() < LEAST_JACOBIAN:
            raise GeometryError(
                f"{step.source}: the dimensions of [slots] and [core] leave only slivers in the {patch}; "
                f"check slots.count = {step.dimensions.slots} and the widths and heights of the slot"
            )


def _levels(span: Span, outer_radius: float, density: MeshDensity) -> np.ndarray:
    """Axial positions of a span's nodes, mid-sides included."""
    whole = (span.high - span.low) / span.share / outer_radius
    cells = density.along(span.division, whole, span.share)
    shares = density.levels(cells) if span.toward_ends else np.linspace(0.0, 1.0, cells + 1)
    ends = span.low + (span.high - span.low) * shares
    ends[-1] = span.high
    levels = np.empty(2 * cells + 1)
    levels[::2], levels[1::2] = ends, (ends[1:] + ends[:-1]) / 2
    return levels


class _Columns:
    """Numbers (point of the section, axial level) pairs, so that parts which touch share their nodes."""

    def __init__(self, width: int) -> None:
        self.width = width
        self.levels: list[float] = []
        self._index: dict[int, int] = {}

    def level(self, z: float) -> int:
        key = round(z * 1e9)  # levels closer than a nanometre are one
        if key not in self._index:
            self._index[key] = len(self.levels)
            self.levels.append(float(z))
        return self._index[key]


def _extrude(quads: np.ndarray, levels: list[int], width: int) -> np.ndarray:
    corners, middles = quads[:, :4], quads[:, 4:]
    layers = []
    for low, mid, high in zip(levels[:-2:2], levels[1:-1:2], levels[2::2], strict=True):
        nodes = [(low, corners), (high, corners), (low, middles), (mid, corners), (high, middles)]
        layers.append(np.hstack([level * width + points for level, points in nodes]))
    return np.concatenate(layers)


def _compact(
    step: StepGeometry, flat: SectionMesh, columns: _Columns, elements: np.ndarray, region: np.ndarray
) -> HalfPitchMesh:
    """Number the nodes in use from 0."""
    used, elements = np.unique(elements, return_inverse=True)
    xy = flat.points[used % columns.width]
    z = np.array(columns.levels)[used // columns.width]
    d = step.dimensions
    tooth, slot = (_on_plane(xy, angle) for angle in (0.0, d.half_pitch))
    return HalfPitchMesh(
        nodes=np.column_stack([xy, z]),
        elements=elements.reshape(-1, 20),
        region=region,
        regions=step.regions,
        slots=d.slots,
        length=d.length,
        outer_radius=d.outer_radius,
        tooth_plane=tooth,
        slot_plane=slot,
    )


def _on_plane(xy: np.ndarray, angle: float) -> np.ndarray:
    """Numbers of the points on a plane of symmetry; they are put exactly there, so that copies fit."""
    found = np.flatnonzero(np.abs(np.arctan2(xy[:, 1], xy[:, 0]) - angle) < PLANE_TOLERANCE)
    xy[found] = np.hypot(*xy[found].T)[:, None] * (np.cos(angle), np.sin(angle))
    return found
