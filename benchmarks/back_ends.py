"""Time and memory of each sparse back end on the whole stack, solved without use of its symmetry, one thread.

Each measurement is a process of its own, so that its peak memory is the back end's: what it needs beyond the loaded
matrix. Times are the processor's, which others may be using. The figures are medians over rounds, in each of which
all back ends take their turn.

    python benchmarks/back_ends.py          (Linux)
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

# before NumPy and MKL are loaded: one thread each
os.environ |= {f"{library}_NUM_THREADS": "1" for library in ("OMP", "OPENBLAS", "MKL")}

import numpy as np
import scipy.sparse as sp

from statorhom.errors import MissingDependencyError
from statorhom.geometry import stator_geometry
from statorhom.materials.isotropic import Isotropic
from statorhom.mesh import MeshDensity, mesh_step, uniform
from statorhom.model.affine import Material
from statorhom.model.back_ends.choice import BACK_ENDS
from statorhom.model.general.band import shifted
from statorhom.model.general.general_model import whole_ring
from statorhom.study.atomic import write_text
from statorhom.study.geometry_file import read_geometry

ROOT = Path(__file__).resolve().parents[1]
GEOMETRY = ROOT / "geometries" / "550w-induction-36-slots.toml"
FIGURES = ROOT / "benchmarks" / "figures"
MATERIALS = {"lamination": Material(Isotropic(187e9, 0.3).hooke(), 7810.5)}
HIGHEST_HZ = 8000.0
SOLVES = 10
BAND = 200  # solves that all modes of the band take
# cells that differ from the uniform mesh's
MESHES: tuple[dict[str, int], ...] = (
    {},
    {"tooth": 2, "slot": 2, "yoke": 3, "core": 4},
    {"tooth": 2, "slot": 2, "shoulder": 2, "radial": 4, "yoke": 3, "core": 6},
)
UNITS = {"factorize_s": "s", "solve_ms": "ms", "band_s": "s", "memory_mib": "MiB"}
TITLES = ("factorization", "one solve", f"with {BAND} solves", "memory")


def measure(name: str, file: Path) -> dict[str, float]:
    """Measure one back end on the matrix in a file; runs in the child process."""
    matrix = sp.csr_array(sp.load_npz(file))
    right = np.random.default_rng(1).standard_normal(matrix.shape[0])
    back_end = BACK_ENDS[name]
    back_end(sp.csr_array(sp.eye_array(8, format="csr")))  # loads the library
    Path("/proc/self/clear_refs").write_text("5", encoding="ascii")  # resets the peak
    before = _memory_mib("VmRSS")
    begin = time.process_time()
    solve = back_end(matrix)
    factorized = time.process_time()
    memory = _memory_mib("VmHWM") - before
    for _ in range(SOLVES):
        solve(right)
    solved = time.process_time()
    factorize, solve_once = factorized - begin, (solved - factorized) / SOLVES
    return {
        "factorize_s": factorize,
        "solve_ms": 1e3 * solve_once,
        "band_s": factorize + BAND * solve_once,
        "memory_mib": memory,
    }


def _memory_mib(key: str) -> float:
    """VmRSS now or VmHWM, the peak since it was reset; getrusage's would be the parent's where that was larger."""
    status = Path("/proc/self/status").read_text(encoding="ascii")
    found = next(line for line in status.splitlines() if line.startswith(key))
    return int(found.split()[1]) / 1024


def in_process(name: str, file: Path) -> dict[str, float]:
    """Measure in a process of its own."""
    command = [sys.executable, __file__, "--measure", name, "--matrix", str(file)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{name} failed: {done.stderr.strip()}")
    figures: dict[str, float] = json.loads(done.stdout)
    return figures


def installed() -> list[str]:
    """Names of the back ends that can be used here."""
    found = []
    for name, back_end in BACK_ENDS.items():
        try:
            back_end(sp.csr_array(sp.eye_array(8, format="csr")))
            found.append(name)
        except MissingDependencyError as missing:
            print(missing)
    return found


def compare(cells: dict[str, int], names: list[str], rounds: int) -> dict[str, object]:
    """Figures of every back end on one mesh."""
    step = stator_geometry(read_geometry(GEOMETRY), GEOMETRY).step(("stack",))
    half = mesh_step(step, MeshDensity(dict(uniform().cells) | cells))
    model = whole_ring(half)
    found: dict[str, list[dict[str, float]]] = {name: [] for name in names}
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "matrix.npz"
        matrix = shifted(model.stiffness_matrix(MATERIALS), model.mass_matrix(MATERIALS), HIGHEST_HZ)
        sp.save_npz(file, matrix, compressed=False)
        for _ in range(rounds):
            for name in names:
                found[name].append(in_process(name, file))
    medians = {
        name: {key: round(statistics.median(run[key] for run in runs), 3) for key in runs[0]}
        for name, runs in found.items()
    }
    print(table(half.full_dof, medians), flush=True)
    return {"degrees_of_freedom": half.full_dof, "cells": cells, "back_ends": medians}


def table(size: int, medians: dict[str, dict[str, float]]) -> str:
    """Markdown table of one mesh."""
    head = f"{size} degrees of freedom"
    lines = [f"| {' | '.join((head, *TITLES))} |", "|---|" + "---|" * len(TITLES)]
    for name, figures in medians.items():
        cells = [f"{figures[key]:.3g} {unit}" if figures[key] < 100 else f"{figures[key]:.0f} {unit}"
                 for key, unit in UNITS.items()]  # fmt: skip
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--meshes", type=int, default=len(MESHES), help="leave out the larger ones")
    parser.add_argument("--figures", type=Path, default=FIGURES, help="folder for back_ends.json and .md")
    parser.add_argument("--measure", help=argparse.SUPPRESS)
    parser.add_argument("--matrix", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.measure:
        print(json.dumps(measure(options.measure, options.matrix)))
        return
    names = installed()
    meshes = [compare(cells, names, options.rounds) for cells in MESHES[: options.meshes]]
    figures = {
        "geometry": GEOMETRY.name,
        "highest_hz": HIGHEST_HZ,
        "rounds": options.rounds,
        "threads": 1,
        "processors": os.cpu_count(),
        "load_average_after": round(os.getloadavg()[0], 1),
        "meshes": meshes,
    }
    write_text(options.figures / "back_ends.json", json.dumps(figures, indent=2) + "\n")
    tables = [table(m["degrees_of_freedom"], m["back_ends"]) for m in meshes]  # type: ignore[arg-type]
    write_text(options.figures / "back_ends.md", "\n".join(tables))


if __name__ == "__main__":
    main()
