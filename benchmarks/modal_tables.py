"""From file to modal table: processor seconds per stage for recordings of the paper's size.

    python benchmarks/modal_tables.py [FILE …] [--figures benchmarks/figures/modal_tables.json]

Without files a synthetic stack is measured: 24 × 6 points, one hammer point (144 FRFs), and 24 × 4 points, two
hammer points (192 FRFs), 6 001 lines, eight doublets, 0.5 % noise.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from statorhom.extraction.extract import extract  # noqa: E402
from statorhom.extraction.measured_modes import measured_modes  # noqa: E402
from statorhom.extraction.modal_table_text import modal_table, table_text  # noqa: E402
from statorhom.extraction.noise import expected_sd, noise_sd  # noqa: E402
from statorhom.extraction.point_grid import point_grid  # noqa: E402
from statorhom.extraction.stabilization import stabilize  # noqa: E402
from statorhom.recordings.read import read_recording  # noqa: E402
from statorhom.recordings.recording import Node, Recording  # noqa: E402
from statorhom.recordings.uff.writer import write_uff  # noqa: E402
from statorhom.study.atomic import write_text  # noqa: E402
from synthetic_frfs import frf_set, ring_points, ring_shape  # noqa: E402

LINES = np.arange(500.0, 6501.0)
MODES = ((2, 0, 900.0), (2, 1, 1300.0), (3, 0, 2400.0), (3, 1, 2900.0), (4, 0, 4100.0), (4, 1, 4600.0),
         (5, 0, 5600.0), (5, 1, 6000.0))  # fmt: skip
LOSS, SPLIT = 0.008, 2e-3


def synthetic(folder: Path, planes: int, hammers: int) -> Path:
    """Write a recording of doublets that are split by a quarter of their bandwidth."""
    points = ring_points(24, planes)
    poles, shapes = [], []
    for order, axial, frequency in MODES:
        for turn in (0.0, np.pi / (2 * order)):
            poles.append((frequency * (1 + SPLIT * (turn > 0)), LOSS))
            shapes.append(ring_shape(points, order, 0.3 + turn, axial))
    frfs = frf_set(LINES, points, [0, 27][:hammers], poles, np.array(shapes), noise=0.005)
    nodes = tuple(Node(point.node, point.position) for point in points if point.position is not None)
    path = folder / f"{planes * 24 * hammers}-frfs-{hammers}-hammer-points.uff"
    write_uff(path, Recording("synthetic stack", frf_sets=(frfs,), nodes=nodes))
    return path


def stages(path: Path) -> dict[str, float]:
    """Processor seconds of every stage, and the wall seconds of all; extraction is measured apart from the whole."""
    clock = [time.process_time()]

    def lap() -> float:
        clock.append(time.process_time())
        return clock[-1] - clock[-2]

    frf_sets = read_recording([path]).frf_sets
    took = {"reading": lap()}
    grid = point_grid(frf_sets)
    sd = expected_sd(grid, noise_sd(grid))
    took["noise"] = lap()
    stabilize(grid, sd)
    took["stabilization"] = lap()
    extract(frf_sets)
    took["fit of all windows"] = lap() - took["noise"] - took["stabilization"]
    wall = time.perf_counter()
    measured = measured_modes([path])
    table_text(modal_table(measured, path), measured.remarks)
    took["from file to modal table"] = lap()
    took["wall seconds of that"] = time.perf_counter() - wall
    before = sum(took[name] for name in ("reading", "noise", "stabilization", "fit of all windows"))
    took["names and hints"] = took["from file to modal table"] - before
    return took | {"modes": len(measured.modes)}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--figures", type=Path)
    options = parser.parse_args()
    figures = {}
    with TemporaryDirectory() as folder:
        files = options.files or [synthetic(Path(folder), 6, 1), synthetic(Path(folder), 4, 2)]
        for path in files:
            figures[path.name] = {name: round(value, 2) for name, value in stages(path).items()}
            print(path.name, figures[path.name], flush=True)
    if options.figures:
        write_text(options.figures, json.dumps(figures, indent=1) + "\n")


if __name__ == "__main__":
    main()
