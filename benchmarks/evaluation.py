"""Time and error of one certified evaluation of a stator's reduced model: all modes to 8 kHz.

The box of materials is the program's own prior of each step of the 550 W machine; the wound step has a stack that is
known and a winding of a typical modulus. Random materials of the box are evaluated on the reduced and on the full
model. On a machine that others use seconds say little: every evaluation is timed beside one of NumPy's stacked
eigenproblems (`UNIT`), and their ratio is told as well.

    python benchmarks/evaluation.py
"""

from __future__ import annotations

import argparse
import json
import os
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from statorhom import Study
from statorhom.errors import MaterialError
from statorhom.identify.bases.training import REACH, training_materials
from statorhom.identify.fits.priors import Carried, stage_space
from statorhom.identify.fits.stage_fit import search_space
from statorhom.identify.parameters.parameter_space import Parameter, ParameterSpace
from statorhom.identify.processes.workers import Tick, Workers
from statorhom.identify.residuals.refinement import MeshSeries
from statorhom.identify.stages.settings import Settings
from statorhom.identify.stages.stage_materials import StageMaterials
from statorhom.identify.stages.stage_setup import analytic_values, stage_setup
from statorhom.model.affine import AffineModel, Materials, hooke_coefficients
from statorhom.model.cyclic.half_pitch import half_pitches
from statorhom.model.cyclic.modes import modes_of
from statorhom.model.harmonic import Harmonic, all_orders, harmonic_spaces, spaces_of
from statorhom.model.pitch_parts import pitch_parts
from statorhom.model.reduced import MaterialBox, ReducedHarmonic, material_box, reduce_harmonic
from statorhom.model.reduced_stator import ReducedStator, reduced_stator
from statorhom.study.atomic import write_text

ROOT = Path(__file__).resolve().parents[1]
STUDY = ROOT / "measurements" / "van-der-giet-550w" / "study-orthotropy.toml"
FIGURES = ROOT / "benchmarks" / "figures" / "evaluation.json"
STEPS = ("stack", "wound")
TOP_HZ = 8000.0
KNOWN = {
    "E_p_pa": 190e9,
    "E_z_pa": 30e9,
    "nu_p": 0.3,
    "nu_pz": 0.3,
    "G_rz_pa": 10e9,
}  # of the wound step's stack
# of windings across their wires; the prior goes on to where thousands of modes lie below 8 kHz: no basis is small there
TYPICAL_PA = (0.1e9, 10e9)
ROUNDS = 5  # every material is evaluated so often
UNIT = (42, 12)  # so many symmetric matrices of this size are the yardstick of times
LEAST_HZ = 10.0  # a rigid body's frequency is all rounding


@dataclass(frozen=True)
class Plan:
    """How fine a step's bases are.

    Parameters
    ----------
    training : materials of the prior that the bases are made for.
    radius, cells : of the cells, and into how many the box is divided at most.
    room_radius : of the rooms into which cells are divided.
    tolerance : relative frequency error to which bases are certified at the training materials.
    """

    training: int
    radius: float = 1.0
    cells: int = 40
    room_radius: float = 0.25
    tolerance: float = 3e-4


PLANS = {"stack": Plan(2048), "wound": Plan(2048, radius=0.5, tolerance=2e-4)}


def step_box(study: Study, name: str) -> tuple[AffineModel, ParameterSpace, StageMaterials]:
    """Model, searched constants and materials of a step."""
    index = study.stage_index(name)
    setup = stage_setup(study.files, study.geometry, index)
    assert setup.step is not None
    densities = dict(setup.densities)
    carried = Carried()
    if index > 0:
        stack = stage_setup(study.files, study.geometry, 0).densities["lamination"]
        densities["lamination"] = stack
        known = {f"lamination.{c}": v for c, v in KNOWN.items()}
        known["lamination.density_kg_m3"] = stack.density_kg_m3
        carried = Carried(tuple(Parameter.constant(n, v) for n, v in known.items()))
    analytic = analytic_values(study.files, setup, densities)
    space = stage_space(setup.keys, setup.materials, setup.new, densities, carried, analytic)
    model = MeshSeries(setup.step, Settings().density, (1.0,)).coarsest
    return model, search_space(space), setup.materials


