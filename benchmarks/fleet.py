"""Fit a fleet of synthetic machines of one geometry, and again with a worker killed half-way.

The machines are made with the program's own model: moduli, densities and so weights scatter around typical ones, and
the frequencies of the free stack carry noise. They are fitted by one process, by several, and by several of which one
is killed when half of the machines are done. Then the three tables must be equal, byte by byte.

    python benchmarks/fleet.py          (POSIX)
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import resource
import shutil
import signal
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from statorhom.fleet.batch import fit_fleet
from statorhom.fleet.local import LocalProcesses
from statorhom.geometry import stator_geometry
from statorhom.identify.processes.workers import Workers
from statorhom.identify.residuals.refinement import Band, MeshSeries
from statorhom.identify.stages.settings import FITTING_MESH
from statorhom.materials.symmetry import constant_names
from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.materials.typical import prior_range
from statorhom.model.affine import AffineModel, Material
from statorhom.model.free_modes import solve_free
from statorhom.study.atomic import write_text
from statorhom.study.geometry_file import read_geometry

ROOT = Path(__file__).resolve().parents[1]
GEOMETRY = ROOT / "geometries" / "550w-induction-36-slots.toml"
FIGURES = ROOT / "benchmarks" / "figures" / "fleet.json"
MODES = ((2, 0), (2, 1), (3, 0), (3, 1))
ORDERS = tuple(sorted({r for r, _ in MODES}))
HIGHEST_HZ = 8000.0
# typical constants, and their relative scatter from machine to machine
SYMMETRY = "transversely_isotropic"
TYPICAL = {c: prior_range("lamination", "stack", SYMMETRY, c).median for c in constant_names(SYMMETRY)}
SCATTER = {"E_p_pa": 0.01, "E_z_pa": 0.05, "G_rz_pa": 0.03}
DENSITY, DENSITY_SCATTER, NOISE = 7700.0, 0.004, 5e-4

STUDY = """\
schema = 1
name = "{name}"
geometry = "../geometry.toml"

[[stages]]
name = "stack"
kind = "stack"
mass_kg = {mass!r}
[stages.model]
lamination = "transversely_isotropic"
[stages.identify]
evaluations = 400
chains = 2
[[stages.tests]]
name = "stack-free"
support = "free"
modal_table = "stack-free.csv"
"""


@dataclass(frozen=True)
class Run:
    """Wall time, and processor time of all processes (s)."""

    wall: float
    processor: float


def make_fleet(folder: Path, count: int) -> tuple[list[Path], np.ndarray]:
    """Write the studies; also the true E_p of every machine (Pa)."""
    shutil.copy(GEOMETRY, folder / "geometry.toml")
    geometry = stator_geometry(read_geometry(GEOMETRY), GEOMETRY)
    step = geometry.step(("stack",))
    series, volume = MeshSeries(step, FITTING_MESH), step.exact_volumes()["lamination"]
    factors = mesh_factors(series)
    rng = np.random.default_rng(1)
    studies, truth = [], []
    for i in range(count):
        constants = TYPICAL | {n: TYPICAL[n] * (1 + s * rng.standard_normal()) for n, s in SCATTER.items()}
        density = DENSITY * (1 + DENSITY_SCATTER * rng.standard_normal())
        path = folder / f"{i:03}" / "study.toml"
        path.parent.mkdir()
        path.write_text(STUDY.format(name=f"machine-{i:03}", mass=float(density * volume)), encoding="utf-8")
        material = Material(TransverselyIsotropic(**constants).hooke(), density)
        table = modal_table(series.coarsest, material, factors, rng)
        (path.parent / "stack-free.csv").write_text(table, encoding="utf-8")
        studies.append(path)
        truth.append(constants["E_p_pa"])
    return studies, np.array(truth)


def mesh_factors(series: MeshSeries) -> dict[tuple[int | None, int | None], float]:
    """Converged over fitting mesh's frequency of every mode, of the typical material; it hardly depends on it."""
    material = Material(TransverselyIsotropic(**TYPICAL).hooke(), DENSITY)
    bands = {order: Band(HIGHEST_HZ, len(series.refinements), None) for order in ORDERS}
    factors: dict[tuple[int | None, int | None], float] = {}
    for mode in series.study({"lamination": material}, bands, Workers(1)):
        factors.setdefault(mode.key[:2], mode.extrapolated_hz / mode.frequency_hz[0])
    return factors


