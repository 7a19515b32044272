"""Time one whole step's fit on a uniform mesh of 143 000 degrees of freedom, and set it against one CalculiX run on it.

The fit: mesh, reduced bases, 5000 evaluations, polish, intervals, verification on the full model; in two processes,
from nothing. The CalculiX run: the first modes of the stack on the same mesh, one thread. Both are measured one
after the other. The extrapolation over finer meshes, which a study adds, is left out: it is no part of a step on this
mesh. The stack is fitted as the paper does, isotropic with one mode, and transversely isotropic with all free modes.
Nothing is written where ccx is missing.

    python benchmarks/step_fit.py
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

from calculix import INSTALL, ROOT, ccx_version
from study_time import CELLS, MODES, timed_calculix

from statorhom import Study
from statorhom.identify.fits.priors import Carried
from statorhom.identify.fits.stage_run import StageRun, run_stage
from statorhom.identify.processes.announce import Progress
from statorhom.identify.processes.workers import Workers
from statorhom.identify.stages.settings import Settings
from statorhom.identify.stages.stage_setup import StageSetup, analytic_values, stage_setup
from statorhom.mesh import MeshDensity, mesh_step, uniform
from statorhom.study.atomic import write_text

FOLDER = ROOT / "measurements" / "van-der-giet-550w"
STUDIES = (FOLDER / "study.toml", FOLDER / "study-orthotropy.toml")
FIGURES = ROOT / "benchmarks" / "figures" / "step_fit.json"
DENSITY = MeshDensity(dict(uniform().cells) | CELLS)
EVALUATIONS = 5000


class Clock:
    """Seconds from the begin of each part of the fit to its last unit of work, parts of one name together."""

    def __init__(self) -> None:
        self.begin = time.perf_counter()
        self.first: float | None = None
        self.parts: dict[str, float] = {}

    def __call__(self, what: str, _count: int) -> Progress:
        begun, before = time.perf_counter(), self.parts.get(what, 0.0)
        self.first = begun if self.first is None else self.first

        def tick(_done: int) -> None:
            self.parts[what] = before + time.perf_counter() - begun

        return tick


def fitted(study: Study, jobs: int) -> tuple[StageRun, dict[str, float]]:
    """The stack's fit, and the seconds of its parts."""
    setup = _longer(stage_setup(study.files, study.geometry, 0))
    settings = Settings(jobs=jobs, density=DENSITY, refinements=(1.0,))
    clock = Clock()
    with Workers(jobs) as workers:
        run = run_stage(setup, Carried(), analytic_values(study.files, setup, {}), settings, workers, clock)
        run.fit.posterior.estimates()
    whole = time.perf_counter() - clock.begin
    assert clock.first is not None
    parts = {"mesh and orders": clock.first - clock.begin, **clock.parts}
    rest = whole - sum(parts.values())
    return run, {**parts, "polish, intervals, verification": rest, "whole": whole}


def _longer(setup: StageSetup) -> StageSetup:
    keys = setup.keys.model_copy(
        update={"identify": setup.keys.identify.model_copy(update={"evaluations": EVALUATIONS})}
    )
    return replace(setup, keys=keys)


def measured(study: Study, jobs: int, ccx_seconds: float) -> dict[str, Any]:
    """Figures of one study's first step."""
    run, seconds = fitted(study, jobs)
    ratio = seconds["whole"] / ccx_seconds
    print(f"{study.name}: {seconds['whole']:.1f} s, {ratio:.2f} of the CalculiX run")
    for part, value in seconds.items():
        print(f"  {part}: {value:.1f} s")
    print(
        f"  reduced model at the result: {100 * run.basis.deviation:.4f} % from the full one, "
        f"certified {100 * run.basis.certified:.4f} %"
    )
    return {
        "lamination": run.setup.keys.model.lamination,
        "searched_constants": run.fit.problem.space.dimension,
        "harmonic_problems": len(run.fit.problem.solver.kinds),
        "cells": len(run.fit.problem.solver.box.training),
        "seconds": {part: round(value, 1) for part, value in seconds.items()},
        "basis_deviation_percent": 100 * run.basis.deviation,
        "basis_certified_percent": 100 * run.basis.certified,
        "ratio": round(ratio, 2),
    }


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--jobs", type=int, default=2, help="processes of the fit")
    parser.add_argument("--figures", type=Path, default=FIGURES, help="JSON file to write")
    options = parser.parse_args()
    program = shutil.which("ccx")
    if program is None:
        sys.exit(INSTALL)
    studies = [Study.load(path) for path in STUDIES]
    half = mesh_step(studies[0].geometry.step(("stack",)), DENSITY)
    ccx = timed_calculix(program, half.full()[0])
    print(f"CalculiX: {ccx.wall:.1f} s, {half.full_dof} DOF")
    figures = {
        "jobs": options.jobs,
        "processors": os.cpu_count(),
        "evaluations": EVALUATIONS,
        "degrees_of_freedom": half.full_dof,
        "ccx_version": ccx_version(program),
        "ccx_modes": MODES,
        "ccx_seconds": round(ccx.wall, 1),
        "ccx_processor_seconds": round(ccx.processor, 1),
        "studies": {study.name: measured(study, options.jobs, ccx.wall) for study in studies},
        "load_average_after": round(os.getloadavg()[0], 1),
    }
    write_text(options.figures, json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main()
