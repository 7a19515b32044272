"""The cyclic solver against CalculiX and against scikit-fem's forms with ARPACK, on the same meshes.

Every solver gets the same mesh of 20-node hexahedra of the bare stack and the same number of processors. statorhom
assembles one half slot pitch and finds every mode to 8 kHz; CalculiX finds its 20 lowest modes of the whole stack,
and with its own *CYCLIC SYMMETRY MODEL those of every nodal diameter; scikit-fem assembles a form over the whole
stack and hands it to ARPACK. The solvers take turns, each in a process of its own; medians and ratios of one run.

    python benchmarks/engine.py                     (needs ccx; about half an hour)
    python benchmarks/engine.py --sizes 26 --repeats 1
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import resource
import shutil
import statistics
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from calculix import CONSTANTS, DENSITY, INSTALL, ROOT, ccx_version, input_deck, run_ccx
from calculix_cyclic import cyclic_deck, read_cyclic_frequencies

from statorhom.geometry import stator_geometry
from statorhom.materials.symmetry import SYMMETRIES
from statorhom.mesh import HalfPitchMesh, MeshDensity, mesh_step, uniform
from statorhom.model.affine import Material, assemble
from statorhom.model.free_modes import solve_free
from statorhom.study.atomic import write_text
from statorhom.study.geometry_file import read_geometry

matplotlib.use("Agg")
GEOMETRY = ROOT / "geometries" / "550w-induction-36-slots.toml"
FIGURES = ROOT / "benchmarks" / "figures" / "engine.json"
HIGHEST_HZ = 8000.0
MODES = 20
# thousand degrees of freedom of the whole stack → cells
SIZES: dict[int, dict[str, int]] = {
    27: {},
    75: {"tooth": 2, "slot": 1, "shoulder": 1, "radial": 3, "yoke": 3, "core": 4},
    143: {"tooth": 2, "slot": 2, "shoulder": 2, "radial": 4, "yoke": 3, "core": 6},
    1068: {"tooth": 4, "slot": 4, "shoulder": 4, "radial": 8, "yoke": 7, "core": 12},
}
LARGEST_FORM = 27  # thousand degrees of freedom: beyond, the forms take minutes
LARGEST_OTHER = 143
SKFEM_CORNERS = [0, 4, 3, 1, 7, 5, 2, 6]  # where scikit-fem's cube has our corners


def half_pitch(size: int) -> HalfPitchMesh:
    """Mesh of the stack with so many thousand degrees of freedom."""
    step = stator_geometry(read_geometry(GEOMETRY), GEOMETRY).step(("stack",))
    return mesh_step(step, MeshDensity(dict(uniform().cells) | SIZES[size]))


def ours(half: HalfPitchMesh) -> np.ndarray:
    """Every mode to 8 kHz, assembly of the half pitch included."""
    core = Material(SYMMETRIES["isotropic"](**CONSTANTS["isotropic"]).hooke(), DENSITY)
    threads = len(os.sched_getaffinity(0))
    modes = solve_free(assemble(half), {"lamination": core}, HIGHEST_HZ, jobs=threads).modes
    return np.sort(np.concatenate([[m.frequency_hz] * m.multiplicity for m in modes]))


def forms(half: HalfPitchMesh) -> np.ndarray:
    """scikit-fem's own assembly of the whole stack and SciPy's shift-invert ARPACK."""
    from scipy.sparse.linalg import eigsh
    from skfem import Basis, BilinearForm, ElementHexS2, ElementVector, MeshHex
    from skfem.helpers import dot
    from skfem.models.elasticity import lame_parameters, linear_elasticity

    full, _, _ = half.full()
    corners, numbers = np.unique(full.elements[:, :8], return_inverse=True)
    mesh = MeshHex(full.nodes[corners].T, numbers.reshape(-1, 8)[:, SKFEM_CORNERS].T)
    basis = Basis(mesh, ElementVector(ElementHexS2()), intorder=4)
    constants = CONSTANTS["isotropic"]
    stiffness = linear_elasticity(*lame_parameters(constants["E_pa"], constants["nu"])).assemble(basis)
    mass = DENSITY * BilinearForm(lambda u, v, _: dot(u, v)).assemble(basis)
    values, _ = eigsh(stiffness, MODES, mass, sigma=-0.05 * (2 * np.pi * HIGHEST_HZ) ** 2)
    return np.sort(np.sqrt(np.maximum(values, 0.0)) / (2 * np.pi))


def measured(function: Callable[[HalfPitchMesh], np.ndarray], size: int) -> dict[str, Any]:
    """Time, peak memory and frequencies of a solver in a process of its own."""
    context = multiprocessing.get_context("spawn")
    receive, send = context.Pipe(duplex=False)
    process = context.Process(target=_measure, args=(function, size, send))
    process.start()
    send.close()
    try:
        found: dict[str, Any] = receive.recv()
    except EOFError:
        sys.exit(f"{function.__name__} failed at {size} 000 degrees of freedom")
    process.join()
    return found


def _measure(function: Callable[[HalfPitchMesh], np.ndarray], size: int, send: Any) -> None:
    half = half_pitch(size)
    function(half_pitch(27))  # what a process does once is no part of a solution
    begin, busy = time.perf_counter(), time.process_time()
    frequencies = function(half)
    seconds, busy = time.perf_counter() - begin, time.process_time() - busy
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024**2
    found = {"seconds": seconds, "processor_seconds": busy, "memory_gib": memory}
    send.send({**found, "hz": frequencies[frequencies > 1.0]})


def calculix(program: str, size: int, cyclic: bool, threads: int) -> dict[str, Any]:
    """Time and frequencies of CalculiX, of the whole stack or with its cyclic symmetry."""
    half = half_pitch(size)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    if cyclic:
        deck = cyclic_deck(half, "isotropic", MODES // 2)
        hz, seconds = run_ccx(program, deck, threads, read_cyclic_frequencies)
    else:
        hz, seconds = run_ccx(program, input_deck(half.full()[0], "isotropic", MODES), threads)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    # the system keeps the largest child only: a smaller one shows nothing
    memory = after.ru_maxrss / 1024**2 if after.ru_maxrss > before.ru_maxrss else None
    busy = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return {"seconds": seconds, "processor_seconds": busy, "memory_gib": memory, "hz": hz[hz > 1.0]}


def paired(size: int, repeats: int, program: str, threads: int) -> dict[str, Any]:
    """Medians of all solvers at a size; they take turns, so that what disturbs one disturbs all."""
    solvers: dict[str, Callable[[], dict[str, Any]]] = {"statorhom": lambda: measured(ours, size)}
    if size <= LARGEST_OTHER:
        solvers["calculix"] = lambda: calculix(program, size, False, threads)
        solvers["calculix_cyclic"] = lambda: calculix(program, size, True, threads)
    if size <= LARGEST_FORM:
        solvers["scikit_fem"] = lambda: measured(forms, size)
    runs: dict[str, list[dict[str, Any]]] = {name: [] for name in solvers}
    for _ in range(repeats):
        for name, solve in solvers.items():
            runs[name].append(solve())
            print(f"  {name:16s} {runs[name][-1]['seconds']:8.2f} s", flush=True)
    return _summary(size, runs)


def _summary(size: int, runs: dict[str, list[dict[str, Any]]]) -> dict[str, Any]:
    row: dict[str, Any] = {"degrees_of_freedom": half_pitch(size).full_dof, "repeats": len(runs["statorhom"])}
    for name, found in runs.items():
        memory = [f["memory_gib"] for f in found if f["memory_gib"] is not None]
        row[name] = {
            "seconds": round(statistics.median(f["seconds"] for f in found), 3),
            "processor_seconds": round(statistics.median(f["processor_seconds"] for f in found), 3),
            "memory_gib": round(max(memory), 2) if memory else None,
            "modes": len(found[0]["hz"]),
        }
        if name != "statorhom":
            pairs = list(zip(found, runs["statorhom"], strict=True))
            for key, what in (("ratio", "seconds"), ("processor_ratio", "processor_seconds")):
                row[name][key] = round(statistics.median(f[what] / o[what] for f, o in pairs), 1)
            row[name]["largest_difference"] = _difference(found[0]["hz"], runs["statorhom"][0]["hz"])
    return row


def _difference(theirs: np.ndarray, mine: np.ndarray) -> float:
    count = min(len(theirs), len(mine)) - 1  # a doublet may be cut in two by the number of modes asked for
    return float(f"{np.abs(theirs[:count] / mine[:count] - 1).max():.1e}")


def growth(rows: list[dict[str, Any]], solver: str) -> float | None:
    """Exponent of time over degrees of freedom."""
    points = [(r["degrees_of_freedom"], r[solver]["seconds"]) for r in rows if solver in r]
    if len(points) < 2:
        return None
    return round(float(np.polyfit(*np.log(np.array(points).T), 1)[0]), 2)


def plot(rows: list[dict[str, Any]], path: Path) -> None:
    """Time over degrees of freedom of every solver."""
    from matplotlib import pyplot as plt

    names = {
        "statorhom": "statorhom, every mode to 8 kHz",
        "calculix": f"CalculiX, {MODES} modes",
        "calculix_cyclic": "CalculiX, cyclic symmetry",
        "scikit_fem": "scikit-fem's forms, ARPACK",
    }
    figure, axes = plt.subplots(figsize=(7, 4.2), layout="constrained")
    for name, label in names.items():
        points = [(r["degrees_of_freedom"], r[name]["seconds"]) for r in rows if name in r]
        if points:
            axes.loglog(*np.array(points).T, marker="o", label=label)
    axes.set(xlabel="degrees of freedom of the whole stack", ylabel="time in s")
    axes.grid(True, which="major", alpha=0.4)
    axes.legend(frameon=False)
    figure.savefig(path, dpi=150)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--sizes", type=int, nargs="+", choices=sorted(SIZES), default=sorted(SIZES))
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--figures", type=Path, default=FIGURES, help="JSON file to write; a plot beside it")
    options = parser.parse_args()
    program = shutil.which("ccx")
    if program is None:
        sys.exit(INSTALL)
    threads = len(os.sched_getaffinity(0))
    rows = []
    for size in options.sizes:
        print(f"{half_pitch(size).full_dof} degrees of freedom")
        rows.append(paired(size, options.repeats, program, threads))
    solvers = ("statorhom", "calculix", "calculix_cyclic", "scikit_fem")
    figures = {
        "ccx_version": ccx_version(program),
        "processors": threads,
        "load_average_after": round(os.getloadavg()[0], 1),
        "highest_hz": HIGHEST_HZ,
        "sizes": rows,
        "growth_exponent": {name: growth(rows, name) for name in solvers},
    }
    write_text(options.figures, json.dumps(figures, indent=2) + "\n")
    plot(rows, options.figures.with_suffix(".png"))
    print(json.dumps(figures, indent=2))


if __name__ == "__main__":
    main()
