"""The axial contact pressure, and with it G_rz and E_z, varies along the stack."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np

from statorhom.errors import MaterialError
from statorhom.materials.hooke import Hooke
from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import Materials, hooke_coefficients
from statorhom.model.assembly import HOOKE_ENTRIES
from statorhom.model.broken.change import Change
from statorhom.model.broken.variations import gradient
from statorhom.physics.action import Action, Training
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect
from statorhom.physics.parameter import EffectParameter
from statorhom.physics.pieces import pieces_by_height
from statorhom.physics.ring import ring_of
from statorhom.study.regions import core_region
from statorhom.study.study import StudyFiles

RATIO = EffectParameter("G_rz_end_ratio", 0.15, 3.0, 0.02, 20.0, "log", (0.5, 1.8), 1.0)
# Strengths of the examples, one after the other: a strong one bends what a weak one does not
TRAINED = (0.4, 0.15)
SHEAR = tuple(entry in ((3, 3), (4, 4)) for entry in HOOKE_ENTRIES)  # between sheets and across them


class StackPressureGradient(Effect):
    name = "stack_pressure_gradient"
    part = "the sheets of the stack"
    summary = "the axial contact pressure, and with it G_rz and E_z, varies along the stack"
    citation = "Johnson (1985), Contact Mechanics, ch. 13 (rough surfaces)"
    confused_with = (Confusion("interlaminar_shear", "the shapes along z"),)
    note = "G_rz and E_z at the end z = L over those at z = 0, linear in between, their mean unchanged"

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        stages = [stage.name for stage in files.study.stages if stage.tests]
        core = ring_of(files).region
        if files.study.symmetry(0, core) == "isotropic":
            return ()
        return tuple(Candidate(self.name, name, (RATIO,), core) for name in stages[:1])

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        length = ring_of(files).length

        def varied(mesh: HalfPitchMesh, materials: Materials, ratio: float) -> tuple[Change, ...]:
            core = core_region(materials)
            material = materials[core]
            slope = (ratio - 1.0) / (ratio + 1.0)

            def surplus(z: np.ndarray) -> np.ndarray:
                return slope * (2 * z / length - 1.0)

            along, weight = axial_modulus(material.hooke, surplus)
            sheared = np.where(SHEAR, hooke_coefficients(material.hooke), 0.0)
            normal, shear = (pieces_by_height(mesh, core, entries) for entries in (along, sheared))
            return gradient(normal, weight), gradient(shear, surplus)

        def examples(mesh: HalfPitchMesh, materials: Materials) -> tuple[tuple[Change, ...], ...]:
            return tuple(varied(mesh, materials, ratio) for ratio in TRAINED)

        return Action(
            changes=partial(varied, ratio=values["G_rz_end_ratio"]),
            # where nothing presses on the ends, E_z matters by nu_pz² E_z/E_p alone, which few modes tell
            follows_materials=True,
            training=Training(self.name, examples),
        )


def axial_modulus(
    hooke: Hooke, surplus: Callable[[np.ndarray], np.ndarray]
) -> tuple[np.ndarray, Callable[[np.ndarray], np.ndarray]]:
    """What another E_z changes of a Hooke's matrix, where the sheets' own moduli and Poisson's ratios stay.

    With the compliance's other entries fixed, C33 = 1/(1/E_z - q) with a constant q, and the normal entries are
    linear in C33: they change along v vᵀ, v = (C13, C23, C33) / C33.

    Parameters
    ----------
    hooke : where E_z is the mean.
    surplus : height (m) → relative surplus of E_z there.

    Returns
    -------
    entries, weight : nine Hooke entries of the change by one C33, and height → how often it is added; a MaterialError
        where no material has such an E_z.
    """
    C = hooke.matrix
    v = C[:3, 2] / C[2, 2]
    entries = np.array([C[2, 2] * v[i] * v[j] if max(i, j) < 3 else 0.0 for i, j in HOOKE_ENTRIES])
    compliance = float(np.linalg.inv(C[:3, :3])[2, 2])
    q = compliance - 1.0 / C[2, 2]

    def weight(z: np.ndarray) -> np.ndarray:
        left = compliance / (1.0 + surplus(z)) - q
        if left.min() <= 0.0:
            raise MaterialError("E_z at the stiffer end is too high for the sheets' Poisson's ratios")
        return 1.0 / (C[2, 2] * left) - 1.0

    return entries, weight


EFFECT = StackPressureGradient()
