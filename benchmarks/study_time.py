"""Time the whole study of the paper's machine, and set it against one CalculiX run.

The study: three steps, free and clamped tests, intervals, report; in a process of its own, from nothing.
The CalculiX run: the first modes of the bare stack on a uniform mesh of 143 000 degrees of freedom, one thread.
Both are measured one after the other on the same machine. Nothing is written where ccx is missing.

    python benchmarks/study_time.py          (Linux)
"""

from __future__ import annotations

import argparse
import contextlib
import ctypes
import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from calculix import INSTALL, ROOT, ccx_version, input_deck, run_ccx

from statorhom import Study
from statorhom.geometry import stator_geometry
from statorhom.mesh import HexMesh, MeshDensity, mesh_step, uniform
from statorhom.study.atomic import write_text
from statorhom.study.geometry_file import read_geometry

STUDY = ROOT / "measurements" / "van-der-giet-550w" / "study.toml"
GEOMETRY = ROOT / "geometries" / "550w-induction-36-slots.toml"
FIGURES = ROOT / "benchmarks" / "figures" / "study_time.json"
CELLS = {"tooth": 2, "slot": 2, "shoulder": 2, "radial": 4, "yoke": 3, "core": 6}
MODES = 40  # rigid-body modes included
PR_SET_CHILD_SUBREAPER = 36  # from <linux/prctl.h>
COMMAND = "from statorhom.cli import main; main()"


@dataclass(frozen=True)
class Timed:
    """Wall time, and processor time of all child processes (s)."""

    wall: float
    processor: float


def timed_study(jobs: int) -> tuple[Timed, dict[str, float]]:
    """Run the study from nothing; also the seconds of each step as the program noted them."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-c", COMMAND, "run", str(STUDY), "--out", folder, "--jobs", str(jobs)]
        clock = _Clock()
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        _collect_orphans()
        spent = clock.read()
        if done.returncode != 0:
            sys.exit(f"the study failed: {done.stderr.strip()}")
        return spent, {stage.name: stage.seconds for stage in Study.read(folder).stages if stage.fit}


def timed_calculix(program: str, mesh: HexMesh) -> Timed:
    """One CalculiX run on one thread, writing of its input left out."""
    deck = input_deck(mesh, "isotropic", MODES)
    clock = _Clock()
    _, wall = run_ccx(program, deck)
    return Timed(wall, clock.read().processor)


class _Clock:
    """Wall and processor time of child processes since it was made."""

    def __init__(self) -> None:
        self._wall, self._processor = time.perf_counter(), _children()

    def read(self) -> Timed:
        return Timed(time.perf_counter() - self._wall, _children() - self._processor)


def _adopt_orphans() -> None:
    """Make processes that outlive their parent ours (Linux): else the study's workers would not be counted."""
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)


def _collect_orphans() -> None:
    with contextlib.suppress(ChildProcessError):
        while True:
            os.wait()


def _children() -> float:
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--jobs", type=int, default=2, help="processes of the study")
    parser.add_argument("--figures", type=Path, default=FIGURES, help="JSON file to write")
    options = parser.parse_args()
    _adopt_orphans()
    study, steps = timed_study(options.jobs)
    print(f"study: {study.wall:.1f} s, {study.processor:.1f} s of processor time, {options.jobs} processes")
    program = shutil.which("ccx")
    if program is None:
        sys.exit(f"no ratio: {INSTALL}")
    step = stator_geometry(read_geometry(GEOMETRY), GEOMETRY).step(("stack",))
    half = mesh_step(step, MeshDensity(dict(uniform().cells) | CELLS))
    ccx = timed_calculix(program, half.full()[0])
    print(f"CalculiX: {ccx.wall:.1f} s, {ccx.processor:.1f} s of processor time, {half.full_dof} DOF")
    ratio = Timed(study.wall / ccx.wall, study.processor / ccx.processor)
    print(f"study over one CalculiX run: {ratio.wall:.2f}, of processor time {ratio.processor:.2f}")
    figures = {
        "study": STUDY.relative_to(ROOT).as_posix(),
        "jobs": options.jobs,
        "processors": os.cpu_count(),
        "load_average_after": round(os.getloadavg()[0], 1),
        "study_seconds": round(study.wall, 1),
        "study_processor_seconds": round(study.processor, 1),
        "seconds_of_steps": steps,
        "ccx_version": ccx_version(program),
        "ccx_degrees_of_freedom": half.full_dof,
        "ccx_modes": MODES,
        "ccx_seconds": round(ccx.wall, 1),
        "ccx_processor_seconds": round(ccx.processor, 1),
        "ratio": round(ratio.wall, 2),
        "ratio_of_processor_time": round(ratio.processor, 2),
    }
    write_text(options.figures, json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main()
