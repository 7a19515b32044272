"""Which simulated mode of a supported test each measured one is, by shape or by name, and what they differ by."""

from __future__ import annotations

from collections.abc import Mapping
from math import log

import numpy as np
from scipy.optimize import linear_sum_assignment

from statorhom.diagnose.features.mode_features import sd_and_least
from statorhom.diagnose.features.supported import SupportedReference, predicted_logs
from statorhom.diagnose.measured.feature import LOST, Feature
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.affine import Materials
from statorhom.model.convergence import ModeKey

LOG_SPREAD, MAC_SPREAD = 0.2, 0.2  # within which partners are sought
SPREADS, LEAST_SPREAD = 4.0, 0.02  # of the median distance of first partners; how near they are sought then
MIXED = 0.01  # relative: modes nearer than this to each other may be mixed in any way
ALIKE = 0.1  # of the largest singular value: shapes that the points tell apart
GATE = 9.0
NAME_COST = 4.0

Partners = tuple[int | None, ...]


def partners(
    stage: StageModel,
    test: MeasuredTest,
    reference: SupportedReference,
    modes: Mapping[ModeKey, PredictedMode],
    materials: Materials,
) -> Partners:
    """Number of the supported mode that each measured one is, by shape or by name."""
    logs = predicted_logs(stage, reference, modes, materials)
    away = np.log([m.frequency_hz for m in test.modes])[:, None] - logs[None, :]
    unlike = _unlike(test, reference, logs)
    first = _assigned((away / LOG_SPREAD) ** 2 + unlike)
    near = [abs(away[i, j]) for i, j in enumerate(first) if j is not None]
    # where most frequencies are met, none is far off
    spread = float(np.clip(SPREADS * np.median(near), LEAST_SPREAD, LOG_SPREAD)) if near else LOG_SPREAD
    return _assigned((away / spread) ** 2 + unlike)


def _unlike(test: MeasuredTest, reference: SupportedReference, logs: np.ndarray) -> np.ndarray:
    """What pairs (measured, simulated) cost for their shapes or names."""
    if reference.radial is not None and test.shapes is not None:
        return np.asarray(((1 - _mac(test, reference.radial, logs)) / MAC_SPREAD) ** 2)
    assert reference.names is not None, "solved without names"
    cost = np.zeros((len(test.modes), len(reference.names)))
    for i, mode in enumerate(test.modes):
        for j, (order, axial) in enumerate(reference.names):
            other = (mode.order is not None and mode.order != order) or (
                mode.axial is not None and mode.axial != axial
            )
            cost[i, j] = NAME_COST * other
    return cost


def _assigned(cost: np.ndarray) -> Partners:
    """Column of every row, None where none is near enough."""
    wide = np.hstack([cost, np.full((len(cost), len(cost)), 2 * GATE)])
    rows, columns = linear_sum_assignment(wide)
    return tuple(int(c) if c < cost.shape[1] else None for _, c in sorted(zip(rows, columns, strict=True)))


def _mac(test: MeasuredTest, radial: np.ndarray, logs: np.ndarray) -> np.ndarray:
    """MAC (measured, simulated): mean of that with a mode and that with its span with those of almost its frequency.

    Modes that lie so near each other mix by what nobody knows: only together are they those that were measured.
    """
    assert test.shapes is not None
    rows = [test.shapes.labels.index(m.label) for m in test.modes]
    a = np.nan_to_num(test.shapes.radial[rows]).reshape(len(rows), -1)
    a /= np.maximum(np.linalg.norm(a, axis=1, keepdims=True), 1e-300)
    b = np.where(np.isfinite(test.shapes.radial[rows][0]), radial, 0.0).reshape(len(radial), -1)
    b /= np.maximum(np.linalg.norm(b, axis=1, keepdims=True), 1e-300)
    alike, among = a @ b.T, b @ b.T
    near = np.abs(logs[:, None] - logs) < MIXED
    found = alike**2
    for j in np.flatnonzero(near.sum(axis=1) > 1):
        found[:, j] = (found[:, j] + _of_span(alike, among, near[j])) / 2
    return np.asarray(found)


def _of_span(alike: np.ndarray, among: np.ndarray, near: np.ndarray) -> np.ndarray:
    """MAC (measured,) with the span of some shapes, of which their products tell all.

    Parameters
    ----------
    alike : (measured, simulated) products of unit shapes.
    among : (simulated, simulated) the same.
    near : (simulated,) which span it.
    """
    squares, axes = np.linalg.eigh(among[np.ix_(near, near)])
    told = squares > ALIKE**2 * squares[-1]
    return np.asarray(np.sum((alike[:, near] @ axes[:, told]) ** 2 / squares[told], axis=1))


def supported_features(
    test: MeasuredTest, held: Partners, logs: np.ndarray, own: np.ndarray, discrepancy: float
) -> list[Feature]:
    """Frequencies of a supported test; each mode is a group of its own.

    Parameters
    ----------
    test, held : the modes and their partners.
    logs, own : ln f (Hz) of the simulated modes, and its error.
    discrepancy : relative standard deviation that is added to all frequencies.
    """
    found = []
    for number, (mode, partner) in enumerate(zip(test.modes, held, strict=True)):
        key = (mode.order if mode.order is not None else -1, mode.axial or 0, number)
        if partner is None or partner >= len(logs):
            found.append(Feature("frequency", test.name, None, LOST, 0.0, 1.0, lost=True, rows=(mode.label,)))
            continue
        sd, least = sd_and_least(mode, float(own[partner]), discrepancy)
        values = log(mode.frequency_hz), float(logs[partner])
        found.append(Feature("frequency", test.name, key, *values, sd, rows=(mode.label,), least=least))
    return found
