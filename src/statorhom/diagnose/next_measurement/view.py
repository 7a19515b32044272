"""What one explanation predicts at one point of its parameters, for measurements that were not made."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.predicted.prediction import PredictedMode, acted_materials, predicted
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.errors import StatorhomError
from statorhom.model.affine import Materials
from statorhom.model.convergence import ModeKey
from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate

SAMPLES = 8  # points that stand for what an explanation leaves uncertain


@dataclass(frozen=True, eq=False)
class View:
    """An explanation at a point.

    Parameters
    ----------
    refit : its optimum.
    z : the point.
    """

    refit: Refit
    z: np.ndarray
    _modes: dict[tuple[str, tuple[str, ...]], Mapping[ModeKey, PredictedMode]] = field(
        default_factory=dict, repr=False
    )

    @property
    def values(self) -> Mapping[str, float]:
        """Constants by name."""
        h = self.refit.hypothesis
        return h.study.constants.values(self.z[: h.constants])

    @property
    def actions(self) -> tuple[Action, ...]:
        """What its effects and the declared ones do."""
        return self.refit.hypothesis.actions(self.z)

    @property
    def effects(self) -> tuple[tuple[Candidate, Mapping[str, float], Action], ...]:
        """Its own effects with the values of their parameters and what they do."""
        h = self.refit.hypothesis
        return tuple(zip(h.candidates, h.effect_values(self.z), self.actions, strict=False))

    def materials(self, stage: StageModel) -> Materials:
        """Materials of a stage."""
        return acted_materials(self.refit.hypothesis.study, stage, self.values, self.actions)

    def modes(self, stage: StageModel, without: Sequence[str] = ()) -> Mapping[ModeKey, PredictedMode]:
        """Free modes of a stage, without some of the effects (labels of candidates)."""
        place = stage.name, tuple(without)
        if place not in self._modes:
            left_out = [a for c, _, a in self.effects if c.label in without]
            kept = [a for a in self.actions if not any(a is other for other in left_out)]
            self._modes[place] = predicted(self.refit.hypothesis.study, stage, self.values, kept)
        return self._modes[place]


def views(refit: Refit, seed: int = 1) -> list[View]:
    """The optimum, and points drawn from what it leaves uncertain."""
    h = refit.hypothesis
    low, high = h.limits()
    spread = np.linalg.cholesky(refit.covariance + 1e-12 * np.eye(len(refit.z)))
    draws = np.random.default_rng(seed).standard_normal((SAMPLES, len(refit.z)))
    found = [View(refit, refit.z)]
    for draw in draws:
        view = View(refit, np.clip(refit.z + spread @ draw, low, high))
        try:
            for stage in h.study.stages:
                view.materials(stage)
        except StatorhomError:
            continue  # no material has these constants
        found.append(view)
    return found
