"""What another dimension does to the frequencies.

The mesh of a slightly changed machine has the same cells, so that the modes of the declared one are good trial vectors
on it: their Ritz values give the slopes. How a frequency goes on beyond a small change is solved on the changed mesh,
when that is first asked for. The weights stay as typed: densities follow the volumes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from scipy.linalg import eigh

from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.stages.masses import stage_densities
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.diagnose.stages.study_model import StudyModel
from statorhom.errors import GeometryError, MassError
from statorhom.geometry.stator import StepGeometry
from statorhom.geometry.tested_object import RingGeometry, object_geometry
from statorhom.mesh.extrude import mesh_step
from statorhom.model.affine import AffineModel, Material, Materials, assemble
from statorhom.model.convergence import ModeKey, mode_keys
from statorhom.model.free_modes import problem_at
from statorhom.physics.ring import tube_sizes
from statorhom.study.object_file import ObjectFile

# of ln(dimension), to each side, for the slopes; of a tube's wall where a diameter bounds it. A thin wall that is drawn
# thinner with its nodes shears, and Ritz values are off by the square of that.
STEP = 0.001
FAR = 0.03  # the same for changed machines that are solved, with a cubic through them
HIGHER = 1.1  # than the declared machine's band: its modes rise as they are changed
MOST = 6  # modes of a harmonic problem that are looked for
JUMP = 0.01  # of ln f: farther from its slope a mode is another one


def changed_geometry(study: StudyModel, dimensions: Mapping[str, float]) -> RingGeometry:
    """The machine with other dimensions.

    Raises
    ------
    GeometryError
        If it is impossible.
    """
    changed = object_geometry(changed_drawing(study, dimensions), study.files.geometry_path)
    assert isinstance(changed, RingGeometry)
    return changed


def changed_drawing(study: StudyModel, dimensions: Mapping[str, float]) -> ObjectFile:
    """Its geometry file ("section.key" → value)."""
    file = study.files.drawing
    for key, value in dimensions.items():
        section, name = key.split(".")
        table = getattr(file, section).model_copy(update={name: value})
        file = file.model_copy(update={section: table})
    return file


def step_of(study: StudyModel, stage: StageModel, geometry: RingGeometry) -> StepGeometry:
    """A stage of a changed machine."""
    return geometry.step(tuple(s.kind for s in study.files.study.stages[: stage.setup.index + 1]))


def typed(study: StudyModel, key: str) -> float:
    """A dimension as the geometry file has it."""
    section, name = key.split(".")
    return float(getattr(getattr(study.files.drawing, section), name))


def dimension_shift(
    study: StudyModel,
    stage: StageModel,
    dimensions: Mapping[str, float],
    key: ModeKey,
    *,
    proportional: bool = False,
) -> float:
    """Change of ln f of a mode by true dimensions ("section.key" → value), or its slope's part alone."""
    total = 0.0
    for name, value in dimensions.items():
        t = float(np.log(value / typed(study, name)))
        total += _slopes(study, stage, name).get(key, 0.0) * t
        if not proportional:
            square, cube = _bends(study, stage, name).get(key, (0.0, 0.0))
            total += square * t**2 + cube * t**3
    return total


def scaled(study: StudyModel, name: str) -> float:
    """Part of a dimension that steps are parts of."""
    number, part = tube_sizes(study.files).get(name.partition(".")[2], (1.0, 1.0))
    return abs(part) / number


def _slopes(study: StudyModel, stage: StageModel, name: str) -> Mapping[ModeKey, float]:
    """Coefficients of ln(dimension) in ln f."""
    return stage.memory.once(("slopes", name), lambda: _made_slopes(study, stage, name))


def _bends(study: StudyModel, stage: StageModel, name: str) -> Mapping[ModeKey, tuple[float, float]]:
    """Coefficients of its square and its cube."""
    return stage.memory.once(("bends", name), lambda: _made_bends(study, stage, name))


