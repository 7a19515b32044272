"""What another dimension does to the frequencies: the modes' Ritz values on the mesh of the changed machine.

The mesh of a slightly changed machine has the same cells, so that the modes of the declared one are good trial vectors
on it; the error of the Ritz values is of second order. The weights stay as typed: densities follow the volumes.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
from scipy.linalg import eigh

from statorhom.diagnose.masses import stage_densities
from statorhom.diagnose.stage_model import StageModel
from statorhom.diagnose.study_model import StudyModel
from statorhom.errors import GeometryError, MassError
from statorhom.geometry.stator import StatorGeometry, StepGeometry, stator_geometry
from statorhom.mesh.extrude import mesh_step
from statorhom.model.affine import Material, assemble
from statorhom.model.convergence import ModeKey

STEP = 0.02  # of ln(dimension), to each side; between and beyond a parabola
_NONE: dict[ModeKey, tuple[float, float]] = {}


def changed_geometry(study: StudyModel, dimensions: Mapping[str, float]) -> StatorGeometry:
    """The machine with other dimensions.

    Raises
    ------
    GeometryError
        If it is impossible.
    """
    file = study.files.geometry
    for key, value in dimensions.items():
        section, name = key.split(".")
        table = getattr(file, section).model_copy(update={name: value})
        file = file.model_copy(update={section: table})
    return stator_geometry(file, study.files.geometry_path)


def step_of(study: StudyModel, stage: StageModel, geometry: StatorGeometry) -> StepGeometry:
    """A stage of a changed machine."""
    return geometry.step(tuple(s.kind for s in study.files.study.stages[: stage.setup.index + 1]))


def typed(study: StudyModel, key: str) -> float:
    """A dimension as the geometry file has it."""
    section, name = key.split(".")
    return float(getattr(getattr(study.files.geometry, section), name))


def dimension_shift(
    study: StudyModel, stage: StageModel, dimensions: Mapping[str, float], key: ModeKey
) -> float:
    """Change of ln f of a mode by true dimensions ("section.key" → value)."""
    total = 0.0
    for name, value in dimensions.items():
        slope, curvature = _parabola(study, stage, name).get(key, (0.0, 0.0))
        t = float(np.log(value / typed(study, name)))
        total += slope * t + curvature * t**2
    return total


@lru_cache(maxsize=256)
def _parabola(study: StudyModel, stage: StageModel, name: str) -> Mapping[ModeKey, tuple[float, float]]:
    try:
        low, high = (_shifts(study, stage, name, sign * STEP) for sign in (-1, 1))
    except (GeometryError, MassError):
        return _NONE
    return {
        key: ((high[key] - low[key]) / (2 * STEP), (high[key] + low[key]) / (2 * STEP**2))
        for key in low.keys() & high.keys()
    }


def _shifts(study: StudyModel, stage: StageModel, name: str, log_change: float) -> dict[ModeKey, float]:
    value = typed(study, name) * float(np.exp(log_change))
    step = step_of(study, stage, changed_geometry(study, {name: value}))
    mesh = mesh_step(step, stage.density)
    if mesh.nodes.shape != stage.model.mesh.nodes.shape:
        return {}
    masses = {s.name: s.mass_kg for s in study.files.study.stages}
    volumes = step.exact_volumes()
    density = stage_densities(study.files, masses, stage.setup.index, volumes)
    before = stage_densities(study.files, masses, stage.setup.index, study.volumes(stage.setup))
    materials = {}
    for region, material in stage.reference.items():
        weighed = "winding" if region == "overhang" else region
        factor = density.get(weighed, 1.0) / before.get(weighed, 1.0)
        materials[region] = Material(material.hooke, material.density * factor)
    model = assemble(mesh)
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
