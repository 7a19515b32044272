"""Modal tables with noise and missing modes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from statorhom.conceal.listed import ListedMode, resolved

FREQUENCY_SD = (2e-4, 1e-3)  # relative, one draw per mode
DAMPING_SD = 0.15
MISSING = (0.10, 0.30)
FEWEST = 3  # modes that stay
COLUMNS = "frequency_hz,damping_ratio,order,axial,frequency_sd_hz"


def shortened(
    modes: tuple[ListedMode, ...], rng: np.random.Generator, only: tuple[int, int] | None = None
) -> tuple[ListedMode, ...]:
    """Those of the visible modes that somebody wrote down.

    Parameters
    ----------
    modes : all of the band.
    rng : decides what is missing.
    only : the one mode (r, n) that is written down; None: all that are usual.
    """
    seen = [m for m in resolved(modes) if only is None or (m.order, m.axial) == only]
    names = sorted({(m.order, m.axial) for m in seen}, key=str)
    missing = min(round(rng.uniform(*MISSING) * len(names)), max(len(names) - FEWEST, 0))
    dropped = {names[i] for i in rng.permutation(len(names))[:missing]}
    return tuple(m for m in seen if (m.order, m.axial) not in dropped)


def relabelled(modes: tuple[ListedMode, ...], seed: int) -> tuple[tuple[ListedMode, ...], int, ListedMode]:
    """One mode under the name of another.

    Returns
    -------
    modes, row, true : with the wrong name, number of its row from 1, and the mode as it is.
    """
    rng = np.random.default_rng(seed)
    once = [
        i for i, m in enumerate(modes) if sum(n.order == m.order and n.axial == m.axial for n in modes) == 1
    ]
    row = int(rng.choice(once if once else len(modes)))
    true = modes[row]
    names = [(r, n) for r in range(1, 6) for n in range(3) if r + n > 1]
    near = [
        (r, n)
        for r, n in names
        if (r, n) != (true.order, true.axial) and abs(r - (true.order or 0)) + abs(n - (true.axial or 0)) == 1
    ]
    order, axial = near[int(rng.integers(len(near)))]
    wrong = replace(true, order=order, axial=axial)
    return (*modes[:row], wrong, *modes[row + 1 :]), row + 1, true


def table_text(modes: tuple[ListedMode, ...], rng: np.random.Generator) -> str:
    """The modes as CSV, with measurement noise."""
    rows = [COLUMNS]
    for mode in modes:
        sd = float(rng.uniform(*FREQUENCY_SD)) * mode.frequency_hz
        frequency = mode.frequency_hz + sd * rng.standard_normal()
        damping = 0.5 * mode.loss_factor * max(1 + DAMPING_SD * rng.standard_normal(), 0.3)
        name = ("" if n is None else str(n) for n in (mode.order, mode.axial))
        rows.append(f"{frequency:.2f},{damping:.5f},{','.join(name)},{sd:.2f}")
    return "\n".join([*rows, ""])
