"""Time of diagnoses with one process and with two, in turn, and whether the answers are the same to the last digit.

    python benchmarks/diagnosis_processes.py STUDY… [--rounds 2] [--jobs 2]

Each is a process of its own that remembers nothing, recordings are extracted anew. Figures are medians over rounds.
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import statistics
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

# before NumPy is loaded: one thread each
os.environ |= {f"{library}_NUM_THREADS": "1" for library in ("OMP", "OPENBLAS", "MKL")}

from statorhom import Study


def diagnosed(path: Path, jobs: int) -> tuple[float, str]:
    """Seconds, and the answer."""
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        found = Study.load(path).diagnose(Path(folder), jobs=jobs)
        return time.perf_counter() - begin, found.model_dump_json()


def _apart(path: Path, jobs: int) -> tuple[float, str]:
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        return pool.submit(diagnosed, path, jobs).result()


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("studies", type=Path, nargs="+")
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    for path in options.studies:
        runs = [(_apart(path, options.jobs), _apart(path, 1)) for _ in range(options.rounds)]
        several, one = (statistics.median(run[i][0] for run in runs) for i in (0, 1))
        same = "same" if len({answer for run in runs for _, answer in run}) == 1 else "DIFFERENT"
        name = f"{path.parent.name}/{path.name}"
        print(f"{name}: {several:.1f} s / {one:.1f} s = {several / one:.2f}, {same} answers", flush=True)


if __name__ == "__main__":
    main()
