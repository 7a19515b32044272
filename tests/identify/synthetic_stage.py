"""A step on a small plain ring whose truth is known: what the tests of the fit work on."""

from functools import cache

import numpy as np

from example_stators import stator
from statorhom.identify.bases.training import training_materials
from statorhom.identify.fits.priors import Carried, stage_space
from statorhom.identify.residuals.model_error import ModelError
from statorhom.identify.residuals.stage_problem import StageProblem
from statorhom.identify.stages.stage_materials import RegionModel, StageMaterials
from statorhom.materials.density import RegionDensity
from statorhom.mesh import MeshDensity, mesh_step, uniform
from statorhom.model.affine import Material, assemble
from statorhom.model.free_modes import solve_free
from statorhom.model.harmonic import problems_of
from statorhom.model.reduced import material_box, reduce_harmonic
from statorhom.model.reduced_stator import reduced_stator
from statorhom.study.modal_table import MeasuredMode
from statorhom.study.stages import StageKeys

LAMINATION = StageMaterials((RegionModel("lamination", "transversely_isotropic", "lamination"),))
TRUTH = {
    "lamination.E_p_pa": 186e9,
    "lamination.E_z_pa": 60e9,
    "lamination.nu_p": 0.29,
    "lamination.nu_pz": 0.31,
    "lamination.G_rz_pa": 17e9,
    "lamination.density_kg_m3": 7700.0,
    "mesh": 0.0,
}
TOP_HZ = 9000.0
MODES = ((2, 0), (2, 1), (2, 2), (3, 0), (3, 1))


@cache
def ring():
    """Affine model of the ring."""
    geometry = stator(
        {"shape": "none", "count": 12},
        core={"bore_diameter_mm": 90.0, "length_mm": 110.0, "yoke_thickness_mm": 15.0},
        winding=None,
        frame=None,
        machine=None,
    )
    cells = dict(uniform(1).cells) | {"yoke": 1, "core": 4, "slot": 1, "tooth": 1, "radial": 1}
    return assemble(mesh_step(geometry.step(("stack",)), MeshDensity(cells)))


def keys(**identify):
    """A stage's keys."""
    return StageKeys.model_validate({"name": "stack", "kind": "stack", "mass_kg": 2.3, "identify": identify})


def space(**identify):
    """Parameter space of the ring with typical priors."""
    density = RegionDensity("stack", "lamination", 2.3, 3e-4, 7700.0, 10.0)
    return stage_space(
        keys(**identify), LAMINATION, frozenset({"lamination"}), {"lamination": density}, Carried(), {}
    )


@cache
def reduced():
    """Reduced stator of the ring's orders 2 and 3."""
    training = training_materials(space(), LAMINATION, 32)
    box = material_box(training, ring().mesh.regions)
    problems = [reduce_harmonic(ring(), h, box, TOP_HZ) for h in problems_of(ring().mesh, set(MODES))]
    return reduced_stator(ring(), box, problems, 1.3 * TOP_HZ, training[0])


@cache
def truth_modes():
    """Name → frequency of the full model at the truth."""
    modes = solve_free(ring(), LAMINATION.of(TRUTH), TOP_HZ, (2, 3)).modes
    found = {}
    for mode in modes:
        if mode.order is not None:
            found.setdefault((mode.order, mode.axial), mode.frequency_hz)
    return found


def measured(names=MODES, *, factor=1.0, labelled=True, sd=1e-3, noise=None):
    """Modal table of the truth."""
    noise = np.zeros(len(names)) if noise is None else noise
    rows = []
    for number, (name, error) in enumerate(zip(names, noise, strict=True), start=1):
        f = truth_modes()[name] * factor * (1 + error)
        order, axial = name if labelled else (None, None)
        rows.append(MeasuredMode(number, None, f, sd * f, 0.004, order, axial))
    return tuple(rows)


def problem(modes=None, *, error=None, **identify):
    """The ring's least-squares problem."""
    modes = measured() if modes is None else modes
    return StageProblem(space(**identify), LAMINATION, reduced(), modes, error or ModelError())


def steel(density=7700.0, factor=1.0):
    """An ordinary material of the ring."""
    values = TRUTH | {name: TRUTH[name] * factor for name in ("lamination.E_p_pa", "lamination.G_rz_pa")}
    found = LAMINATION.of(values)["lamination"]
    return {"lamination": Material(found.hooke, density)}
