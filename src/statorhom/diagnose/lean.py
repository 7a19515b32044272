"""How far a mode's radial motion leans to one end of the stator: what differs along the axis mixes axial parities.

A stator that is its own mirror image has shapes that are even or odd about the middle. Stiffness that rises from end to
end couples (r, 0) with (r, 1), and every shape of the two gets a part of the other parity: its lean, the odd part over
the even one for n = 0 and the other way round for n = 1, each as a straight line over the measuring planes shows it
(physics.md §6, stack pressure gradient). Frequencies feel the same in the second order only.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.features import Feature
from statorhom.diagnose.measured import MeasuredTest, Sideband
from statorhom.diagnose.prediction import PredictedMode
from statorhom.model.convergence import ModeKey
from statorhom.study.modal_table import MeasuredMode

FloatArray = npt.NDArray[np.float64]
COUNTS = (0, 1)  # node planes of which a straight line tells the parities
# Per order: sensors that stand half a degree off show that much of the other parity. And of the lean itself: it rests
# on how far apart the two parities' frequencies are.
OWN, PART = 0.002, 0.2
MOST_SD = 0.05  # shapes that are known no better tell nothing


def lean_features(
    test: MeasuredTest,
    modes: Sequence[MeasuredMode],
    keys: Sequence[ModeKey | None],
    predicted: Mapping[ModeKey, PredictedMode],
    heights_m: Sequence[float],
) -> list[Feature]:
    """Leans of the named modes whose shapes were measured in several planes.

    Parameters
    ----------
    test, modes : the measurement, names corrected.
    keys : partner of every mode.
    predicted : modes by key.
    heights_m : where predicted profiles were taken (`PredictedMode.profile`).
    """
    shapes = {s.label: s for s in test.sidebands}
    found = []
    for key in dict.fromkeys(k for k in keys if k is not None and k[1] in COUNTS):
        rows = [m for m, k in zip(modes, keys, strict=True) if k == key and m.axial == key[1]]
        seen = [s for m in rows if (s := shapes.get(m.label)) is not None and len(s.z_m) > 1]
        measured = _mean([_measured(s, *key[:2]) for s in seen])
        if measured is None:
            continue
        value, noise = measured
        sd = float(np.linalg.norm([noise, OWN * max(1, key[0]), PART * value]))
        mode = predicted.get(key)
        if mode is None or mode.profile is None:
            # as many features as with it: a partner that vanishes says nothing of shapes
            found.append(Feature("lean", test.name, key, 0.0, 0.0, 1.0, lost=True))
            continue
        told = profile_lean(mode.profile, np.array(heights_m), seen[0].z_m, key[1])
        found.append(Feature("lean", test.name, key, value, told, sd))
    return found


def profile_lean(profile: FloatArray, heights_m: FloatArray, z_m: FloatArray, axial: int) -> float:
    """Lean of a profile (p,) over heights, as planes at z_m show it."""
    along = np.interp(np.sort(z_m), heights_m, profile)
    height = np.sort(z_m) - z_m.min()
    basis = np.column_stack([np.ones_like(height), 2 * height / np.ptp(z_m) - 1])
    parts = np.linalg.lstsq(basis, along, rcond=None)[0]
    return float(parts[1 - axial] / parts[axial])


def _measured(shape: Sideband, order: int, axial: int) -> tuple[float, float] | None:
    """Lean and its standard deviation; None where the shape hardly moves in its own parity."""
    if shape.order != order:
        return None
    own, other = (
        np.array([part[i, order] for part in (shape.cosine, shape.sine)]) for i in (axial, 1 - axial)
    )
    size = float(np.linalg.norm(own))
    sd = float(shape.sd[1 - axial, order]) / size if size > 0 else np.nan
    return (float(own @ other) / size**2, sd) if sd < MOST_SD else None


def _mean(values: Sequence[tuple[float, float] | None]) -> tuple[float, float] | None:
    """Of a doublet's modes; None without any."""
    known = np.array([v for v in values if v is not None])
    if not len(known):
        return None
    return float(known[:, 0].mean()), float(np.linalg.norm(known[:, 1]) / len(known))
