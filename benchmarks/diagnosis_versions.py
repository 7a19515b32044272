"""Time of diagnoses by this version of the program and by another one, in turn: what seconds of other hours compare to.

    git worktree add --detach OTHER COMMIT
    python benchmarks/diagnosis_versions.py OTHER STUDY…

Each is a process of its own, with one job, loading the program included. The pace of a shared machine changes by a
factor of three from day to day; the ratio of two runs of one hour does not.
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

ROOT = Path(__file__).resolve().parents[1]
PROGRAM = "from statorhom.cli import main; main()"
# before NumPy is loaded: one thread each
THREADS = {f"{library}_NUM_THREADS": "1" for library in ("OMP", "OPENBLAS", "MKL")}


def diagnosed(tree: Path, study: Path) -> tuple[float, str]:
    """Seconds, and the verdict with what it names."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-c", PROGRAM, "diagnose", str(study), "--out", folder, "--jobs", "1"]
        environment = os.environ | THREADS | {"PYTHONPATH": str(tree / "src")}
        begin = time.perf_counter()
        subprocess.run(command, env=environment, check=True, stdout=subprocess.DEVNULL)
        seconds = time.perf_counter() - begin
        answer = json.loads((Path(folder) / "diagnosis.json").read_text(encoding="utf-8"))
    return seconds, " ".join([answer["verdict"], *(effect["effect"] for effect in answer["effects"])])


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("other", type=Path, help="folder with a checkout of the other version")
    parser.add_argument("studies", type=Path, nargs="+")
    options = parser.parse_args()
    ratios = []
    for study in options.studies:
        (now, says), (then, said) = diagnosed(ROOT, study), diagnosed(options.other.resolve(), study)
        ratios.append(now / then)
        print(
            f"{study.parent.name}: {now:.1f} s ({says}) / {then:.1f} s ({said}) = {ratios[-1]:.2f}",
            flush=True,
        )
    print(f"median of {len(ratios)}: {statistics.median(ratios):.2f}")


if __name__ == "__main__":
    main()
