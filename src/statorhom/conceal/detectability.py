"""How much an effect leaves behind that no refit of the declared model's constants explains.

Frequencies only, so that it is the least that a diagnosis has: r = ln(f true / f declared), whitened by the noise of
the frequencies and the mesh's uncertainty, which both modes of a name share, and projected onto what no combination of
the declared constants can do (physics.md §7.4). The projected signal-to-noise is the norm of what is left.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from statorhom.conceal.listed import ListedMode
from statorhom.conceal.measure_case import Measured
from statorhom.conceal.truth import Case, TrueMaterial
from statorhom.errors import StatorhomError
from statorhom.geometry.stator import stator_geometry
from statorhom.materials.density import Weighing, densities
from statorhom.materials.symmetry import SYMMETRIES, constant_names
from statorhom.mesh import MeshDensity, mesh_step
from statorhom.model.affine import AffineModel, Material, Materials, assemble, hooke_coefficients
from statorhom.model.free_modes import FreeModes, solve_free
from statorhom.study.geometry_file import GeometryFile
from statorhom.study.study_file import StudyFile

FREQUENCY_SD, MESH_SD = (
    3e-4,
    2e-3,
)  # relative: of a measured frequency; of a name's mesh error, after extrapolation
CONSTANT_SD = 0.5  # of a constant's logarithm, before any measurement
STEP = 1e-4  # relative, for derivatives by constants

Key = tuple[int, int, int]


@dataclass(frozen=True, eq=False)
class Declared:
    """A stage as the engineer believes it to be, with the true constants.

    Parameters
    ----------
    model, materials : on the true stator's kind of mesh.
    constants : region → symmetry and constants.
    """

    model: AffineModel
    materials: Materials
    constants: Mapping[str, tuple[str, Mapping[str, float]]]


def detectability(case: Case, tests: Sequence[Measured], density: MeshDensity) -> dict[str, Any]:
    """What each free test leaves behind, and all of them together as `projected_snr`.

    Tests on supports have no declared constants of their own to be absorbed by: their entry is the plain error.
    """
    found: dict[str, Any] = {}
    total = 0.0
    for measured in tests:
        test = case.stages[measured.stage].tests[measured.test]
        if test.declared is not None:
            continue
        try:
            declared = declared_stage(case, measured.stage, density)
        except StatorhomError:
            continue  # typed data that no stator can have are seen at once
        entry = _free_test(declared, measured)
        if entry is not None:
            found[test.name] = entry
            total = float(np.hypot(total, entry["projected_snr"]))
    return {**found, "projected_snr": total}


def declared_stage(case: Case, index: int, density: MeshDensity) -> Declared:
    """The typed geometry and masses, and the true constants as far as the declared symmetry has them."""
    study = StudyFile.model_validate({**case.study, "geometry": "typed"})
    geometry = stator_geometry(GeometryFile.model_validate(case.geometry_file), Path("typed"))
    stages = study.stages[: index + 1]
    step = geometry.step(tuple(stage.kind for stage in stages))
    weights = [Weighing(s.name, s.kind, s.mass_kg, s.mass_sd_kg) for s in stages]
    typed = {d.region: d.density_kg_m3 for d in densities(weights, step.exact_volumes())}
    model = assemble(mesh_step(step, density))
    constants, materials = {}, {}
    for region in model.mesh.regions:
        has_own = study.symmetry(index, region) is not None  # type: ignore[arg-type]
        source = region if has_own else "winding"
        symmetry = str(study.symmetry(index, source))  # type: ignore[arg-type]
        values = _as_declared(symmetry, case.stages[index].materials[source])
        material = Material(
            SYMMETRIES[symmetry](**values).hooke(), typed.get(source, typed.get("winding", 0.0))
        )
        constants[region], materials[region] = (symmetry, values), material
    return Declared(model, materials, constants)


def _as_declared(symmetry: str, true: TrueMaterial) -> dict[str, float]:
    names = constant_names(symmetry)
    if symmetry == true.symmetry:
        return dict(true.constants)
    in_plane = next(true.constants[n] for n in ("E_p_pa", "E_pa", "E_r_pa") if n in true.constants)
    poisson = next(true.constants[n] for n in ("nu_p", "nu", "nu_rt") if n in true.constants)
    return {
        n: in_plane if n.startswith("E") else poisson if n.startswith("nu") else in_plane / 2.6 for n in names
    }


def _free_test(declared: Declared, measured: Measured) -> dict[str, Any] | None:
    pairs = _by_name(measured.modes)
    orders = sorted({key[0] for key in pairs})
    top = 1.3 * measured.ritz.ground.highest_hz
    modes = solve_free(declared.model, declared.materials, top, orders)
    simulated = _simulated(modes)
    keys = [key for key in pairs if key in simulated]
    if not keys:
        return None
    base = np.array([simulated[key] for key in keys for _ in pairs[key]])
    true = np.array([f for key in keys for f in pairs[key]])
    owner = np.array([i for i, key in enumerate(keys) for _ in pairs[key]])
    slopes = _slopes(declared, modes, keys)[owner]
    left, snr = _projected(np.log(true / base), slopes, owner)
    worst = int(np.abs(left).argmax())
    return {
        "projected_snr": snr,
        "worst_percent": 100 * float(np.abs(left[worst])),
        "worst_mode": list(keys[owner[worst]][:2]),
        "rms_percent": 100 * float(np.sqrt(np.mean(left**2))),
        "modes_compared": len(true),
    }


def _by_name(modes: Sequence[ListedMode]) -> dict[Key, list[float]]:
    """Visible frequencies by name: two for a doublet, then the next one of the same name."""
    names: dict[tuple[int, int], list[float]] = defaultdict(list)
    for mode in sorted((m for m in modes if m.is_visible), key=lambda m: m.frequency_hz):
        if mode.order is not None and mode.axial is not None:
            names[mode.order, mode.axial].append(mode.frequency_hz)
    return {
        (r, n, first // 2): found[first : first + 2]
        for (r, n), found in names.items()
        for first in range(0, len(found), 2)
    }


def _simulated(modes: FreeModes) -> dict[Key, float]:
    counts: dict[tuple[int, int], int] = defaultdict(int)
    found = {}
    for mode in modes.modes:
        if mode.order is not None and mode.axial is not None:
            found[mode.order, mode.axial, counts[mode.order, mode.axial]] = mode.frequency_hz
            counts[mode.order, mode.axial] += 1
    return found


def _slopes(declared: Declared, modes: FreeModes, keys: Sequence[Key]) -> np.ndarray:
    """∂ ln f/∂ ln p (keys, constants) by the modes' energies."""
    counts: dict[tuple[int, int], int] = defaultdict(int)
    wanted: dict[Key, np.ndarray] = {}
    for mode in modes.modes:
        if mode.order is not None and mode.axial is not None:
            key = (mode.order, mode.axial, counts[mode.order, mode.axial])
            counts[mode.order, mode.axial] += 1
            wanted[key] = modes.shape(mode)
    shapes = [wanted[key] for key in keys]
    K = declared.model.stiffness_matrix(declared.materials)
    energy = np.array([np.real(np.vdot(u, K @ u)) for u in shapes])
    columns = []
    for region, (symmetry, values) in declared.constants.items():
        terms = [declared.model.stiffness_term(region, q) for q in range(9)]
        parts = np.array([[np.real(np.vdot(u, term @ u)) for term in terms] for u in shapes])
        for name, value in values.items():
            high, low = (
                hooke_coefficients(SYMMETRIES[symmetry](**{**values, name: value * (1 + s)}).hooke())
                for s in (STEP, -STEP)
            )
            columns.append(parts @ ((high - low) / (2 * STEP)) / energy / 2)
    return np.column_stack(columns)


def _projected(residual: np.ndarray, slopes: np.ndarray, owner: np.ndarray) -> tuple[np.ndarray, float]:
    """What a refit of the constants leaves, and its norm in standard deviations."""
    covariance = FREQUENCY_SD**2 * np.eye(len(residual)) + MESH_SD**2 * (owner[:, None] == owner)
    weights = np.linalg.inv(covariance)
    normal = slopes.T @ weights @ slopes + np.eye(slopes.shape[1]) / CONSTANT_SD**2
    fitted = np.linalg.solve(normal, slopes.T @ weights @ residual)
    left = residual - slopes @ fitted
    return left, float(np.sqrt(max(left @ weights @ left, 0.0)))
