"""Plates with something hidden: frequencies of whole meshes that the program's own modal basis has no part in."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
import scipy.sparse as sp

from roving_sensor import loaded_accelerance
from statorhom.geometry.block import BlockGeometry
from statorhom.materials.hooke import Hooke
from statorhom.materials.orthotropic import Orthotropic
from statorhom.mesh.block import block_mesh
from statorhom.model.affine import Material
from statorhom.model.frames import cartesian
from statorhom.model.general.general_model import GeneralModel, general_model
from statorhom.recordings.dof import Dof
from statorhom.recordings.frf_set import FrfSet
from statorhom.recordings.recording import Node, Recording
from statorhom.recordings.uff.writer import write_uff

Size = tuple[float, float, float]
SIZE: Size = (0.3, 0.2, 0.004)
CLOTH = Material(Orthotropic(60e9, 22e9, 11e9, 0.28, 0.3, 0.3, 7e9, 4.5e9, 4e9).hooke(), 1600.0)
RIGID_HZ = 20.0
LOSS, GRID = 0.006, (7, 5)  # of recordings: loss factor, points along and across


@dataclass(frozen=True)
class Hidden:
    """A lump (kg) and a spring across the plate (N/m) at a place of the upper face (m)."""

    x: float
    y: float
    mass_kg: float = 0.0
    stiffness: float = 0.0


@dataclass(frozen=True)
class Patch:
    """A rectangle (m) in which all moduli are those of the plate times a ratio."""

    x: tuple[float, float]
    y: tuple[float, float]
    ratio: float


@lru_cache(maxsize=4)
def whole_plate(size: Size, factor: float) -> GeneralModel:
    """The whole plate's mesh, no symmetry used."""
    return general_model(block_mesh(BlockGeometry("plate", size, "test"), factor).full()[0], cartesian)


def plate_frequencies(
    highest_hz: float,
    hidden: Sequence[Hidden] = (),
    *,
    material: Material = CLOTH,
    size: Size = SIZE,
    factor: float = 1.0,
    patch: Patch | None = None,
) -> tuple[np.ndarray, list[tuple[float, float]]]:
    """Elastic frequencies (Hz) of a free plate, and the nodes (x, y) that took what is hidden."""
    model, materials = whole_plate(size, factor), {"plate": material}
    if patch is not None:
        middles = model.mesh.nodes[model.mesh.elements].mean(axis=1)
        inside = np.ones(len(middles), dtype=bool)
        for at, (low, high) in zip(middles.T, (patch.x, patch.y), strict=False):
            inside &= (low < at) & (at < high)
        model = model.with_region("patch", inside)
        materials["patch"] = Material(Hooke(patch.ratio * material.hooke.matrix), material.density)
    mass, stiffness = np.zeros(model.size), np.zeros(model.size)
    nodes = []
    for one in hidden:
        away = np.linalg.norm(model.mesh.nodes - [one.x, one.y, size[2]], axis=1)
        node = int(np.argmin(away))
        mass[3 * node : 3 * node + 3] += one.mass_kg
        stiffness[3 * node + 2] += one.stiffness
        nodes.append((float(model.mesh.nodes[node, 0]), float(model.mesh.nodes[node, 1])))
    changed = model.with_added(sp.diags_array(stiffness), sp.diags_array(mass))
    found = changed.solve(highest_hz, materials).frequencies_hz
    return found[found > RIGID_HZ], nodes


def plate_recording(path: Path, lines: np.ndarray, sensor_kg: float, *, factor: float, noise: float) -> None:
    """FRFs (universal file) of a roving accelerometer with a mass on the upper face, hammer at a corner."""
    model = whole_plate(SIZE, factor)
    found = model.solve(1.6 * float(lines[-1]), {"plate": CLOTH})
    grid = [(x, y) for x in np.linspace(0.0, SIZE[0], GRID[0]) for y in np.linspace(0.0, SIZE[1], GRID[1])]
    nodes = [int(np.argmin(np.linalg.norm(model.mesh.nodes - [*at, SIZE[2]], axis=1))) for at in grid]
    shapes = found.vectors.T.reshape(len(found.eigenvalues), -1, 3)[:, nodes]
    moved = shapes[..., [2, 0, 1]]
    poles = [(max(f, 1.0), LOSS) for f in found.frequencies_hz.tolist()]
    exact = loaded_accelerance(lines, poles, moved, moved[:, -1, 0], sensor_kg)
    points = [
        Dof(i + 1, tuple(model.mesh.nodes[n].tolist()), (0.0, 0.0, 1.0))  # type: ignore[arg-type]
        for i, n in enumerate(nodes)
    ]
    rng = np.random.default_rng(5)
    normal = rng.normal(size=(2, *exact.shape)) / np.sqrt(2)
    sd = np.hypot(noise * np.abs(exact), 3e-4 * np.abs(exact).max())
    frfs = FrfSet(
        lines, tuple(points), (points[-1],) * len(points), exact + sd * (normal[0] + 1j * normal[1])
    )
    places = tuple(Node(p.node, p.position) for p in points if p.position is not None)
    write_uff(path, Recording("plate", frf_sets=(frfs,), nodes=places))
