"""Every effect's signature, as the diagnosis computes it, against finite differences of the full model."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from small_stage import stage_of
from small_stators import MATERIALS

from statorhom.diagnose.bases.ring_basis import ring_basis
from statorhom.diagnose.features.mode_features import loading, shift_features
from statorhom.diagnose.features.supported import predicted_logs, supported_test
from statorhom.diagnose.measured.measured_test import PlaneShifts
from statorhom.diagnose.predicted.prediction import material_vector, predicted
from statorhom.diagnose.predicted.sensor_response import sensor_response
from statorhom.diagnose.stages.broken_response import responses
from statorhom.diagnose.stages.dimension_response import _shifts, changed_geometry, dimension_shift, step_of
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.diagnose.stages.study_model import StudyModel
from statorhom.geometry.stator import stator_geometry
from statorhom.identify.residuals.model_error import ModelError
from statorhom.identify.stages.stage_setup import stage_setup
from statorhom.materials.hooke import Hooke
from statorhom.mesh import mesh_step, uniform
from statorhom.model.affine import Material, Materials, assemble
from statorhom.model.broken.attachments import lump
from statorhom.model.broken.basis import symmetric_basis
from statorhom.model.broken.solve import solve_broken
from statorhom.model.convergence import ModeKey, mode_keys
from statorhom.model.free_modes import solve_free
from statorhom.model.supported_modes import solve_supported
from statorhom.model.supports import support_on
from statorhom.physics.candidate import Candidate
from statorhom.physics.library import library
from statorhom.study.study import StudyFiles, load_study
from statorhom.study.supports import SupportKeys

TOP = 5000.0
KEYS = ((2, 0, 0), (2, 1, 0), (3, 0, 0))
GEOMETRY = """\
schema = 1
name = "small"
core = { outer_diameter_mm = 120.0, bore_diameter_mm = 70.0, length_mm = 80.0, yoke_thickness_mm = 9.0 }
slots = { count = 12, shape = "parallel_tooth", tooth_width_mm = 12.0 }
winding = { overhang_length_mm = 20.0 }
"""
STUDY = """\
schema = 1
name = "small"
geometry = "small.toml"
[[supports]]
name = "clamped"
kind = "lines"
angles_deg = [150.0, 210.0]
declared = "rigid"
[[stages]]
name = "stack"
kind = "stack"
mass_kg = 3.0
model = { lamination = "transversely_isotropic" }
tests = [
  { name = "free", support = "free", modal_table = "modes.csv" },
  { name = "held", support = "clamped", modal_table = "modes.csv" },
]
[[stages]]
name = "wound"
kind = "wound"
mass_kg = 4.2
model = { winding = "transversely_isotropic" }
tests = [{ name = "wound-free", support = "free", modal_table = "modes.csv" }]
"""


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> StudyFiles:
    return study_in(tmp_path_factory.mktemp("study"))


def study_in(folder: Path) -> StudyFiles:
    (folder / "small.toml").write_text(GEOMETRY)
    (folder / "study.toml").write_text(STUDY)
    (folder / "modes.csv").write_text("frequency_hz,order,axial\n1400,2,0\n1900,2,1\n3700,3,0\n")
    return load_study(folder / "study.toml")


@pytest.fixture(scope="module")
def stack() -> StageModel:
    return stage_of(("stack",), TOP)


@pytest.fixture(scope="module")
def wound() -> StageModel:
    return stage_of(("stack", "wound"), TOP)


def candidate(files: StudyFiles, effect: str, stage: str) -> Candidate:
    return next(c for c in library()[effect].candidates(files) if c.stage == stage)


def values_of(one: Candidate, **given: float) -> dict[str, float]:
    """Places off every symmetry plane, magnitudes at their first start or as given."""
    found = {"angle_rad": 0.35, "z_m": 0.055} | {p.name: p.starts[0] for p in one.parameters if p.starts}
    return {p.name: (found | given)[p.name] for p in one.parameters}


@pytest.mark.parametrize(
    ("effect", "name", "absent"),
    [
        ("end_winding_stiffness", "stiffness_ratio", 1.0),
        ("loose_winding_mass", "participating_fraction", 0.98),
        ("temperature_shift", "temperature_k", 0.0),
    ],
)
def test_changed_materials(
    effect: str, name: str, absent: float, files: StudyFiles, wound: StageModel
) -> None:
    stage = wound
    one = candidate(files, effect, stage.name)
    step = 0.5 if name == "temperature_k" else 0.01 * absent
    ends = []
    for value in (absent - step, absent + step):
        rule = library()[effect].action(one, values_of(one, **{name: value}), files).materials
        assert rule is not None
        ends.append(rule(stage.reference))
    regions = tuple(stage.reference)
    change = material_vector(ends[1], regions) - material_vector(ends[0], regions)
    slopes = stage.reference_slopes(KEYS)
    full = [mode_keys(solve_free(stage.model, m, TOP, range(4)).modes) for m in ends]
    for key in KEYS:
        exact = np.log(full[1][key].frequency_hz / full[0][key].frequency_hz)
        assert slopes[key] @ change == pytest.approx(exact, rel=0.03, abs=1e-6)


@pytest.mark.parametrize(
    ("effect", "given", "part"),
    [
        ("attached_mass", {"mass_kg": 0.03}, 0.1),
        ("local_stiffness", {"stiffness_ratio": 0.7}, 0.1),
        ("local_stiffness", {"stiffness_ratio": 0.35, "angle_rad": 1.9}, 0.1),
        ("local_stiffness", {"stiffness_ratio": 2.2}, 0.1),
        ("stack_pressure_gradient", {"G_rz_end_ratio": 0.5}, 0.1),
        ("stack_pressure_gradient", {"G_rz_end_ratio": 2.5}, 0.1),
        ("ovality", {}, 0.1),
        ("suspension_stiffness", {"stiffness_n_per_m": 1e6}, 0.1),
    ],
)
def test_broken_symmetry(
    effect: str, given: dict[str, float], part: float, files: StudyFiles, stack: StageModel
) -> None:
    """Both lines of the doublets against the basis enriched until its error is a hundredth of a per cent."""
    one = candidate(files, effect, "stack")
    action = library()[effect].action(one, values_of(one, **given), files)
    assert action.changes is not None
    changes = action.changes(stack.model.mesh, stack.reference)
    found = responses(stack, changes, [] if action.training is None else [action.training])
    full = solve_broken(symmetric_basis(stack.model, stack.reference, TOP), changes, tolerance=1e-4)
    for key in KEYS[:2]:
        before = stack.reference_keys[key].frequency_hz
        mean = before * np.exp(found[key].shift)
        lines = mean * np.sqrt(1 + np.array([-0.5, 0.5]) * abs(found[key].split))
        near = np.array([full.frequencies_hz[np.argmin(np.abs(full.frequencies_hz - f))] for f in lines])
        size = max(np.abs(near - before))
        assert lines == pytest.approx(near, abs=part * size + 1e-4 * before)


def test_a_sensor_loads_the_mode_whose_antinode_it_sits_on(stack: StageModel) -> None:
    mesh, mass, z = stack.model.mesh, 0.002, 0.02
    found = responses(stack, [lump(mesh, 0.4, z, mass)])
    test = SimpleNamespace(shifts=[SimpleNamespace(z_m=np.array([z]))])
    for key in KEYS:
        lower = found[key].shift + 0.5 * np.log1p(-0.5 * abs(found[key].split))
        assert loading(test, key, sensor_response(stack, [z]), mass) == pytest.approx(-lower, rel=0.03)  # type: ignore[arg-type]


def test_a_sensor_moves_the_poles_from_plane_to_plane(stack: StageModel) -> None:
    mesh, mass, key = stack.model.mesh, 0.004, (2, 1, 0)
    places = np.array([0.01, 0.03, 0.06])
    exact = []
    for z in places:
        one = responses(stack, [lump(mesh, 0.4, z, mass)])[key]
        exact.append(one.shift + 0.5 * np.log1p(-0.5 * abs(one.split)))
    rest = np.array(exact) - np.mean(exact)
    seen = PlaneShifts("1", places, rest, np.full(3, 1e-6), 0.0)
    test = SimpleNamespace(name="free", shifts=(seen,))
    response = sensor_response(stack, places.tolist())
    assert sensor_response(stack, places.tolist()) is response
    found = shift_features(test, {"1": key}, response, mass)  # type: ignore[arg-type]
    assert [f.predicted for f in found] == pytest.approx(rest, abs=0.01 * np.ptp(rest))


@pytest.mark.parametrize("stiffness", [1.1e9, 1.1e10, 1.1e11])
def test_an_elastic_support(stiffness: float, files: StudyFiles, stack: StageModel) -> None:
    """Frequencies on its springs, and how they follow the stiffness of the springs and of the core."""
    one = candidate(files, "support_compliance", "stack")
    # the lowest modes alone: the rest of the band is not solved
    band = (SimpleNamespace(frequency_hz=stack.ring.highest_hz / 3),)
    test = SimpleNamespace(name="held", support="clamped", shapes=None, modes=band)
    before = stack.reference["lamination"]
    hooke = before.hooke.matrix.copy()
    hooke[3, 3] *= 1.1
    hooke[4, 4] *= 1.1
    others = (
        Material(Hooke(1.1 * before.hooke.matrix), before.density),
        Material(Hooke(hooke), before.density),
        Material(before.hooke, 1.1 * before.density),
    )
    logs, exact = [], []
    for per_metre in (0.8 * stiffness, stiffness):
        given = values_of(one, normal_stiffness_n_per_m2=per_metre)
        action = library()["support_compliance"].action(one, given, files)
        reference = supported_test(files, stack, test, [action], (per_metre,))  # type: ignore[arg-type]
        assert reference is not None
        logs.append(reference.log_f[:5])
        exact.append(log_supported(stack, action.supports["clamped"], stack.reference))
    for found, full in zip(logs, exact, strict=True):
        assert found == pytest.approx(full, abs=2e-3)
    assert logs[1] - logs[0] == pytest.approx(exact[1] - exact[0], rel=0.03, abs=1e-4)
    for other in others:
        materials = {"lamination": other}
        free = mode_keys(stack.solve(materials).modes)
        modes = {key: SimpleNamespace(log_f=np.log(m.frequency_hz)) for key, m in free.items()}
        moved = np.sort(predicted_logs(stack, reference, modes, materials))[:5]  # type: ignore[arg-type]
        full = log_supported(stack, action.supports["clamped"], materials)
        assert moved - logs[1] == pytest.approx(full - exact[1], rel=0.05, abs=1e-3)


def log_supported(stage: StageModel, keys: SupportKeys, materials: Materials) -> np.ndarray:
    support = support_on(stage.model.mesh, keys)
    return np.log(solve_supported(stage.model, materials, support, 3000.0).frequencies_hz[:5])


def test_a_modulus_that_follows_the_frequency(files: StudyFiles, wound: StageModel) -> None:
    one = candidate(files, "viscoelastic_winding", "wound")
    action = library()["viscoelastic_winding"].action(one, values_of(one), files)
    study = SimpleNamespace(
        masses=lambda *_: {},
        materials=lambda stage, *_: stage.reference,
    )
    found = predicted(study, wound, {"wound:mesh": 0.0}, [action])  # type: ignore[arg-type]
    for key in ((2, 0, 0),):
        f = wound.reference_keys[key].frequency_hz
        for _ in range(4):
            scaled = {
                r: Material(Hooke(action.modulus_at[r](f) * m.hooke.matrix), m.density)
                if r in action.modulus_at
                else m
                for r, m in wound.reference.items()
            }
            f = mode_keys(solve_free(wound.model, scaled, TOP, [key[0]]).modes)[key].frequency_hz
        assert found[key].frequency_hz == pytest.approx(f, rel=2e-3)
        assert abs(np.log(f / wound.reference_keys[key].frequency_hz)) > 4e-3


TYPED_MM = {"core.yoke_thickness_mm": 9.0, "core.length_mm": 80.0}


@pytest.mark.parametrize("name", TYPED_MM)
def test_another_dimension(name: str, files: StudyFiles) -> None:
    study, stage = stack_alone(files)
    step = 0.01
    logs = [log_of_changed(study, stage, name, sign * step) for sign in (-1, 1)]
    low, high = (_shifts(study, stage, name, sign * step) for sign in (-1, 1))
    # the Ritz values' own errors, of second order, cancel
    for key in KEYS:
        assert high[key] - low[key] == pytest.approx(logs[1][key] - logs[0][key], rel=0.05, abs=1e-4)


@pytest.mark.parametrize("step", [-0.05, 0.012, 0.06])
def test_a_dimension_that_is_far_off(step: float, files: StudyFiles) -> None:
    name = "core.yoke_thickness_mm"
    study, stage = stack_alone(files)
    before, after = (log_of_changed(study, stage, name, t) for t in (0.0, step))
    dimension = {name: TYPED_MM[name] * float(np.exp(step))}
    for key in KEYS:
        shift = after[key] - before[key]
        assert abs(shift) > 5e-3
        assert dimension_shift(study, stage, dimension, key) == pytest.approx(shift, rel=0.02, abs=1e-4)


def stack_alone(files: StudyFiles) -> tuple[StudyModel, StageModel]:
    geometry = stator_geometry(files.geometry, files.geometry_path)
    setup = stage_setup(files, geometry, 0)
    assert setup.step is not None
    model = assemble(mesh_step(setup.step, uniform(1)))
    materials = {"lamination": MATERIALS["lamination"]}
    ring = ring_basis(model, [materials], TOP, range(4))
    stage = StageModel(setup, (), ring, materials, ModelError(), uniform(1))
    return StudyModel(files, geometry, None, (stage,)), stage  # type: ignore[arg-type]


def log_of_changed(study: StudyModel, stage: StageModel, name: str, step: float) -> dict[ModeKey, float]:
    """ln f of the machine with another dimension, solved on its own mesh, its weight as before."""
    value = TYPED_MM[name] * float(np.exp(step))
    changed = step_of(study, stage, changed_geometry(study, {name: value}))
    assert stage.setup.step is not None
    factor = stage.setup.step.exact_volumes()["lamination"] / changed.exact_volumes()["lamination"]
    one = stage.reference["lamination"]
    lighter = {"lamination": Material(one.hooke, factor * one.density)}
    full = mode_keys(solve_free(assemble(mesh_step(changed, uniform(1))), lighter, TOP, range(4)).modes)
    return {key: float(np.log(full[key].frequency_hz)) for key in KEYS}


def test_another_mass_is_another_density(stack: StageModel) -> None:
    slopes = stack.reference_slopes(KEYS)
    one = stack.reference["lamination"]
    change = material_vector({"lamination": Material(one.hooke, 1.01 * one.density)}, ["lamination"])
    change = change - material_vector(stack.reference, ["lamination"])
    for key in KEYS:
        assert slopes[key] @ change == pytest.approx(-0.005, rel=1e-6)


def test_a_strong_gradient_is_in_the_basis_of_its_examples(files: StudyFiles, stack: StageModel) -> None:
    """Where four fifths of the modulus are missing at one end, each part of a weak example alone left 0.1 %."""
    one = candidate(files, "stack_pressure_gradient", "stack")
    action = library()["stack_pressure_gradient"].action(one, {"G_rz_end_ratio": 0.2}, files)
    assert action.training is not None and action.changes is not None
    changes = action.changes(stack.model.mesh, stack.reference)
    found = solve_broken(stack.trained((action.training,)).basis, changes, tolerance=None)
    exact = solve_broken(
        symmetric_basis(stack.model, stack.reference, TOP, margin=1.6), changes, tolerance=5e-5
    )
    error = found.frequencies_hz / exact.frequencies_hz[: len(found.frequencies_hz)] - 1
    assert error.max() < 1e-4
