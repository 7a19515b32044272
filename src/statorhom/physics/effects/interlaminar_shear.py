"""The sheets slide on each other: the stack is much softer in shear and along z than in its plane."""

from __future__ import annotations

from collections.abc import Mapping

from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.model.affine import Material, Materials
from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect
from statorhom.physics.parameter import EffectParameter
from statorhom.physics.ring import ring_of
from statorhom.study.study import StudyFiles

SHEAR = EffectParameter("G_rz_pa", 1e9, 60e9, 0.2e9, 75e9, "log", (35e9, 10e9, 2.5e9), None)
AXIAL = EffectParameter("E_z_pa", 5e9, 180e9, 0.3e9, 240e9, "log", (100e9, 30e9, 5e9), None)


def sheared(material: Material, shear_pa: float, axial_pa: float) -> Material:
    """An isotropic material that becomes soft along z and in shear; its constants in the plane stay."""
    compliance = material.hooke.compliance
    E, nu = 1 / compliance[0, 0], -compliance[0, 1] / compliance[0, 0]
    return Material(TransverselyIsotropic(E, axial_pa, nu, nu, shear_pa).hooke(), material.density)


class InterlaminarShear(Effect):
    name = "interlaminar_shear"
    part = "the sheets of the stack"
    summary = "the sheets slide on each other: the stack is much softer in G_rz than an isotropic one"
    citation = "Backus (1962), J. Geophys. Res. 67, 4427 (fine layers)"
    confused_with = (
        Confusion("local_stiffness", "the phase at the two end planes"),
        Confusion("stack_pressure_gradient", "the shapes along z"),
    )

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        core = ring_of(files).region
        if files.study.symmetry(0, core) != "isotropic":
            return ()
        first = next((s.name for s in files.study.stages if s.tests), files.study.stages[0].name)
        return (Candidate(self.name, first, (SHEAR, AXIAL), core),)

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        core = ring_of(files).region

        def rule(materials: Materials) -> Materials:
            return {**materials, core: sheared(materials[core], values["G_rz_pa"], values["E_z_pa"])}

        return Action(materials=rule, symmetries={core: "transversely_isotropic"})


EFFECT = InterlaminarShear()
