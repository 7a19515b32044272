"""Time to read universal files, against pyuff on the same files, in the same run.

    python benchmarks/universal_files.py [FILE …]          (Linux)

Without files, a synthetic one of 200 MB is written to a temporary folder in text and as 58b.
"""

from __future__ import annotations

import multiprocessing
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pyuff

from statorhom.recordings.dof import Dof
from statorhom.recordings.frf_set import FrfSet
from statorhom.recordings.recording import Recording
from statorhom.recordings.uff.reader import read_uff
from statorhom.recordings.uff.writer import write_uff

LINES = 6901
BYTES = 200e6
BYTES_PER_LINE = {True: 16, False: 40.5}


def synthetic(path: Path, binary: bool) -> Path:
    """A file of `BYTES`."""
    count = int(BYTES / LINES / BYTES_PER_LINE[binary])
    rng = np.random.default_rng(0)
    accelerance = rng.standard_normal((count, LINES)) + 1j * rng.standard_normal((count, LINES))
    responses = tuple(Dof(node, direction=(0.0, 0.0, 1.0)) for node in range(1, count + 1))
    frf_set = FrfSet(100.0 + np.arange(LINES), responses, (responses[0],) * count, accelerance)
    write_uff(path, Recording("synthetic", (frf_set,)), binary=binary)
    return path


def measured(read: Callable[[Path], object], path: Path) -> tuple[float, float, float]:
    """Wall time and processor time (s), and the largest memory (MB) of a process that does nothing else."""
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        return pool.apply(_measure, (read, path))


def _measure(read: Callable[[Path], object], path: Path) -> tuple[float, float, float]:
    wall, cpu = time.perf_counter(), time.process_time()
    read(path)
    took = time.perf_counter() - wall, time.process_time() - cpu
    # getrusage would count the parent's memory too
    status = dict(line.split(":", 1) for line in Path("/proc/self/status").read_text().splitlines())
    return *took, int(status["VmHWM"].split()[0]) / 1024


def read_pyuff(path: Path) -> object:
    """All datasets of a file, by pyuff."""
    return pyuff.UFF(str(path)).read_sets()


def main() -> None:
    """Print one line per file and reader."""
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(name) for name in sys.argv[1:]] or [
            synthetic(Path(folder) / "text.uff", binary=False),
            synthetic(Path(folder) / "binary.uff", binary=True),
        ]
        for path in files:
            size = path.stat().st_size / 1e6
            ours, theirs = measured(read_uff, path), measured(read_pyuff, path)
            for name, (wall, cpu, memory) in (("statorhom", ours), ("pyuff", theirs)):
                print(f"{path.name}, {size:.0f} MB: {name} {wall:.2f} s ({cpu:.2f} s cpu), {memory:.0f} MB")
            print(f"{path.name}: pyuff over statorhom {theirs[1] / ours[1]:.1f} (processor times)")


if __name__ == "__main__":
    main()
