"""Small stators and plain rings, and the whole stator assembled without any use of its symmetry."""

from pathlib import Path

import numpy as np

from statorhom.geometry import stator_geometry
from statorhom.materials.orthotropic import Orthotropic
from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.mesh import MeshDensity, mesh_step, uniform
from statorhom.model.affine import Material, assemble, hooke_coefficients
from statorhom.model.assembly import (
    HOOKE_ENTRIES,
    block_pattern,
    chunks,
    mass_blocks,
    node_blocks,
    stiffness_blocks,
)
from statorhom.model.cyclic.half_pitch import half_pitch
from statorhom.model.cyclic.problem import CyclicProblem, Shifted
from statorhom.model.element import gauss_table
from statorhom.model.harmonic import spaces_of
from statorhom.model.pitch_parts import pitch_parts
from statorhom.study.geometry_file import GeometryFile

STACK = Material(TransverselyIsotropic(182e9, 100e9, 0.29, 0.31, 25e9).hooke(), 7810.5)
WINDING = Material(TransverselyIsotropic(2.1e9, 11e9, 0.33, 0.08, 0.7e9).hooke(), 3166.0)
MATERIALS = {"lamination": STACK, "winding": WINDING, "overhang": WINDING}
ORTHOTROPIC = Orthotropic(190e9, 170e9, 90e9, 0.28, 0.35, 0.31, 66e9, 21e9, 28e9)


def pressed_sheets(surplus=0.0, nu_pz=0.3):
    """Material of a stack; `surplus`: relative, of what more pressure makes stiffer."""
    hooke = TransverselyIsotropic(190e9, 60e9 * (1 + surplus), 0.28, nu_pz, 25e9 * (1 + surplus)).hooke()
    return Material(hooke, 7700.0)


def geometry(slots, *, outer_mm=120.0, bore_mm=70.0, length_mm=80.0, **tables):
    """Geometry of `slots` (a table of the geometry file), with further tables as keywords."""
    core = {
        "outer_diameter_mm": outer_mm,
        "bore_diameter_mm": bore_mm,
        "length_mm": length_mm,
        "yoke_thickness_mm": 9.0,
    }
    file = {"schema": 1, "name": "small", "core": core, "slots": slots, **tables}
    return stator_geometry(GeometryFile.model_validate(file), Path("small.toml"))


def stator_mesh(count, kinds=("stack",), density=None, *, tooth_width_mm=12.0):
    """Half a pitch of a small stator with `count` wide slots."""
    slots = {"shape": "parallel_tooth", "count": count, "tooth_width_mm": tooth_width_mm}
    winding = {"overhang_length_mm": 20.0}
    return mesh_step(geometry(slots, winding=winding).step(kinds), density or uniform(1))


def ring_mesh(outer_mm, bore_mm, length_mm, *, radial, axial, sectors=24, tangential=1):
    """Half a sector of a plain ring."""
    made = geometry(
        {"shape": "none", "count": sectors}, outer_mm=outer_mm, bore_mm=bore_mm, length_mm=length_mm
    )
    cells = dict(uniform(1).cells) | {"yoke": radial, "core": axial, "slot": tangential}
    return mesh_step(made.step(("stack",)), MeshDensity(cells))


def assemble_whole(mesh, materials):
    """Stiffness and mass of any mesh in nodal cylindrical components."""
    count = len(mesh.elements)
    stiffness, mass = np.zeros((count, 60, 60)), np.zeros((count, 60, 60))
    for i, region in enumerate(mesh.regions):
        factors = hooke_coefficients(materials[region].hooke)
        for part, g in chunks(mesh, i):
            assert len(factors) == len(HOOKE_ENTRIES)
            stiffness[part] = sum(f * block for f, block in zip(factors, stiffness_blocks(g), strict=True))
            mass[part] = materials[region].density * mass_blocks(g, gauss_table().values)
    pattern = block_pattern(mesh.elements, len(mesh.nodes))
    return (
        pattern.matrix(pattern.gather(node_blocks(stiffness))),
        pattern.matrix(pattern.gather(node_blocks(mass))),
    )


def expand_whole(harmonic, y, source, copy):
    """Complex cylindrical displacement of the whole stator, (3 n, …), of a harmonic's coordinates."""
    shape = harmonic.expand(y)
    shape = shape.reshape(len(shape) // 3, 3, *y.shape[1:])[source]
    trailing = (1,) * (y.ndim - 1)
    mirrored = (copy % 2 == 1).reshape(-1, 1, *trailing)
    mirror = np.array([1.0, -1.0, 1.0]).reshape(1, 3, *trailing)
    shape = np.where(mirrored, np.conj(shape) * mirror, shape)
    phase = np.exp(2j * np.pi * harmonic.order / harmonic.slots * (copy // 2))
    return (shape * phase.reshape(-1, 1, *trailing)).reshape(3 * len(copy), *y.shape[1:])


def cylindrical(nodes, field):
    """Nodal cylindrical components (3 n,) of a Cartesian vector field (n, 3)."""
    angle = np.arctan2(nodes[:, 1], nodes[:, 0])
    cos, sin = np.cos(angle), np.sin(angle)
    return np.column_stack(
        [cos * field[:, 0] + sin * field[:, 1], cos * field[:, 1] - sin * field[:, 0], field[:, 2]]
    ).ravel()


def rigid_bodies(nodes):
    """The three translations and three small rotations about the axes, (6, 3 n)."""
    fields = [np.broadcast_to(axis, nodes.shape) for axis in np.eye(3)]
    fields += [np.cross(axis, nodes) for axis in np.eye(3)]
    return np.array([cylindrical(nodes, field) for field in fields])


def cyclic_problems(mesh, orders, shift):
    """Problems (K + shift M) of some orders, each with its matrices K and M of the whole stator."""
    model = assemble(mesh)
    K, M = model.stiffness_matrix(MATERIALS), model.mass_matrix(MATERIALS)
    parts = pitch_parts(mesh)
    shifted = {part.axial: Shifted(half_pitch(part, K, M), shift) for part in parts}
    spaces = [space for order in orders for space in spaces_of(parts, order)]
    return [
        (CyclicProblem(s, shifted[s.axial]), s.copies * s.project(K), s.copies * s.project(M)) for s in spaces
    ]