def random_materials(space: ParameterSpace, materials: StageMaterials, count: int) -> list[Materials]:
    """Independent draws of the prior, cut where the training is cut."""
    rng = np.random.default_rng(7)
    root = np.linalg.cholesky(space.prior_covariance)
    found: list[Materials] = []
    while len(found) < count:
        z = rng.standard_normal(space.dimension)
        if np.abs(z).max() > REACH:
            continue
        try:
            drawn = materials.of(space.values(space.bounds.clip(space.prior_mean + root @ z)))
        except MaterialError:
            continue
        if is_typical(drawn):
            found.append(drawn)
    return found


def is_typical(materials: Materials) -> bool:
    """Whether its winding, if there is one, is neither softer nor stiffer than windings are."""
    low, high = TYPICAL_PA
    windings = (m for region, m in materials.items() if region != "lamination")
    return all(low <= 1.0 / winding.hooke.compliance[0, 0] <= high for winding in windings)


def _build(task: tuple[AffineModel, Harmonic, MaterialBox, float], tick: Tick) -> ReducedHarmonic:
    model, harmonic, box, tolerance = task
    tick()
    return reduce_harmonic(model, harmonic, box, TOP_HZ, tolerance)


def _exact(task: tuple[AffineModel, list[Materials]], tick: Tick) -> list[list[np.ndarray]]:
    """Eigenvalues of all harmonic problems of the full model, per material."""
    model, several = task
    tick()
    parts = pitch_parts(model.mesh)
    spaces = [space for order in all_orders(model.mesh.slots) for space in spaces_of(parts, order)]
    found = []
    for materials in several:
        K, M = model.stiffness_matrix(materials), model.mass_matrix(materials)
        found.append([values for values, _ in modes_of(half_pitches(parts, K, M), spaces, TOP_HZ)])
    return found


def timed(stator: ReducedStator, several: Sequence[Materials]) -> dict[str, float]:
    """Milliseconds of a certified evaluation with the modes' names: quantiles over the materials."""
    for materials in several[:20]:
        stator.solve(materials)
    several = list(several) * ROUNDS
    matrices = np.random.default_rng(0).standard_normal((UNIT[0], UNIT[1], UNIT[1]))
    times = []
    for materials in several:
        hooke_coefficients.cache_clear()  # a fit sees every material once
        begin = time.perf_counter()
        solution = stator.solve(materials)
        solved = time.perf_counter()
        bound = solution.largest_certified_error
        certified = time.perf_counter()
        assert len(solution.modes) > 0 or bound >= 0.0
        named = time.perf_counter()
        np.linalg.eigh(matrices)  # reads one triangle
        times.append(np.diff([begin, solved, certified, named, time.perf_counter()]))
    ms = 1e3 * np.array(times)
    whole = ms[:, :3].sum(axis=1)
    quantiles = np.quantile(whole, (0.1, 0.5, 0.9))
    solve, certificate, names, unit = np.median(ms, axis=0).tolist()
    return {
        **dict(zip(("ms_10_percent", "ms_median", "ms_90_percent"), quantiles.tolist(), strict=True)),
        "ms_least_median": float(np.median(whole.reshape(ROUNDS, -1).min(axis=0))),
        "ms_median_modes": solve,
        "ms_median_certificate": certificate,
        "ms_median_names": names,
        "ms_median_unit": unit,
        "units_median": float(np.median(whole / ms[:, 3])),
        "evaluations_per_second": float(1e3 / quantiles[1]),
    }


