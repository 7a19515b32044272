"""Plates with something hidden: frequencies of whole meshes that the program's own modal basis has no part in."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy.sparse as sp

from statorhom.geometry.block import BlockGeometry
from statorhom.materials.orthotropic import Orthotropic
from statorhom.mesh.block import block_mesh
from statorhom.model.affine import Material
from statorhom.model.frames import cartesian
from statorhom.model.general.general_model import GeneralModel, general_model

Size = tuple[float, float, float]
SIZE: Size = (0.3, 0.2, 0.004)
CLOTH = Material(Orthotropic(60e9, 22e9, 11e9, 0.28, 0.3, 0.3, 7e9, 4.5e9, 4e9).hooke(), 1600.0)
RIGID_HZ = 20.0


@dataclass(frozen=True)
class Hidden:
    """A lump (kg) and a spring across the plate (N/m) at a place of the upper face (m)."""

    x: float
    y: float
    mass_kg: float = 0.0
    stiffness: float = 0.0


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
) -> tuple[np.ndarray, list[tuple[float, float]]]:
    """Elastic frequencies (Hz) of a free plate, and the nodes (x, y) that took what is hidden."""
    model = whole_plate(size, factor)
    mass, stiffness = np.zeros(model.size), np.zeros(model.size)
    nodes = []
    for one in hidden:
        away = np.linalg.norm(model.mesh.nodes - [one.x, one.y, size[2]], axis=1)
        node = int(np.argmin(away))
        mass[3 * node : 3 * node + 3] += one.mass_kg
        stiffness[3 * node + 2] += one.stiffness
        nodes.append((float(model.mesh.nodes[node, 0]), float(model.mesh.nodes[node, 1])))
    changed = model.with_added(sp.diags_array(stiffness), sp.diags_array(mass))
    found = changed.solve(highest_hz, {"plate": material}).frequencies_hz
    return found[found > RIGID_HZ], nodes
