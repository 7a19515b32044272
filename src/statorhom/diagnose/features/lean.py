"""How far a mode's radial motion leans to one end of the stator: what differs along the axis mixes axial parities.

A stator that is its own mirror image has shapes that are even or odd about the middle. Stiffness that rises from end to
end, or a mass near one end, couples (r, 0) with (r, 1): the shape of (r, 0) gets an odd part, its lean, which is the
slope of a straight line over the measuring planes, times half their span, over its mean (physics.md §6, stack pressure
gradient). Frequencies feel the coupling in the second order only. The even part of (r, 1) tells the same, and as much
of where the measuring planes really were: it is not used.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import hypot

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.measured.measured_test import MeasuredTest, PlaneShifts, Sideband
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.model.convergence import ModeKey
from statorhom.study.modal_table import MeasuredMode

FloatArray = npt.NDArray[np.float64]
# Per order: sensors that stand half a degree off show that much of the other parity. And of the lean itself: it rests
# on how far apart the two parities' frequencies are.
OWN, PART = 0.002, 0.2
# Of the leans of a test, root mean square: what a local cause bends and what of it shears nearly cancels in some mode.
TYPICAL_PART = 0.1
MOST_SD = 0.05  # shapes that are known no better tell nothing
# Broad resonances show some of their neighbours, and what leans by more than this is no (r, 0) by itself.
BROAD, MOST_LEAN = 0.03, 0.3
# Of half a loss factor: what a roving sensor may move poles by from plane to plane. A shape that is taken at one pole
# leans by what the others are off.
MOVED = 0.02
# Standard deviations of two planes' difference, up to which it may be noise: a weak mode's shifts say nothing.
NOISE = 3.0


def lean_features(
    test: MeasuredTest,
    modes: Sequence[MeasuredMode],
    keys: Sequence[ModeKey | None],
    predicted: Mapping[ModeKey, PredictedMode],
    heights_m: Sequence[float],
) -> list[Feature]:
    """Leans of the lowest modes (r, 0) whose shapes were measured in several planes; higher ones mix with too much.

    Parameters
    ----------
    test, modes : the measurement, names corrected.
    keys : partner of every mode.
    predicted : modes by key.
    heights_m : where predicted profiles were taken (`PredictedMode.profile`).
    """
    shapes = {} if _moves(test) else {s.label: s for s in test.sidebands}
    leans: dict[ModeKey, tuple[float, float, FloatArray]] = {}
    for key in dict.fromkeys(k for k in keys if k is not None and k[1:] == (0, 0)):
        rows = [m for m, k in zip(modes, keys, strict=True) if k == key and m.axial == 0 and _is_sharp(m)]
        seen = [s for m in rows if (s := shapes.get(m.label)) is not None and np.ptp(s.z_m) > 0]
        measured = _mean([_measured(s, key[0]) for s in seen])
        if measured is not None and abs(measured[0]) <= MOST_LEAN:
            leans[key] = (*measured, seen[0].z_m)
    typical = float(np.sqrt(np.mean([value**2 for value, _, _ in leans.values()]))) if leans else 0.0
    found = []
    for key, (value, noise, z_m) in leans.items():
        mode = predicted.get(key)
        if mode is None or mode.profile is None:
            # as many features as with it: a partner that vanishes says nothing of shapes
            found.append(Feature("lean", test.name, key, 0.0, 0.0, 1.0, lost=True))
            continue
        sd = hypot(noise, OWN * max(1, key[0]), PART * value, TYPICAL_PART * typical)
        told = profile_lean(mode.profile, np.array(heights_m), z_m)
        found.append(Feature("lean", test.name, key, value, told, sd))
    return found


def _moves(test: MeasuredTest) -> bool:
    """Whether a sensor moves a test's poles by enough to change shapes."""
    losses = {m.label: m.loss_factor for m in test.modes}
    return any(
        _moved(s) > MOVED * 0.5 * loss for s in test.shifts if (loss := losses.get(s.label)) is not None
    )


def _moved(shifts: PlaneShifts) -> float:
    """How far a pole certainly moves between the planes where it is highest and lowest."""
    most, least = int(shifts.shift.argmax()), int(shifts.shift.argmin())
    doubt = hypot(shifts.sd[most], shifts.sd[least])
    return float(shifts.shift[most] - shifts.shift[least]) - NOISE * doubt


def _is_sharp(mode: MeasuredMode) -> bool:
    return (mode.loss_factor or 0.0) < BROAD


def profile_lean(profile: FloatArray, heights_m: FloatArray, z_m: FloatArray) -> float:
    """Lean of a profile (p,) over heights, as planes at z_m show it."""
    along = np.interp(z_m, heights_m, profile)
    basis = np.column_stack([np.ones_like(z_m), 2 * (z_m - z_m.min()) / np.ptp(z_m) - 1])
    mean, slope = np.linalg.lstsq(basis, along, rcond=None)[0]
    return float(slope / mean)


def _measured(shape: Sideband, order: int) -> tuple[float, float] | None:
    """Lean and its standard deviation; None where the shape is of another order, or too noisy."""
    if shape.order != order:
        return None
    even, odd = (np.array([part[i, order] for part in (shape.cosine, shape.sine)]) for i in (0, 1))
    size = float(np.linalg.norm(even))
    sd = float(shape.sd[1, order]) / size if size > 0 else np.nan
    return (float(even @ odd) / size**2, sd) if sd < MOST_SD else None


def _mean(values: Sequence[tuple[float, float] | None]) -> tuple[float, float] | None:
    """Of a doublet's modes; None without any."""
    known = np.array([v for v in values if v is not None])
    if not len(known):
        return None
    return float(known[:, 0].mean()), float(np.linalg.norm(known[:, 1]) / len(known))
