"""A stage as the engineer believes it to be, on the true stator's kind of mesh, with the true constants."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from statorhom.conceal.ground import truth_mesh
from statorhom.conceal.truth import Case, TrueMaterial
from statorhom.errors import MaterialError
from statorhom.geometry.stator import stator_geometry
from statorhom.materials.density import REGION_OF_STEP, Weighing, densities
from statorhom.materials.symmetry import SYMMETRIES, constant_names
from statorhom.materials.typical import prior_range
from statorhom.materials.typical_ranges import Z95
from statorhom.mesh import MeshDensity, mesh_step
from statorhom.model.affine import AffineModel, Material, Materials, assemble, hooke_coefficients
from statorhom.model.assembly import HOOKE_ENTRIES
from statorhom.model.free_modes import FreeModes, solve_free
from statorhom.model.stator_mode import StatorMode
from statorhom.study.geometry_file import GeometryFile
from statorhom.study.study_file import StudyFile

STEP = 1e-4  # relative, for derivatives by constants

Key = tuple[int, int, int]


@dataclass(frozen=True, eq=False)
class DeclaredStage:
    """The typed geometry and weights, and the true constants as far as the declared symmetry has them.

    Parameters
    ----------
    model, materials : of the half pitch.
    constants : region → its source's name, which tells steps apart, symmetry and constants.
    spreads : "source.constant" → standard deviation of its logarithm before any measurement, of what is typical.
    """

    model: AffineModel
    materials: Materials
    constants: Mapping[str, tuple[str, str, Mapping[str, float]]]
    spreads: Mapping[str, float]

    def changed(self, changes: Mapping[str, float]) -> DeclaredStage:
        """With other constants.

        Parameters
        ----------
        changes : "source.constant" → change of its logarithm; what is not there stays.

        Raises
        ------
        StatorhomError
            If no material has such constants.
        """
        constants, materials = {}, {}
        for region, (source, symmetry, values) in self.constants.items():
            moved = {n: v * float(np.exp(changes.get(f"{source}.{n}", 0.0))) for n, v in values.items()}
            constants[region] = source, symmetry, moved
            materials[region] = Material(
                SYMMETRIES[symmetry](**moved).hooke(), self.materials[region].density
            )
        return replace(self, materials=materials, constants=constants)

    def modes(self, orders: Sequence[int], highest_hz: float) -> DeclaredModes:
        """Named modes of some orders."""
        return DeclaredModes(self, solve_free(self.model, self.materials, highest_hz, orders))


@dataclass(frozen=True, eq=False)
class DeclaredModes:
    """Modes by (r, n, how many of this name lie below)."""

    stage: DeclaredStage
    found: FreeModes

    @cached_property
    def named(self) -> Mapping[Key, StatorMode]:
        """All that the surface shows."""
        counts: dict[tuple[int, int], int] = defaultdict(int)
        named = {}
        for mode in self.found.modes:
            if mode.order is not None and mode.axial is not None:
                named[mode.order, mode.axial, counts[mode.order, mode.axial]] = mode
                counts[mode.order, mode.axial] += 1
        return named

    @cached_property
    def frequencies_hz(self) -> Mapping[Key, float]:
        """Of the named modes."""
        return {key: mode.frequency_hz for key, mode in self.named.items()}

    def slopes(self, keys: Sequence[Key]) -> dict[str, np.ndarray]:
        """Constant → ∂ ln f/∂ ln p of some modes, by their strain energies."""
        stage = self.stage
        shapes = [self.found.shape(self.named[key]) for key in keys]
        K = stage.model.stiffness_matrix(stage.materials)
        energy = np.array([np.real(np.vdot(u, K @ u)) for u in shapes])
        columns: dict[str, np.ndarray] = {}
        for region, (source, symmetry, values) in stage.constants.items():
            terms = [stage.model.stiffness_term(region, q) for q in range(len(HOOKE_ENTRIES))]
            parts = np.array([[np.real(np.vdot(u, term @ u)) for term in terms] for u in shapes])
            for name, value in values.items():
                slope = parts @ _hooke_slope(symmetry, values, name, value) / energy / 2
                columns[f"{source}.{name}"] = columns.get(f"{source}.{name}", 0.0) + slope
        return columns


def _hooke_slope(symmetry: str, values: Mapping[str, float], name: str, value: float) -> np.ndarray:
    """Derivative of the Hooke entries by a constant's logarithm; at the edge of what materials exist, to its inside."""
    ends = []
    for step in (STEP, -STEP):
        try:
            moved = SYMMETRIES[symmetry](**{**values, name: value * (1 + step)})
        except MaterialError:
            moved, step = SYMMETRIES[symmetry](**values), 0.0
        ends.append((step, hooke_coefficients(moved.hooke())))
    (above, high), (below, low) = ends
    return np.asarray((high - low) / (above - below))


def declared_stage(case: Case, index: int, density: MeshDensity | None) -> DeclaredStage:
    """The stage as its files say.

    Raises
    ------
    StatorhomError
        If no stator can be as they say.
    """
    study = StudyFile.model_validate({**case.study, "geometry": "typed"})
    geometry = stator_geometry(GeometryFile.model_validate(case.geometry_file), Path("typed"))
    stages = study.stages[: index + 1]
    step = geometry.step(tuple(stage.kind for stage in stages))
    weights = [Weighing(s.name, s.kind, s.mass_kg, s.mass_sd_kg) for s in stages]
    typed = {d.region: d.density_kg_m3 for d in densities(weights, step.exact_volumes())}
    model = assemble(mesh_step(step, density or truth_mesh(case.stages[index])))
    constants, materials = {}, {}
    spreads: dict[str, float] = {}
    for region in model.mesh.regions:
        source = region if study.symmetry(index, region) is not None else "winding"
        symmetry = str(study.symmetry(index, source))
        values = _as_declared(symmetry, case.stages[index].materials[source])
        weighed = "winding" if source == "overhang" else source
        last = [stage for stage in stages if REGION_OF_STEP[stage.kind] == weighed][-1]
        constants[region] = f"{source} ({last.name})", symmetry, values
        spreads |= {f"{source} ({last.name}).{n}": _spread(weighed, last.kind, symmetry, n) for n in values}
        materials[region] = Material(SYMMETRIES[symmetry](**values).hooke(), typed[weighed])
    return DeclaredStage(model, materials, constants, spreads)


def _spread(region: str, kind: str, symmetry: str, constant: str) -> float:
    known = prior_range(region, kind, symmetry, constant)
    return float(np.log(known.high90 / known.low90) / (2 * Z95))


def _as_declared(symmetry: str, true: TrueMaterial) -> dict[str, float]:
    names = constant_names(symmetry)
    if symmetry == true.symmetry:
        return dict(true.constants)
    in_plane = next(true.constants[n] for n in ("E_p_pa", "E_pa", "E_r_pa") if n in true.constants)
    poisson = next(true.constants[n] for n in ("nu_p", "nu", "nu_rt") if n in true.constants)
    return {
        n: in_plane if n.startswith("E") else poisson if n.startswith("nu") else in_plane / 2.6 for n in names
    }
