"""Tests of one stage at several force levels: what changes with the level is a feature of its own.

The lowest level's test stands for the stage's frequencies and splits. Of the others only the change against it counts:
the model's errors are the same at all levels.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.features.damping import mean_loss
from statorhom.diagnose.features.line_weights import line_weights
from statorhom.diagnose.features.mode_features import measured_sd
from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.convergence import ModeKey
from statorhom.physics.action import Friction
from statorhom.physics.friction import iwan_resonance, jenkins_resonance
from statorhom.study.modal_table import MeasuredMode
from statorhom.study.study_file import FREE

FREQUENCY_OWN, FREQUENCY_PART = (
    1e-4,
    0.2,
)  # a hammer's levels repeat so well; a lumped contact is so good a model
LOSS_OWN, TYPED_LOSS_OWN, LOSS_PART = 0.06, 0.2, 0.25  # of ln η: extracted here, typed
HIT = np.sqrt(2.0)  # radial motion where the hammer hits, an antinode, over its mean square around the stator
USUAL_LOSS = 0.005  # where no damping is predicted

Modes = Mapping[ModeKey, PredictedMode]


def force_levels(stage: StageModel) -> dict[str, float]:
    """Free test → peak force (N), of those that say it."""
    return {
        keys.name: keys.force_level_n
        for keys in stage.setup.keys.tests
        if keys.force_level_n is not None and keys.support == FREE
    }


def level_bases(stage: StageModel) -> dict[str, str]:
    """Test → the test at the lowest level that it is compared with."""
    levels = {t.name: force_levels(stage)[t.name] for t in stage.tests if t.name in force_levels(stage)}
    if len(set(levels.values())) < 2:
        return {}
    base = min(levels, key=lambda name: levels[name])
    return {name: base for name, level in levels.items() if level != levels[base]}


def slipped(
    modes: Modes, friction: Friction, force_n: float, highest_n: float, losses: Mapping[ModeKey, float]
) -> dict[ModeKey, PredictedMode]:
    """Modes under a harmonic force, each with a contact of its own.

    Parameters
    ----------
    modes : while the contact sticks.
    friction : the contact.
    force_n, highest_n : of the test, and of the stage's hardest one.
    losses : of the modes while it sticks.
    """
    quiet = {key: losses.get(key, USUAL_LOSS) for key in modes}
    # amplitude at resonance of a mode without friction, over that of the largest at the hardest level
    size = {key: 1.0 / (quiet[key] * mode.frequency_hz**2) for key, mode in modes.items()}
    largest = max(size.values(), default=1.0)
    found = {}
    for key, mode in modes.items():
        if friction.law == "jenkins":
            one = jenkins_resonance(friction.share, quiet[key], HIT * force_n / friction.slip_force)
        else:
            amplitude = size[key] / largest * force_n / highest_n
            one = iwan_resonance(friction.share, friction.exponent, quiet[key], amplitude * quiet[key])
        log_f = mode.log_f + 0.5 * float(np.log1p(-one.fall))
        found[key] = replace(mode, log_f=log_f, friction=one.loss)
    return found


def level_features(
    test: MeasuredTest,
    rows: tuple[Sequence[MeasuredMode], Sequence[MeasuredMode]],
    keys: tuple[Sequence[ModeKey | None], Sequence[ModeKey | None]],
    modes: tuple[Modes, Modes],
    losses: tuple[Mapping[ModeKey, float], Mapping[ModeKey, float]],
) -> list[Feature]:
    """Changes from the lowest level of all modes that both tests have; the lowest one comes first in every pair.

    Parameters
    ----------
    test : at the higher level.
    rows, keys : measured modes and their partners.
    modes, losses : predicted; no losses where damping is not.
    """
    found = []
    for key in common_keys(keys):
        both = tuple(
            [m for m, k in zip(row, own, strict=True) if k == key]
            for row, own in zip(rows, keys, strict=True)
        )
        mean, noise = zip(*(_mean_of(own) for own in both), strict=True)
        change = mean[1] - mean[0]
        sd = float(np.sqrt(noise[0] ** 2 + noise[1] ** 2 + FREQUENCY_OWN**2 + (FREQUENCY_PART * change) ** 2))
        known = all(key in m for m in modes)
        told = modes[1][key].log_f - modes[0][key].log_f if known else 0.0
        found.append(Feature("level", test.name, key, change, told, sd, lost=not known))
        eta = [mean_loss(row, own, key) for row, own in zip(rows, keys, strict=True)]
        if eta[0] is None or eta[1] is None or not all(losses):
            continue
        (low, low_sd), (high, high_sd) = eta[0], eta[1]
        change = float(np.log(high / low))
        own_sd = LOSS_OWN if test.recorded else TYPED_LOSS_OWN
        sd = float(np.linalg.norm([own_sd, LOSS_PART * change, low_sd, high_sd]))
        known = all(key in values for values in losses)
        told = float(np.log(losses[1][key] / losses[0][key])) if known else 0.0
        found.append(Feature("level_loss", test.name, key, change, told, sd, lost=not known))
    return found


def _mean_of(rows: Sequence[MeasuredMode]) -> tuple[float, float]:
    """Mean ln f of a mode's lines, by what each says of it, and its standard deviation."""
    weights = line_weights(rows)
    mean = weights @ np.log([row.frequency_hz for row in rows])
    return float(mean), float(np.linalg.norm(weights * [measured_sd(row) for row in rows]))


def common_keys(
    keys: tuple[Sequence[ModeKey | None], Sequence[ModeKey | None]],
) -> list[ModeKey]:
    """Partners that modes of both tests have, in the higher one's order."""
    return [k for k in dict.fromkeys(keys[1]) if k is not None and k in keys[0]]
