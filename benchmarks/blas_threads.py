"""The default run against one with a single BLAS thread, on a quiet and on a busy machine.

The matrices of a half slot pitch are small: threads inside BLAS only fight for the processors, and on a busy machine
they wait for each other. statorhom limits them around small problems; so the default environment must cost no more
than OMP_NUM_THREADS=1. All modes of the paper's stack to 8 kHz, in processes that take turns; on the busy machine as
many processes as there are processors count to infinity beside them.

    python benchmarks/blas_threads.py
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path

from calculix import ROOT
from engine import measured, ours

from statorhom.study.atomic import write_text

FIGURES = ROOT / "benchmarks" / "figures" / "blas_threads.json"
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
SIZE = 27  # thousand degrees of freedom
SPIN = "while True: pass"


def seconds(limited: bool) -> float:
    """Time of one solution in a process of its own, which takes the environment of this one."""
    for name in THREADS:
        os.environ.pop(name, None)
    if limited:
        os.environ.update(dict.fromkeys(THREADS, "1"))
    return float(measured(ours, SIZE)["seconds"])


def paired(repeats: int) -> dict[str, float]:
    """Medians of both environments, which take turns."""
    found: dict[bool, list[float]] = {True: [], False: []}
    for _ in range(repeats):
        for limited, values in found.items():
            values.append(seconds(limited))
    one, default = (statistics.median(found[limited]) for limited in (True, False))
    return {
        "one_thread_seconds": round(one, 3),
        "default_seconds": round(default, 3),
        "ratio": round(default / one, 2),
    }


def busy(repeats: int) -> dict[str, float]:
    """The same beside as many busy processes as there are processors."""
    count = len(os.sched_getaffinity(0))
    others = [subprocess.Popen([sys.executable, "-c", SPIN]) for _ in range(count)]
    try:
        return paired(repeats)
    finally:
        for other in others:
            other.kill()
            other.wait()


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--figures", type=Path, default=FIGURES, help="JSON file to write")
    options = parser.parse_args()
    figures = {"processors": os.cpu_count(), "quiet": paired(options.repeats), "busy": busy(options.repeats)}
    print(json.dumps(figures, indent=2))
    write_text(options.figures, json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main()
