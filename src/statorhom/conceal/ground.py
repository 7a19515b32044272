"""The symmetric part of a true stator on its mesh, which is finer than the one that diagnoses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from statorhom.conceal.truth import TrueStage
from statorhom.geometry.stator import StatorGeometry
from statorhom.materials.hooke import Hooke
from statorhom.mesh import HalfPitchMesh, MeshDensity, graded, mesh_step
from statorhom.model.affine import AffineModel, Material, Materials, assemble, hooke_coefficients
from statorhom.model.broken.basis import SymmetricBasis, symmetric_basis
from statorhom.model.broken.interface import Contact, contact, split
from statorhom.model.broken.pieces import Pieces, mass_pieces, stiffness_pieces
from statorhom.model.free_modes import FreeProblem, problem_at

# every division of the section that the fit leaves at one cell has two here, graded towards the tooth roots, and the
# core twice as many along the axis: of what both meshes have alike a diagnosis would not be seen to get it wrong
STACK_MESH = graded(core=8)
# with a winding in the slots the corners are less sharp, and the mesh is twice as long
WOUND_MESH = graded(slot=1)
# parts that may rattle have so many local shapes that a finer mesh takes minutes and ten gigabytes
CONTACT_MESH = graded(tooth=1, slot=1, radial=3, yoke=3)
# band over the lowest frequency of order 2: eight names (r, n) of a stack, some doublets of a winding's dense modes
STACK_REACH, WOUND_REACH, CONTACT_REACH = 5.2, 3.2, 2.4
MARGIN = 1.4  # how far above the band the symmetric modes reach that carry the broken ones


@dataclass(frozen=True, eq=False)
class StageGround:
    """A stage's mesh, materials and symmetric modes.

    Parameters
    ----------
    model : of the half pitch.
    materials : of all regions.
    contact : joint that is not rigid.
    elliptic_hz : lowest frequency of order 2, about.
    highest_hz : upper end of the band.
    """

    model: AffineModel
    materials: Materials
    contact: Contact | None
    elliptic_hz: float
    highest_hz: float
    _own: dict[str, Pieces] = field(default_factory=dict, init=False, repr=False)

    @property
    def mesh(self) -> HalfPitchMesh:
        """Of the half pitch."""
        return self.model.mesh

    @cached_property
    def basis(self) -> SymmetricBasis:
        """Symmetric modes."""
        joint = None if self.contact is None else self.contact.matrix
        return symmetric_basis(self.model, self.materials, self.highest_hz, margin=MARGIN, contact=joint)

    def pieces(self, region: str) -> Pieces:
        """Stiffness of a region's elements."""
        if region not in self._own:
            own = hooke_coefficients(self.materials[region].hooke)
            self._own[region] = stiffness_pieces(self.mesh, {region: own})
        return self._own[region]

    def masses(self, region: str) -> Pieces:
        """Mass of a region's elements."""
        return mass_pieces(self.mesh, {region: self.materials[region].density})

    def with_factors(self, factors: Mapping[str, float]) -> StageGround:
        """The same stage with the moduli of some regions scaled."""
        changed = {
            region: Material(Hooke(factors.get(region, 1.0) * material.hooke.matrix), material.density)
            for region, material in self.materials.items()
        }
        return replace(self, materials=changed)


def truth_mesh(stage: TrueStage) -> MeshDensity:
    """The mesh of a true stator after some steps."""
    if stage.contact is not None:
        return CONTACT_MESH
    return STACK_MESH if stage.kinds == ("stack",) else WOUND_MESH


def _reach(stage: TrueStage) -> float:
    if stage.contact is not None:
        return CONTACT_REACH
    return STACK_REACH if stage.kinds == ("stack",) else WOUND_REACH


def stage_ground(
    geometry: StatorGeometry, stage: TrueStage, density: MeshDensity | None = None
) -> StageGround:
    """Mesh a stage and give it its materials.

    Parameters
    ----------
    geometry, stage : the true ones.
    density : of the mesh; None: what is usual of the step.

    Raises
    ------
    StatorhomError
        If the geometry does not allow the step.
    """
    mesh = mesh_step(geometry.step(stage.kinds), density or truth_mesh(stage))
    joint = None
    if stage.contact is not None:
        law = stage.contact
        regions = tuple(region for region in law.regions if region in mesh.regions)
        mesh = split(mesh, regions)
        joint = contact(mesh, regions, law.normal, law.tangential)
    model = assemble(mesh)
    materials = {region: stage.materials[region].material for region in mesh.regions}
    elliptic = _elliptic_hz(problem_at(model, materials), joint)
    highest = float(np.ceil(_reach(stage) * elliptic / 100.0) * 100.0)
    return StageGround(model, materials, joint, elliptic, highest)


def _elliptic_hz(problem: FreeProblem, joint: Contact | None) -> float:
    """Lowest frequency of order 2 (Hz)."""
    if joint is not None:
        problem = replace(problem, K=problem.K + joint.matrix)
    top = 1000.0
    while True:
        found = [mode.frequency_hz for mode in problem.solve(top, orders=(2,), most=1).modes]
        if found:
            return float(min(found))
        top *= 2.0