def modal_table(
    model: AffineModel,
    material: Material,
    factors: dict[tuple[int | None, int | None], float],
    rng: np.random.Generator,
) -> str:
    """The machine's named modes on a converged mesh, with noise, as CSV."""
    lowest: dict[tuple[int | None, int | None], float] = {}
    for mode in solve_free(model, {"lamination": material}, HIGHEST_HZ, ORDERS).modes:
        lowest.setdefault((mode.order, mode.axial), mode.frequency_hz)
    rows = [
        f"{lowest[r, n] * factors[r, n] * (1 + NOISE * rng.standard_normal()):.3f},{r},{n}" for r, n in MODES
    ]
    return "\n".join(["frequency_hz,order,axial", *rows, ""])


def timed(studies: list[Path], out: Path, jobs: int, kill_at: int | None = None) -> Run:
    """Fit the fleet from nothing, bases included; a worker is killed when `kill_at` machines are done."""
    killed: list[int] = []

    def announce(_what: str, _count: int) -> Callable[[int], None]:
        def progress(done: int) -> None:
            if done == kill_at and not killed:
                pid = multiprocessing.active_children()[0].pid
                assert pid is not None
                os.kill(pid, signal.SIGKILL)
                killed.append(pid)

        return progress

    wall, processor = time.perf_counter(), processor_time()
    fleet = fit_fleet(studies, out, LocalProcesses(jobs), announce=announce)
    assert not fleet.errors, fleet.errors
    assert len(killed) == (kill_at is not None)
    return Run(time.perf_counter() - wall, processor_time() - processor)


def processor_time() -> float:
    """Of this process and of those that it started and that have ended (s)."""
    spent = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(usage.ru_utime + usage.ru_stime for usage in spent)


def figures(count: int, jobs: int, folder: Path) -> dict[str, object]:
    """Run everything and hold the tables against each other."""
    studies, truth = make_fleet(folder, count)
    runs = {
        "one_process": timed(studies, folder / "one", 1),
        "several_processes": timed(studies, folder / "several", jobs),
        "one_of_them_killed": timed(studies, folder / "killed", jobs, count // 2),
    }
    tables = [(folder / out / "fleet.csv").read_bytes() for out in ("one", "several", "killed")]
    table = pd.read_csv(folder / "killed" / "fleet.csv")
    low, high = (table[f"lamination.E_p_pa.{end}90"].to_numpy() for end in ("low", "high"))
    found = table["lamination.E_p_pa"].to_numpy()
    return {
        "machines": count,
        "processes": jobs,
        "processors": os.cpu_count(),
        "load_average_after": round(os.getloadavg()[0], 1),
        "rows": len(table),
        "machines_of_the_rows": int(table["study"].nunique()),
        "tables_are_equal": len(set(tables)) == 1,
        "files_of_bases": len(list((folder / "killed" / "bases").iterdir())),
        "seconds": {name: round(run.wall, 1) for name, run in runs.items()},
        "machines_per_minute": {name: round(60 * count / run.wall, 1) for name, run in runs.items()},
        "throughput_ratio": round(runs["one_process"].wall / runs["several_processes"].wall, 2),
        "scatter_of_E_p_percent": round(100 * float(np.std(found / truth)), 2),
        "E_p_in_ci90": int(((low <= truth) & (truth <= high)).sum()),
    }


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--machines", type=int, default=200)
    parser.add_argument("--jobs", type=int, default=2, help="processes of the second and third run")
    parser.add_argument("--figures", type=Path, default=FIGURES, help="JSON file to write")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        found = figures(options.machines, options.jobs, Path(folder))
    print(json.dumps(found, indent=2))
    write_text(options.figures, json.dumps(found, indent=2) + "\n")


if __name__ == "__main__":
    main()
