"""A gradient along the axis is that of the materials as constants make them, against stacks solved whole in layers."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from small_stage import stage_of
from small_stators import pressed_sheets
from template_hypothesis import template_hypothesis

from statorhom.diagnose.features.lean import profile_lean
from statorhom.diagnose.fits import derivatives
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.measured.measured_test import MeasuredTest, Sideband
from statorhom.diagnose.predicted.prediction import broken_responses
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.mesh.density import COARSEST, MeshDensity
from statorhom.model.affine import assemble
from statorhom.model.free_modes import solve_free
from statorhom.model.radial_profile import radial_profile
from statorhom.physics.action import Action
from statorhom.physics.effects.stack_pressure_gradient import StackPressureGradient
from statorhom.physics.library import all_candidates

KEY = (2, 0, 0)
RATIO = 0.5
NU_PZ, OTHER_NU_PZ = 0.26, 0.34
UNEVEN = 1e-7  # of the length: what tells the solver that the two ends differ
FREE = "frequency_hz,order,axial\n1428,2,0\n1766,2,1\n3770,3,0\n"
PLANES = 4
LAYERS = 12  # of elements: few of one material each lean by up to an eighth less than what varies within them


@pytest.fixture(scope="module")
def stage() -> StageModel:
    """A stack on which shapes were measured in four planes."""
    mesh = MeshDensity(COARSEST | {"core": LAYERS})
    bare = stage_of(("stack",), 9000.0, {"lamination": pressed_sheets(nu_pz=NU_PZ)}, mesh)
    shapes: Any = SimpleNamespace(z_m=np.linspace(0.1, 0.9, PLANES) * bare.model.mesh.length)
    return replace(bare, tests=(MeasuredTest(0, "t", "free", (), shapes=shapes),))


def layered_lean(stage: StageModel, nu_pz: float) -> float:
    """Of (2, 0), every layer of elements a material of its own; no basis, and nothing of the effect."""
    mesh = stage.model.mesh
    heights = mesh.nodes[mesh.elements].mean(axis=1)[:, 2] / mesh.length
    layers = np.unique(np.round(heights, 9))
    slope = (RATIO - 1) / (RATIO + 1)
    materials = {f"layer {z}": pressed_sheets(slope * (2 * z - 1), nu_pz) for z in layers.tolist()}
    along = mesh.nodes[:, 2] / mesh.length
    nodes = mesh.nodes + UNEVEN * mesh.length * np.outer(along**2, [0.0, 0.0, 1.0])
    own = np.array([int(np.argmin(np.abs(layers - z))) for z in heights])
    whole = replace(mesh, nodes=nodes, region=own, regions=tuple(materials))
    found = solve_free(assemble(whole), materials, 9000.0, (2,))
    mode = next(m for m in found.modes if (m.order, m.axial) == KEY[:2])
    planes = np.array(stage.heights_m)
    shape = found.shape(mode)[:, None]
    profile = radial_profile(whole, planes).orders(found.harmonics[mode.problem], shape)[:, 0]
    return profile_lean(np.real(profile), planes, planes)


@pytest.fixture(scope="module")
def action(tmp_path_factory: pytest.TempPathFactory, stage: StageModel) -> Action:
    """Of the effect, on the stage's length."""
    h = template_hypothesis(tmp_path_factory.mktemp("template"), {"stack-free.csv": FREE})
    one = next(c for c in all_candidates(h.study.files) if c.effect == "stack_pressure_gradient")
    long: Any = SimpleNamespace(length=stage.model.mesh.length)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("statorhom.physics.effects.stack_pressure_gradient.ring_of", lambda _: long)
        return StackPressureGradient().action(one, {"G_rz_end_ratio": RATIO}, h.study.files)


@pytest.mark.parametrize("nu_pz", [NU_PZ, OTHER_NU_PZ])
def test_a_stack_leans_as_its_layers_do_whatever_poissons_ratio(
    stage: StageModel, action: Action, nu_pz: float
) -> None:
    planes = np.array(stage.heights_m)
    profile = broken_responses(stage, [action], None, {"lamination": pressed_sheets(nu_pz=nu_pz)})[
        KEY
    ].profile
    assert profile is not None
    assert profile_lean(profile, planes, planes) == pytest.approx(layered_lean(stage, nu_pz), rel=0.05)


def test_poissons_ratio_matters(stage: StageModel) -> None:
    """What the reference's gradient would leave out."""
    assert layered_lean(stage, OTHER_NU_PZ) > 1.2 * layered_lean(stage, NU_PZ)


def leaning(folder: Path) -> Hypothesis:
    """A stack with a pressure gradient whose (2, 0) was seen to lean."""
    h = template_hypothesis(folder, {"stack-free.csv": FREE})
    [test] = h.study.stages[0].tests
    z_m = np.linspace(0.1, 0.9, PLANES) * h.study.stages[0].model.mesh.length
    parts = np.zeros((2, 2, 5))
    parts[0, :, 2] = 1.0, 0.02
    shape = Sideband(test.modes[0].label, 2, 0.0, *parts, np.full((2, 5), 1e-3), z_m)
    shapes: Any = SimpleNamespace(z_m=z_m)
    seen = replace(test, shapes=shapes, sidebands=(shape,))
    one = next(c for c in all_candidates(h.study.files) if c.effect == "stack_pressure_gradient")
    return replace(h.with_tests({test.name: seen}), candidates=(one,))


def test_leans_have_slopes_by_the_constants_that_they_follow(tmp_path: Path) -> None:
    h = leaning(tmp_path)
    z = np.r_[np.zeros(h.constants), h.candidates[0].parameters[0].internal(RATIO)]
    paired = h.paired(z)
    [row] = [i for i, f in enumerate(paired.features(z)) if f.kind == "lean"]
    slopes = derivatives.jacobian(paired, z)[row]
    names = list(paired.study.constants.names)
    for name in ("nu_pz", "E_z_pa", "G_rz_pa"):
        j = names.index(f"stack:lamination.{name}")
        step = 2e-3 * np.eye(len(z))[j]
        expected = (paired.residuals(z + step)[row] - paired.residuals(z - step)[row]) / 4e-3
        assert slopes[j] == pytest.approx(expected, rel=0.02)
    # the more sheets widen under pressure, the more their modulus along the axis matters
    assert slopes[names.index("stack:lamination.nu_pz")] != 0.0
