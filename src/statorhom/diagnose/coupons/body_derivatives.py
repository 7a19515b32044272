"""Slopes of a coupon's features by the constants: first-order perturbation, so that nothing is solved anew.

∂λ_j = v_jᵀ(∂K - λ_j ∂M)v_j and ∂v_j = Σ_k v_k v_kᵀ(∂K - λ_j ∂M)v_j / (λ_j - λ_k) over the modes that are known.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.coupons.body_hypothesis import BodyHypothesis
from statorhom.diagnose.coupons.body_prediction import PredictedBody
from statorhom.diagnose.coupons.body_stage import BodyStage
from statorhom.diagnose.fits.derivatives import difference, jacobian
from statorhom.diagnose.fits.frequency_slopes import slopes_of
from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.errors import StatorhomError
from statorhom.model.affine import Materials, hooke_coefficients
from statorhom.model.modal.modal_body import ModalBody, hooke_factors, mass_factors

FloatArray = npt.NDArray[np.float64]
Scale = tuple[float, float, float]

STEP = 1e-4  # of internal coordinates
CLOSE = 1e-6  # of λ: modes that are one as far as slopes go


@jacobian.register
def _(h: BodyHypothesis, z: FloatArray) -> FloatArray:
    told = h.predictions(z)
    start = [f for f in h.features_told(z, told) if h.sees(f)]
    scale = h.study.scale(h.actions(z))
    terms = {name: _Terms(stage.body.basis, told[name], scale) for stage, name in h.tests}
    columns = [
        # a wing's known materials are most of its constants
        np.zeros(len(start)) if item.fixed else _constant_column(h, z, j, told, terms, start)
        for j, item in enumerate(h.study.constants.items)
    ]
    columns += [difference(h, z, j, start) for j in range(h.constants, len(z))]
    return np.array(columns).T.reshape(len(start), len(z))


def _constant_column(
    h: BodyHypothesis,
    z: FloatArray,
    j: int,
    told: Mapping[str, PredictedBody],
    terms: Mapping[str, _Terms],
    start: Sequence[Feature],
) -> FloatArray:
    upper = h.study.constants.limits[1][j]
    for sign in (1.0, -1.0) if z[j] + STEP <= upper else (-1.0,):
        moved = z.copy()
        moved[j] += sign * STEP
        try:
            near = _near(h, z, moved, told, terms)
        except StatorhomError:
            continue  # at the edge of what materials exist
        return slopes_of(start, [f for f in h.features_told(moved, near) if h.sees(f)], sign * STEP)
    return np.zeros(len(start))


def _near(
    h: BodyHypothesis,
    z: FloatArray,
    moved: FloatArray,
    told: Mapping[str, PredictedBody],
    terms: Mapping[str, _Terms],
) -> dict[str, PredictedBody]:
    """Predictions at a neighbouring point to first order."""
    before, after = (h.study.constants.values(p[: h.constants]) for p in (z, moved))
    found = {}
    for stage, name in h.tests:
        here = [a for a in h.actions(z) if a.touches(stage.name, name)]
        there = [h.study.materials(stage.setup, values, here) for values in (before, after)]
        mesh = after[f"{stage.name}:mesh"] - before[f"{stage.name}:mesh"]
        found[name] = terms[name].moved(stage, h.test(name), told[name], there[0], there[1], mesh)
    return found


class _Terms:
    """Stiffness and mass of a body between the modes of a prediction."""

    def __init__(self, basis: ModalBody, told: PredictedBody, scale: Scale) -> None:
        v = told.solved.vectors
        hooke, inertia = hooke_factors(scale), mass_factors(scale)
        self.stiffness = {
            r: hooke[:, None, None] * np.stack([v.T @ (K @ v) for K in terms])
            for r, terms in basis.stiffness.items()
            if len(terms) > 1
        }
        self.mass = {r: v.T @ np.tensordot(inertia, terms, axes=1) @ v for r, terms in basis.mass.items()}

    def moved(
        self,
        stage: BodyStage,
        test: MeasuredTest,
        told: PredictedBody,
        before: Materials,
        after: Materials,
        mesh: float,
    ) -> PredictedBody:
        """The prediction with other materials."""
        values = told.solved.values
        K, M = np.zeros((len(values), len(values))), np.zeros((len(values), len(values)))
        for region, terms in self.stiffness.items():
            change = hooke_coefficients(after[region].hooke) - hooke_coefficients(before[region].hooke)
            K += np.tensordot(change, terms, axes=1)
        for region, term in self.mass.items():
            M += (after[region].density - before[region].density) * term
        log_f = told.log_f + mesh * told.shared
        if not K.any() and not M.any():
            return replace(told, log_f=log_f)
        coupling = K - M * values[None, :]  # column j: (∂K - λ_j ∂M) v_j
        own = np.diag(coupling)[told.elastic] / values[told.elastic]
        log_f = log_f + 0.5 * own
        if told.motion is None or test.points is None:
            return replace(told, log_f=log_f)
        apart = values[None, :] - values[:, None]
        far = np.abs(apart) > CLOSE * np.maximum(values[None, :], 1.0)
        mixed = np.where(far, coupling / np.where(far, apart, 1.0), 0.0)
        turned = told.solved.vectors @ mixed[:, told.elastic]
        return replace(told, log_f=log_f, motion=told.motion + stage.motion(test) @ turned)