def errors(
    stator: ReducedStator, several: Sequence[Materials], exact: Sequence[Sequence[np.ndarray]]
) -> dict[str, float]:
    """True and certified errors in percent, over all modes of the band and all materials."""
    true: list[float] = []
    certified: list[float] = []
    modes = []
    for number, materials in enumerate(several):
        solution = stator.solve(materials)
        count = 0
        for batch, pairs, bounds in zip(solution.batches, solution.pairs, solution.certificates, strict=True):
            for row, problem in enumerate(batch.problems):
                # a mode within the error of the band's end may be in the one and not in the other
                shared = min(len(exact[number][problem]), pairs.counts[row])
                values, found = exact[number][problem][:shared], pairs.values[row, :shared]
                moving = values > (2 * np.pi * LEAST_HZ) ** 2
                true += (np.sqrt(found[moving] / values[moving]) - 1).tolist()
                certified += bounds[row, :shared][moving].tolist()
                count += int(stator.kinds.multiplicities[problem]) * int(moving.sum())
        modes.append(count)
    t, c = np.array(true), np.array(certified)
    visible = t > 1e-7
    return {
        "materials": len(several),
        "modes_median": float(np.median(modes)),
        "true_percent_median": float(100 * np.median(t)),
        "true_percent_99": float(100 * np.quantile(t, 0.99)),
        "true_percent_largest": float(100 * t.max()),
        "materials_beyond_0_05_percent_modes": int((t > 5e-4).sum()),
        "certified_percent_median": float(100 * np.median(c)),
        "certified_percent_99": float(100 * np.quantile(c, 0.99)),
        "bound_holds_percent": float(100 * np.mean(c >= t - 1e-9)),
        "effectivity_median": float(np.median((c / t)[visible])),
    }


def measured_step(study: Study, name: str, points: int, jobs: int, plan: Plan) -> dict[str, Any]:
    """All figures of a step."""
    model, space, materials = step_box(study, name)
    training = [m for m in training_materials(space, materials, plan.training) if is_typical(m)]
    box = material_box(training, model.mesh.regions, plan.radius, plan.cells, room_radius=plan.room_radius)
    spaces = [s for h in all_orders(model.mesh.slots) for s in harmonic_spaces(model.mesh, h)]
    several = random_materials(space, materials, points)
    middle = materials.of(space.values(space.start))
    with Workers(jobs) as workers:
        begin = time.perf_counter()
        problems = workers.map(_build, [(model, s, box, plan.tolerance) for s in spaces])
        build = time.perf_counter() - begin
        stator = reduced_stator(model, box, problems, TOP_HZ, middle)
        begin = time.perf_counter()
        shares = workers.map(_exact, [(model, several[i::jobs]) for i in range(jobs)])
        full = (time.perf_counter() - begin) / points
    exact = [shares[i % jobs][i // jobs] for i in range(points)]
    sizes = [r.size for p in problems for c in p.cells for r in c.rooms]
    with threadpool_limits(limits=1, user_api="blas"):
        limited = timed(stator, several)
    default = timed(stator, several)
    found: dict[str, Any] = {
        "degrees_of_freedom": model.mesh.full_dof,
        "searched_constants": space.dimension,
        "harmonic_problems": len(spaces),
        "training_materials": len(training),
        "cells": len(box.training),
        "rooms": sum(len(rooms.members) for rooms in box.rooms),
        "basis_vectors_median": float(np.median(sizes)),
        "basis_vectors_largest": max(sizes),
        "build_seconds": build,
        "full_model_seconds_per_material": full,
        "one_blas_thread": limited,
        "default_blas_threads": default,
    }
    return found | errors(stator, several, exact)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--steps", nargs="+", choices=STEPS, default=list(STEPS))
    parser.add_argument("--points", type=int, default=200, help="random materials")
    parser.add_argument(
        "--jobs", type=int, default=2, help="processes that build and that solve the full model"
    )
    parser.add_argument("--figures", type=Path, default=FIGURES, help="JSON file to write")
    options = parser.parse_args()
    study = Study.load(STUDY)
    figures: dict[str, Any] = {"band_hz": TOP_HZ, "processors": os.cpu_count(), "jobs": options.jobs}
    for name in options.steps:
        figures[name] = measured_step(study, name, options.points, options.jobs, PLANS[name])
        print(name)
        for key, value in figures[name].items():
            print(f"  {key}: {value}")
    figures["load_average_after"] = round(os.getloadavg()[0], 1)
    write_text(options.figures, json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main()
