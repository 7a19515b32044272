"""Time of diagnoses with one process and with two, in turn, and whether the answers are the same to the last digit.

    python benchmarks/diagnosis_processes.py STUDY… [--rounds 2] [--jobs 2]

Recordings are extracted anew each time, as whoever waits for an answer does. Figures are medians over rounds.
"""

from __future__ import annotations

import argparse
import os
import statistics
import tempfile
import time
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


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("studies", type=Path, nargs="+")
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    for path in options.studies:
        runs = [(diagnosed(path, options.jobs), diagnosed(path, 1)) for _ in range(options.rounds)]
        several, one = (statistics.median(run[i][0] for run in runs) for i in (0, 1))
        same = "same" if len({answer for run in runs for _, answer in run}) == 1 else "DIFFERENT"
        name = f"{path.parent.name}/{path.name}"
        print(f"{name}: {several:.1f} s / {one:.1f} s = {several / one:.2f}, {same} answers", flush=True)


if __name__ == "__main__":
    main()
