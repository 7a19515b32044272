"""Doublets found by split, noise and number of references: statorhom, sdypy-EMA, pyFBS and the circle fit.

Synthetic rings: 24 × 4 points, two modes of one order turned by a quarter wave against each other, a further mode
on each side, noise in proportion to the magnitude and a floor 70 dB below the largest value. A doublet counts as
found when exactly two poles are reported within two bandwidths and each lies within a quarter of the split, or
2 % of the bandwidth, of a true one.

    python benchmarks/doublets.py --trials 5 --figures benchmarks/figures/doublets.json
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import os
import sys
import time
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from statorhom.errors import ExtractionError  # noqa: E402
from statorhom.extraction import circle_fit, extract  # noqa: E402
from statorhom.recordings.frf_set import FrfSet  # noqa: E402
from statorhom.study.atomic import write_text  # noqa: E402
from synthetic_frfs import frf_set, ring_points, ring_shape  # noqa: E402

SPLITS = (0.1, 0.25, 0.5, 1.0, 2.0)  # of the half-power bandwidth
NOISES = (0.003, 0.01, 0.03)
FREQUENCY_HZ, LOSS = 1500.0, 0.01
BANDWIDTH_HZ = FREQUENCY_HZ * LOSS
AXIS_HZ = np.arange(1000.0, 2200.0)


def ring(split: float, noise: float, references: int, seed: int) -> tuple[FrfSet, list[float]]:
    """FRFs of a ring and the doublet's two frequencies."""
    rng = np.random.default_rng(seed)
    points = ring_points(24, 4)
    order, angle = int(rng.integers(2, 5)), float(rng.uniform(0.1, 0.4))
    quarter = np.pi / (2 * order)
    pair = [FREQUENCY_HZ + rng.uniform(-5, 5)]
    pair.append(pair[0] + split * BANDWIDTH_HZ)
    poles = [(1200.0, LOSS), *((one, LOSS) for one in pair), (1950.0, LOSS)]
    shapes = np.array(
        [
            ring_shape(points, 2, 0.3),
            ring_shape(points, order, angle / order),
            ring_shape(points, order, angle / order + quarter),
            ring_shape(points, order + 1, 0.2, axial=1),
        ]
    )
    # the second hammer point lies where it excites the pair in another proportion
    rows = [0, round(24 / (4 * order) * 0.8) + 24][:references]
    return frf_set(AXIS_HZ, points, rows, poles, shapes, noise=noise, seed=seed), pair


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Without the progress bars of others."""
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        yield


def ours(frfs: FrfSet, _: list[float]) -> np.ndarray:
    return np.array([mode.frequency_hz for mode in extract(frfs).modes])


def sdypy(frfs: FrfSet, pair: list[float]) -> np.ndarray:
    """Poles that sdypy-EMA returns when it is told where to look: it takes the two true frequencies as picks."""
    from sdypy import EMA

    with warnings.catch_warnings(), quiet(), contextlib.suppress(Exception):
        warnings.simplefilter("ignore")
        model = EMA.Model(
            frfs.accelerance[: len(set(frfs.responses))],
            frfs.frequency_hz,
            lower=float(AXIS_HZ[0]),
            upper=float(AXIS_HZ[-1]),
            pol_order_high=40,
            frf_form="accelerance",
        )
        model.get_poles(show_progress=False)
        model.select_closest_poles(pair)
        return np.array(model.nat_freq, dtype=float)
    return np.zeros(0)


def pyfbs(frfs: FrfSet, pair: list[float]) -> np.ndarray:
    """Of pyFBS's poles that are stable in frequency and damping at any order, the nearest to each true frequency.

    Its estimator needs an axis that begins at 0: the lines are moved there and the poles back.
    """
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    with warnings.catch_warnings(), quiet(), contextlib.suppress(Exception):
        warnings.simplefilter("ignore")
        from pyfbs.modal_id.modal_id import ModalID

        points = len(set(frfs.responses))
        matrix = frfs.receptance.reshape(-1, points, len(AXIS_HZ)).transpose(2, 1, 0)
        model = ModalID(AXIS_HZ - AXIS_HZ[0], matrix)
        model.p_lscf(max_order=40)
        stable = [row[1] for row in model.stab_plot if row[3] >= 2]
        poles = np.concatenate([found[0] for found in model.poles])
        # the axis moved: only a pole's imaginary part tells its frequency
        damped = np.abs(poles.imag)[np.isin(np.abs(poles) / (2 * np.pi), stable)] / (2 * np.pi) + AXIS_HZ[0]
        return np.array([damped[np.argmin(np.abs(damped - one))] for one in pair])
    return np.zeros(0)


def sdof(frfs: FrfSet, _: list[float]) -> np.ndarray:
    """Circle fits around the peaks of the summed magnitude."""
    power = np.sum(np.abs(frfs.receptance), axis=0)
    smooth = np.convolve(np.pad(power, 2, mode="edge"), np.ones(5) / 5, "valid")
    peaks = np.flatnonzero((smooth[1:-1] > smooth[:-2]) & (smooth[1:-1] > smooth[2:])) + 1
    found = []
    for peak in peaks[smooth[peaks] > 0.05 * smooth.max()]:
        strongest = int(np.argmax(np.abs(frfs.receptance[:, peak])))
        lines = slice(max(0, peak - 10), peak + 11)
        with contextlib.suppress(ExtractionError), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found.append(circle_fit(AXIS_HZ[lines], frfs.receptance[strongest, lines]).frequency_hz)
    return np.array(found)


METHODS: dict[str, Callable[[FrfSet, list[float]], np.ndarray]] = {
    "statorhom": ours,
    "sdypy-EMA": sdypy,
    "pyFBS": pyfbs,
    "circle fit": sdof,
}


def resolved(found: np.ndarray, pair: list[float]) -> bool:
    near = np.sort(found[np.abs(found - np.mean(pair)) < 2 * BANDWIDTH_HZ + abs(pair[1] - pair[0])])
    tolerance = max(0.25 * abs(pair[1] - pair[0]), 0.02 * BANDWIDTH_HZ)
    return len(near) == 2 and bool(np.all(np.abs(near - pair) < tolerance))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--trials", type=int, default=5)
    parser.add_argument("--figures", type=Path)
    options = parser.parse_args()
    rows = []
    for references in (1, 2):
        for noise in NOISES:
            for split in SPLITS:
                sets = [ring(split, noise, references, seed) for seed in range(options.trials)]
                row: dict[str, float] = {"references": references, "noise": noise, "split": split}
                for name, method in METHODS.items():
                    begin = time.process_time()
                    row[name] = float(np.mean([resolved(method(frfs, pair), pair) for frfs, pair in sets]))
                    row[f"{name} s"] = (time.process_time() - begin) / options.trials
                rows.append(row)
                print("  ".join(f"{key} {value:.3g}" for key, value in row.items()), flush=True)
    if options.figures:
        write_text(options.figures, json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    main()
