"""Loss factors: of the modes from those of the materials, by their shares of the strain energy.

η = Σ share · η_source, as in `statorhom.identify.results.damping`. Modal loss factors scatter by 10-20 % from test to
test, so that they weigh little; what they tell is which part of a stator a mode's damping comes from.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import exp, hypot, log

from statorhom.diagnose.features.line_weights import line_weights
from statorhom.diagnose.features.supported import SupportedReference
from statorhom.diagnose.features.supported_partners import Partners
from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import (
    PredictedMode,
    acted_materials,
    material_vector,
    slopes_by_materials,
)
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.diagnose.stages.study_model import StudyModel
from statorhom.model.convergence import ModeKey
from statorhom.physics.action import Action
from statorhom.study.modal_table import MeasuredMode

LOSS_SD = 0.2  # of ln η: suspension, cables, windowing
LEAST = 1e-6  # predicted loss factor
JOINT = "joint"  # source of what a contact loses

Modes = Mapping[ModeKey, PredictedMode]


def is_damped(study: StudyModel, test: MeasuredTest) -> bool:
    """Whether a test's loss factors are predicted."""
    return bool(study.constants.losses) and any(m.loss_factor is not None for m in test.modes)


def with_shares(
    study: StudyModel,
    stage: StageModel,
    test: MeasuredTest,
    modes: Modes,
    values: Mapping[str, float],
    actions: Sequence[Action],
) -> dict[ModeKey, PredictedMode]:
    """The modes with their shares of the strain energy by source of material."""
    materials = acted_materials(study, stage, values, actions, test.name)
    vector = material_vector(materials, tuple(materials))
    source = {region.region: region.source for region in stage.setup.materials.regions}
    found = dict(modes)
    for key, slope in slopes_by_materials(stage, materials, modes).items():
        energy = (2 * slope * vector).reshape(-1, 10)[:, :9].sum(axis=1)
        shares: dict[str, float] = {}
        for region, share in zip(materials, energy.tolist(), strict=True):
            shares[source[region]] = shares.get(source[region], 0.0) + share
        shares[JOINT] = max(0.0, 1.0 - sum(shares.values()))
        found[key] = replace(modes[key], shares=shares)
    return found


def losses_of(
    study: StudyModel,
    stage: StageModel,
    modes: Modes,
    values: Mapping[str, float],
    actions: Sequence[Action],
) -> dict[ModeKey, float]:
    """Loss factors of modes whose shares are known, with what the contacts lose that actions bring."""
    own = study.constants.losses[stage.setup.index]
    contact = sum(a.joint.loss_factor for a in actions if a.joint is not None and a.touches(stage.name))
    found = {}
    for key, mode in modes.items():
        if mode.shares:
            total = sum(share * values[own[s]] for s, share in mode.shares.items() if s in own)
            sticks = max(float(total) + mode.shares.get(JOINT, 0.0) * contact, LEAST)
            found[key] = sticks + mode.friction
    return found


def free_losses(
    test: MeasuredTest,
    measured: Sequence[MeasuredMode],
    keys: Sequence[ModeKey | None],
    losses: Mapping[ModeKey, float],
) -> list[Feature]:
    """One feature per mode with a partner; the two of a doublet count as one.

    Parameters
    ----------
    test, measured, keys : the modes and their partners.
    losses : predicted loss factors.
    """
    found = []
    for key in dict.fromkeys(k for k in keys if k is not None):
        known = mean_loss(measured, keys, key)
        if known is None:
            continue
        if key in losses:
            mean, own = known
            found.append(Feature("loss", test.name, key, log(mean), log(losses[key]), hypot(LOSS_SD, own)))
        else:
            found.append(Feature("loss", test.name, key, 0.0, 0.0, 1.0, lost=True))
    return found


def mean_loss(
    measured: Sequence[MeasuredMode], keys: Sequence[ModeKey | None], key: ModeKey
) -> tuple[float, float] | None:
    """Geometric mean of the loss factors of a mode's lines by what these say of it, and the standard deviation of ln η.

    None where none was measured.
    """
    own = [(m, log(m.loss_factor)) for m, k in zip(measured, keys, strict=True) if k == key and m.loss_factor]
    if not own:
        return None
    lines, logs = zip(*own, strict=True)
    weights = line_weights(lines)
    return exp(float(weights @ logs)), hypot(*(weights * [_own_sd(m) for m in lines]).tolist())


def supported_losses(
    test: MeasuredTest,
    held: Partners,
    reference: SupportedReference,
    losses: Mapping[ModeKey, float],
    support: float,
) -> list[Feature]:
    """The same of a supported test: the free modes that it is made of, and the springs.

    Parameters
    ----------
    test, held : the modes and their partners.
    reference : what the supported modes are made of.
    losses : of the free modes.
    support : loss factor of the support's springs.
    """
    found = []
    for number, (mode, partner) in enumerate(zip(test.modes, held, strict=True)):
        if mode.loss_factor is None or partner is None:
            continue
        key = (mode.order if mode.order is not None else -1, mode.axial or 0, number)
        shares = {
            k: float(s[partner]) for k, s in reference.shares.items() if k in losses and partner < len(s)
        }
        whole = sum(shares.values())
        if whole <= 0.0 or partner >= len(reference.held):
            found.append(Feature("loss", test.name, key, 0.0, 0.0, 1.0, lost=True, rows=(mode.label,)))
            continue
        springs = float(reference.held[partner])
        # shapes that bear no name lose as those that do
        own = sum(share * losses[k] for k, share in shares.items()) / whole
        loss = max((1.0 - springs) * own + springs * support, LEAST)
        seen, told = log(mode.loss_factor), log(loss)
        sd = hypot(LOSS_SD, _own_sd(mode))
        found.append(Feature("loss", test.name, key, seen, told, sd, rows=(mode.label,)))
    return found


def _own_sd(mode: MeasuredMode) -> float:
    """Standard deviation of ln η by its measurement alone."""
    return (mode.loss_factor_sd or 0.0) / mode.loss_factor if mode.loss_factor else 0.0
