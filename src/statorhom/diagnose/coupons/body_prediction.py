"""Predicted modes of a coupon's test under constants and what a hypothesis adds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.coupons.body_stage import BodyStage
from statorhom.diagnose.coupons.body_study import BodyStudy
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.model.modal.acted_body import BodyModes
from statorhom.physics.action import Action

FloatArray = npt.NDArray[np.float64]

RIGID_SHARE = 0.5  # of a mode's mass in rigid-body motion, from which on no table lists it


@dataclass(frozen=True, eq=False)
class PredictedBody:
    """Elastic modes by frequency.

    Parameters
    ----------
    log_f : (n,) ln of the frequencies (Hz), mesh factor included.
    own : (n,) relative model error that others do not share.
    visibility : (n,) 0 … 1.
    motion : (p, n) at the points of the test; None where it has none.
    speed : (p, n) squared displacement in all directions there (1/kg); None where it has none.
    solved, elastic : all modes, and which of them these are.
    shared : (n,) relative standard deviation that one unit of the mesh's coordinate stands for.
    """

    log_f: FloatArray
    own: FloatArray
    visibility: FloatArray
    motion: FloatArray | None
    speed: FloatArray | None
    solved: BodyModes
    elastic: npt.NDArray[np.int_]
    shared: FloatArray


def predicted_body(
    study: BodyStudy,
    stage: BodyStage,
    test: MeasuredTest,
    values: Mapping[str, float],
    actions: Sequence[Action],
) -> PredictedBody:
    """Modes of a test.

    Raises
    ------
    StatorhomError
        If no body has these constants or additions.
    """
    here = [a for a in actions if a.touches(stage.name, test.name)]
    found = stage.body.modes(
        study.materials(stage.setup, values, here),
        stage.count,
        [one for a in here for one in a.attachments],
        [one for a in here for one in a.patches],
        study.scale(here),
    )
    basis, known = stage.body.basis, stage.known
    shares = (basis.reference.T @ found.vectors) ** 2
    rigid = shares[: basis.rigid].sum(axis=0) / np.sum(found.vectors**2, axis=0)
    elastic = np.flatnonzero((rigid < RIGID_SHARE) & (found.values > 0))
    of_mode = shares[basis.rigid :, elastic]
    of_mode = of_mode / np.maximum(of_mode.sum(axis=0), 1e-300)

    def mean(of_reference: FloatArray) -> FloatArray:
        return np.asarray(of_reference[basis.rigid :] @ of_mode)

    log_f = 0.5 * np.log(found.values[elastic]) - np.log(2 * np.pi) + mean(known.log_factor)
    shared, own, seen = mean(known.shared), mean(known.own), mean(known.visibility)
    log_f = log_f + values[f"{stage.name}:mesh"] * shared
    if test.points is None:
        return PredictedBody(log_f, own, seen, None, None, found, elastic, shared)
    vectors = found.vectors[:, elastic]
    moved = np.einsum("pdk,kn->pdn", basis.motion(test.points.positions), vectors)
    speed = np.sum(moved**2, axis=1)
    sensor = sum(a.sensor_kg for a in here)
    motion = np.einsum("pd,pdn->pn", test.points.directions, moved)
    log_f = log_f - 0.5 * sensor * speed.mean(axis=0)
    return PredictedBody(log_f, own, seen, motion, speed, found, elastic, shared)