def _made_slopes(study: StudyModel, stage: StageModel, name: str) -> dict[ModeKey, float]:
    try:
        # the Ritz values' own errors, of second order, cancel
        step = STEP * scaled(study, name)
        low, high = _on_both_sides(stage, lambda sign: _shifts(study, stage, name, sign * step))
    except (GeometryError, MassError):
        return {}
    return {key: (high[key] - low[key]) / (2 * step) for key in low.keys() & high.keys()}


def _made_bends(study: StudyModel, stage: StageModel, name: str) -> dict[ModeKey, tuple[float, float]]:
    slopes = _slopes(study, stage, name)
    try:
        far = FAR * scaled(study, name)
        low, high = _on_both_sides(stage, lambda sign: _solved(study, stage, name, sign * far))
    except (GeometryError, MassError):
        return {}
    found = {}
    for key in slopes.keys() & low.keys() & high.keys():
        rest = [shift - slopes[key] * t for shift, t in ((low[key], -far), (high[key], far))]
        if max(map(abs, rest)) < JUMP:
            found[key] = (sum(rest) / (2 * far**2), (rest[1] - rest[0]) / (2 * far**3))
    return found


def _on_both_sides(
    stage: StageModel, changes: Callable[[int], dict[ModeKey, float]]
) -> list[dict[ModeKey, float]]:
    """Changes of ln f by less and by more of a dimension."""
    return side_by_side(changes, (-1, 1), list(stage.reference_keys))


def _solved(study: StudyModel, stage: StageModel, name: str, log_change: float) -> dict[ModeKey, float]:
    """Change of ln f on the changed mesh."""
    model, materials = _changed(study, stage, name, log_change)
    top = HIGHER * stage.ring.highest_hz
    after = mode_keys(problem_at(model, materials).solve(top, stage.orders, MOST).modes)
    before = stage.reference_keys
    return {k: float(np.log(after[k].frequency_hz / before[k].frequency_hz)) for k in before.keys() & after}


def _changed(
    study: StudyModel, stage: StageModel, name: str, log_change: float
) -> tuple[AffineModel, Materials]:
    """The mesh of the changed machine, and the reference's materials at the densities that it has."""
    value = typed(study, name) * float(np.exp(log_change))
    step = step_of(study, stage, changed_geometry(study, {name: value}))
    masses = {s.name: s.mass_kg for s in study.files.study.stages}
    density = stage_densities(study.files, masses, stage.setup.index, step.exact_volumes())
    before = stage_densities(study.files, masses, stage.setup.index, study.volumes(stage.setup))
    materials = {}
    for region, material in stage.reference.items():
        weighed = "winding" if region == "overhang" else region
        factor = density.get(weighed, 1.0) / before.get(weighed, 1.0)
        materials[region] = Material(material.hooke, material.density * factor)
    return assemble(mesh_step(step, stage.density)), materials


def _shifts(study: StudyModel, stage: StageModel, name: str, log_change: float) -> dict[ModeKey, float]:
    """Change of the Ritz values' ln f; none where the changed mesh has other cells."""
    model, materials = _changed(study, stage, name, log_change)
    if model.mesh.nodes.shape != stage.model.mesh.nodes.shape:
        return {}
    K, M = model.stiffness_matrix(materials), model.mass_matrix(materials)
    found = {}
    solved = stage.solve(stage.reference)
    for number, problem in enumerate(stage.ring.problems):
        space, vectors = problem.space, solved.vectors[number]
        own = [(k, m) for k, m in stage.reference_keys.items() if m.problem == number]
        if not own:
            continue
        chosen = problem.basis @ vectors
        real, imaginary = space.real @ chosen, space.imaginary @ chosen
        new = [space.copies * (real.T @ (A @ real) + imaginary.T @ (A @ imaginary)) for A in (K, M)]
        values, x = eigh(*new)
        for key, mode in own:
            same = int(np.argmax(np.abs(x[mode.column])))
            found[key] = 0.5 * float(np.log(values[same])) - float(np.log(2 * np.pi * mode.frequency_hz))
    return found
