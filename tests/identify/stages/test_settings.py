"""On the mesh that constants are fitted on slender teeth bend, so that the yoke's modes near theirs are right."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from example_stators import PARALLEL_TOOTH, stator
from statorhom.identify.stages.settings import FITTING_MESH
from statorhom.materials.isotropic import Isotropic
from statorhom.mesh import MeshDensity, mesh_step
from statorhom.model.affine import Material, assemble
from statorhom.model.convergence import mode_keys
from statorhom.model.free_modes import problem_at

# where the yoke of this stack moves its surface less and less, for its teeth bend
NEAR_TEETH = ((4, 0, 0), (5, 0, 0))
TOP = 8000.0


def near_teeth(density: MeshDensity) -> np.ndarray:
    """ln of frequencies (Hz) and of visibilities."""
    model = assemble(mesh_step(stator(PARALLEL_TOOTH).step(("stack",)), density))
    steel = {"lamination": Material(Isotropic(200e9, 0.3).hooke(), 7700.0)}
    modes = mode_keys(problem_at(model, steel).solve(TOP, (4, 5)).modes)
    return np.log([[modes[key].frequency_hz, modes[key].visibility] for key in NEAR_TEETH])


def test_teeth_bend_on_the_fitting_mesh() -> None:
    finest = near_teeth(FITTING_MESH.refined(2.0))
    error = np.abs(near_teeth(FITTING_MESH) - finest)
    stiff = np.abs(near_teeth(replace(FITTING_MESH, bare={})) - finest)
    assert np.all(error[:, 0] < 0.02)
    assert np.all(error[:, 1] < 0.06)
    assert np.all(stiff > 2 * error)
