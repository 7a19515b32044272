"""The free modes of a machine with another dimension, and which of them are those of the machine before.

The mesh of a changed machine has the same cells, so that shapes can be compared node by node. Names would not do: two
modes of one order change places as the machine grows longer, and each keeps its shape, not its rank.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.linalg import eigh
from scipy.optimize import linear_sum_assignment

from statorhom.diagnose.stages.masses import stage_densities
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.diagnose.stages.study_model import StudyModel
from statorhom.geometry.stator import StepGeometry
from statorhom.geometry.tested_object import RingGeometry, object_geometry
from statorhom.mesh.extrude import mesh_step
from statorhom.model.affine import AffineModel, Material, Materials, assemble
from statorhom.model.convergence import ModeKey, mode_keys
from statorhom.model.free_modes import FreeModes, problem_at
from statorhom.physics.ring import tube_sizes

HIGHER = 1.1  # than the declared machine's band: its modes rise as they are changed
MOST = 6  # modes of a harmonic problem that are looked for
ALIKE = 0.7  # correlation of shapes, from which on a mode is another machine's

Place = tuple[int, int]  # problem and column (`StatorMode.place`)


@dataclass(frozen=True, eq=False)
class SolvedMachine:
    """Free modes of a machine.

    Parameters
    ----------
    modes : of all harmonics that the step is predicted in.
    mass : mass matrix of the half pitch.
    """

    modes: FreeModes
    mass: sp.csr_array

    @property
    def logs(self) -> Mapping[Place, float]:
        """ln f of every mode."""
        return {m.place: float(np.log(m.frequency_hz)) for m in self.modes.modes}

    @property
    def named(self) -> Mapping[ModeKey, Place]:
        """Places of the modes with names."""
        return {key: mode.place for key, mode in mode_keys(self.modes.modes).items()}


def changed_geometry(study: StudyModel, dimensions: Mapping[str, float]) -> RingGeometry:
    """The machine with other dimensions ("section.key" → value).

    Raises
    ------
    GeometryError
        If it is impossible.
    """
    file = study.files.drawing
    for key, value in dimensions.items():
        section, name = key.split(".")
        table = getattr(file, section).model_copy(update={name: value})
        file = file.model_copy(update={section: table})
    changed = object_geometry(file, study.files.geometry_path)
    assert isinstance(changed, RingGeometry)
    return changed


def step_of(study: StudyModel, stage: StageModel, geometry: RingGeometry) -> StepGeometry:
    """A stage of a changed machine."""
    return geometry.step(tuple(s.kind for s in study.files.study.stages[: stage.setup.index + 1]))


def typed(study: StudyModel, key: str) -> float:
    """A dimension as the geometry file has it."""
    section, name = key.split(".")
    return float(getattr(getattr(study.files.drawing, section), name))


def scaled(study: StudyModel, name: str) -> float:
    """Part of a dimension that steps are parts of."""
    number, part = tube_sizes(study.files).get(name.partition(".")[2], (1.0, 1.0))
    return abs(part) / number


def changed_model(
    study: StudyModel, stage: StageModel, name: str, log_change: float
) -> tuple[AffineModel, Materials]:
    """The mesh of the changed machine, and the reference's materials at the densities that it has.

    Raises
    ------
    GeometryError, MassError
        If it is impossible.
    """
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


def solved_machine(study: StudyModel, stage: StageModel, name: str, log_change: float) -> SolvedMachine:
    """The changed machine's modes.

    Raises
    ------
    GeometryError, MassError
        If it is impossible.
    """
    problem = problem_at(*changed_model(study, stage, name, log_change))
    return SolvedMachine(problem.solve(HIGHER * stage.ring.highest_hz, stage.orders, MOST), problem.M)


def followed(
    before: SolvedMachine, places: Mapping[ModeKey, Place], after: SolvedMachine
) -> dict[ModeKey, Place]:
    """Places of the same modes in a machine that differs a little; without those that are no mode's there."""
    same: dict[Place, Place] = {}
    if before.mass.shape != after.mass.shape:
        return {}
    for number, own, theirs in zip(
        range(len(before.modes.shapes)), before.modes.shapes, after.modes.shapes, strict=True
    ):
        alike = _correlation(own, theirs, before.mass)
        for i, j in zip(*linear_sum_assignment(-alike), strict=True):
            if alike[i, j] > ALIKE:
                same[number, int(i)] = number, int(j)
    return {key: same[place] for key, place in places.items() if place in same}


def ritz_shifts(
    before: SolvedMachine, places: Mapping[ModeKey, Place], model: AffineModel, materials: Materials
) -> dict[ModeKey, float]:
    """Change of ln f of Ritz values with the modes of a machine as trial vectors on another mesh of its cells."""
    K, M = model.stiffness_matrix(materials), model.mass_matrix(materials)
    if M.shape != before.mass.shape:
        return {}
    found = {}
    for number, shapes in enumerate(before.modes.shapes):
        own = {key: column for key, (problem, column) in places.items() if problem == number}
        for key, log_f in ritz_logs(shapes, own, K, M).items():
            found[key] = log_f - before.logs[places[key]]
    return found


def ritz_logs(
    shapes: np.ndarray, columns: Mapping[ModeKey, int], K: sp.csr_array, M: sp.csr_array
) -> dict[ModeKey, float]:
    """ln f of the Ritz values of a problem's half-pitch shapes (3 n, k), by the modes whose columns they are."""
    if not columns:
        return {}
    values, x = eigh(*(np.real(np.conj(shapes.T) @ (A @ shapes)) for A in (K, M)))
    same = {key: int(np.argmax(np.abs(x[column]))) for key, column in columns.items()}
    return {key: float(0.5 * np.log(values[i]) - np.log(2 * np.pi)) for key, i in same.items()}


def _correlation(own: np.ndarray, theirs: np.ndarray, mass: sp.csr_array) -> np.ndarray:
    """Of shapes (3 n, k) and (3 n, l) with a mass matrix, 0 … 1."""
    norms = [np.sqrt(np.real(np.sum(np.conj(s) * (mass @ s), axis=0))) for s in (own, theirs)]
    return np.abs(np.real(np.conj(own.T) @ (mass @ theirs))) / np.outer(*norms)
