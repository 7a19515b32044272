"""Measured against predicted modes of a coupon: frequencies, shapes, and poles that move with a roving sensor.

A shape is told by its amplitudes in the declared body's modes. Without anything left out each measured shape is one
of them; a lump mixes them, each with the weight φ_k m φ_j λ/(λ_k - λ): that tells mirrored places apart.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.coupons.body_pairing import Partners
from statorhom.diagnose.coupons.body_prediction import PredictedBody
from statorhom.diagnose.coupons.body_stage import BodyStage
from statorhom.diagnose.features.mode_features import sd_and_least
from statorhom.diagnose.measured.feature import LOST_UNNAMED, NUMBERED, Feature
from statorhom.diagnose.measured.measured_test import SHIFT_OWN, SHIFT_PART, MeasuredTest
from statorhom.model.convergence import ModeKey

FloatArray = npt.NDArray[np.float64]

SHAPE_OWN = 0.01  # of amplitudes: places and directions of the sensors, calibration
SHAPE_PART = 0.05
WIDER = 5.0  # of a discrepancy of frequencies: what it makes of shapes
UNEVEN = (
    1.5e-3  # relative stiffness by which no body is as even as its model: neighbours in frequency mix by it
)
NEIGHBOURS = 8  # modes of the declared body, the nearest in frequency, whose amplitudes tell most


def body_features(
    stage: BodyStage,
    test: MeasuredTest,
    held: Partners,
    predicted: PredictedBody,
    sensor_kg: float,
    discrepancy: float = 0.0,
) -> list[Feature]:
    """All features of a test, in an order that does not depend on the prediction.

    Parameters
    ----------
    held : number of the predicted mode of every measured one.
    sensor_kg : of a roving sensor.
    discrepancy : relative standard deviation that is added to all frequencies, and `WIDER` times to shapes.
    """
    found: list[Feature] = []
    for number, (mode, partner) in enumerate(zip(test.modes, held, strict=True)):
        key = (number + 1, NUMBERED, 0)
        if partner is None or partner >= len(predicted.log_f):
            found.append(Feature("frequency", test.name, key, LOST_UNNAMED, 0.0, 1.0, lost=True))
            continue
        sd, least = sd_and_least(mode, float(predicted.own[partner]), discrepancy)
        measured, log_f = float(np.log(mode.frequency_hz)), float(predicted.log_f[partner])
        found.append(Feature("frequency", test.name, key, measured, log_f, sd, least=least))
        if test.points is not None:
            found += _shape(stage, test, number, key, predicted, partner, WIDER * discrepancy)
            found += _shift(test, number, key, predicted, partner, sensor_kg)
    return found


def _shape(
    stage: BodyStage,
    test: MeasuredTest,
    number: int,
    key: ModeKey,
    predicted: PredictedBody,
    partner: int,
    wide: float,
) -> list[Feature]:
    """Amplitudes in the reference's modes, the predicted shape as large as fits best."""
    assert test.points is not None and predicted.motion is not None
    W = stage.projector(test)
    seen = W @ test.points.motion[number]
    size = float(np.linalg.norm(seen))
    seen = seen / size
    noise = np.sqrt(W**2 @ test.points.sd[number] ** 2) / size
    model = W @ predicted.motion[:, partner]
    model = model * float(seen @ model) / float(model @ model)
    sd = np.sqrt(
        noise**2
        + wide**2
        + SHAPE_OWN**2
        + (SHAPE_PART * seen) ** 2
        + _mixing(stage, test, number, len(W), float(predicted.own[partner])) ** 2
    )
    return [
        Feature("shape", test.name, key, float(seen[i]), float(model[i]), float(sd[i]))
        for i in _nearest(stage, test, number, len(W))
    ]


def _nearest(stage: BodyStage, test: MeasuredTest, number: int, count: int) -> list[int]:
    """Numbers of the reference's modes that a measured one may be mixed with, itself included."""
    basis = stage.body.basis
    first = min(basis.rigid, count)
    away = np.abs(np.log(basis.reference_hz[first:count] / test.modes[number].frequency_hz))
    return sorted((first + np.argsort(away)[: NEIGHBOURS + 1]).tolist())


def _mixing(stage: BodyStage, test: MeasuredTest, number: int, count: int, own: float) -> FloatArray:
    """How much of other modes unevenness mixes into a measured one, and what the mesh gets wrong of it alone."""
    uneven = float(np.hypot(UNEVEN, 2.0 * own))
    values = stage.body.basis.reference_hz[:count] ** 2
    square = test.modes[number].frequency_hz ** 2
    return np.asarray(uneven * square / np.maximum(np.abs(values - square), uneven * square))


def _shift(
    test: MeasuredTest, number: int, key: ModeKey, predicted: PredictedBody, partner: int, sensor_kg: float
) -> list[Feature]:
    """Mass of a sensor that a mode's poles tell as they move from point to point, δf/f = -½ m |φ|².

    The regression over the points is one number per mode, and all that these say of the mass.
    """
    points = test.points
    assert points is not None and predicted.speed is not None
    if points.shift is None or points.shift_sd is None:
        return []
    usable = np.isfinite(points.shift[number]) & np.isfinite(points.shift_sd[number])
    if np.count_nonzero(usable) < 4:
        return []
    weight = 1.0 / (points.shift_sd[number, usable] ** 2 + SHIFT_OWN**2)
    speed = predicted.speed[usable, partner]
    speed = speed - float(weight @ speed / weight.sum())
    moved = points.shift[number, usable]
    scale = float(np.sqrt(weight @ speed**2 / weight.sum()))
    slope = float(weight @ (speed * moved) / (weight @ speed**2)) * scale
    left = moved - float(weight @ moved / weight.sum()) - slope / scale * speed
    spread = float(weight @ left**2) / max(int(np.count_nonzero(usable)) - 2, 1)
    # many points leave little noise; how well the model knows the shape and its modal mass they do not tell
    sd = float(np.hypot(np.sqrt(max(spread, 1.0) / weight.sum()), SHIFT_PART * slope))
    return [Feature("shift", test.name, key, slope, -0.5 * sensor_kg * scale, sd)]
