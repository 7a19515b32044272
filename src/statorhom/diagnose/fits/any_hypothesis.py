"""What an explanation is, whatever body it is of: a vector of constants and of the added effects' parameters.

Refits, scan, evidence and rules need no more of a model than this: residuals over the vector, with a pairing that
can be held. `hypothesis` has it for stators and tubes, `coupons.hypothesis` for plates, beams and wings.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Protocol, Self

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.features.mixed_modes import charges_of
from statorhom.diagnose.fits.untold import untold_angles
from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.processes.memory import Memory
from statorhom.diagnose.stages.constants import Constants
from statorhom.model.convergence import ModeKey
from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.physics.library import library
from statorhom.study.study import StudyFiles

FloatArray = npt.NDArray[np.float64]


class Step(Protocol):
    """A step with what was measured of it."""

    @property
    def name(self) -> str: ...
    @property
    def tests(self) -> tuple[MeasuredTest, ...]: ...


class ModelledStudy(Protocol):
    """A study's constants and its tested steps."""

    @property
    def files(self) -> StudyFiles: ...
    @property
    def constants(self) -> Constants: ...
    @property
    def stages(self) -> Sequence[Step]: ...
    @property
    def effects(self) -> tuple[Action, ...]: ...


@dataclass(frozen=True, eq=False)
class AnyHypothesis(ABC):
    """Residuals of all features over the constants x and the effects' parameters p, in internal coordinates.

    Parameters
    ----------
    study : the model.
    candidates : effects added.
    left_out : groups of features (`Feature.group`) that the residuals do not see.
    held : test → partners of its modes; None to pair anew.
    missed : -2 ln of the chance that the tests found the partners of their modes, and no others that were predicted.
    discrepancy : relative standard deviation added to all frequencies: makes the valleys wide enough to be found.
    trained : whether bases hold the local fields that an effect asks for (`Action.training`), and machines of other
        dimensions are solved. Both are dear, and what an effect promises can be told without them.
    whole : whether the last effect's parameters that are found last are free too; otherwise they are as usual.
    """

    study: ModelledStudy
    candidates: tuple[Candidate, ...] = ()
    left_out: frozenset[tuple[str, ModeKey | None]] = frozenset()
    held: Mapping[str, Any] | None = None
    missed: float = 0.0
    discrepancy: float = 0.0
    trained: bool = True
    whole: bool = True

    @abstractmethod
    def paired(self, z: FloatArray) -> Self:
        """With the pairing held as it is at z.

        Raises
        ------
        StatorhomError
            If no body has these constants.
        """

    def of_others(self, candidates: tuple[Candidate, ...]) -> Self:
        """The same with other effects, to be paired anew."""
        return replace(self, candidates=candidates, held=None, missed=0.0)

    @abstractmethod
    def features_of_all(self, z: FloatArray) -> list[Feature]:
        """Features whether seen or left out, at a held pairing; what wide valleys never see may be missing."""

    def charges(self, z: FloatArray) -> FloatArray:
        """Of the features that are seen, at a held pairing (`statorhom.diagnose.features.mixed_modes.charges_of`)."""
        return charges_of(self.features(z))

    def charge(self, z: FloatArray) -> float:
        """-2 ln of what the likelihood has beside residuals, at a held pairing."""
        return self.missed + float(np.sum(self.charges(z) ** 2))

    @property
    def constants(self) -> int:
        """Number of constants, the first part of the vector."""
        return len(self.study.constants)

    @property
    def shared(self) -> tuple[object, ...]:
        """What other hypotheses refer to as well (`statorhom.diagnose.processes.side_by_side`)."""
        study = self.study
        return study, study.files, study.constants, *study.stages, *study.effects, *self.candidates

    @property
    def memories(self) -> Sequence[Memory]:
        """Of what is dear and belongs to its models."""
        return ()

    @cached_property
    def parameters(self) -> tuple[tuple[int, int], ...]:
        """Candidate and parameter number of the vector's second part."""
        return tuple((i, j) for i, c in enumerate(self.candidates) for j in range(len(c.parameters)))

    @cached_property
    def untold(self) -> Sequence[int]:
        """Places of coordinates of which no row tells, whatever their slopes (`untold_angles`)."""
        if self.study.effects:
            return ()
        parameters = [self.candidates[i].parameters[j] for i, j in self.parameters]
        tests = [test for stage in self.study.stages for test in stage.tests]
        return [self.constants + k for k in untold_angles(parameters, tests)]

    def __len__(self) -> int:
        return self.constants + len(self.parameters)

    def effect_values(self, z: FloatArray) -> tuple[dict[str, float], ...]:
        """Parameters of every candidate by name."""
        found: list[dict[str, float]] = [{} for _ in self.candidates]
        for (i, j), u in zip(self.parameters, z[self.constants :].tolist(), strict=True):
            parameter = self.candidates[i].parameters[j]
            found[i][parameter.name] = parameter.value(u)
        return tuple(found)

    def actions(self, z: FloatArray) -> tuple[Action, ...]:
        """What the effects do, and after them those that the study declares."""
        values = self.effect_values(z)
        own = (
            replace(library()[c.effect].action(c, v, self.study.files), label=c.label)
            for c, v in zip(self.candidates, values, strict=True)
        )
        if not self.trained:
            own = (replace(action, training=None, proportional=True) for action in own)
        return (*own, *self.study.effects)

    def limits(self) -> tuple[FloatArray, FloatArray]:
        """Of the coordinates; angles have none."""
        low, high = self.study.constants.limits
        pairs = []
        for i, j in self.parameters:
            p = self.candidates[i].parameters[j]
            if not self.whole and p.last and p.usual is not None and i == len(self.candidates) - 1:
                pairs.append((p.internal(p.usual),) * 2)
            elif p.scale == "angle":
                pairs.append((-np.inf, np.inf))
            else:
                pairs.append((p.internal(p.lower), p.internal(p.upper)))
        both = np.array(pairs).reshape(-1, 2)
        return np.r_[low, both[:, 0]], np.r_[high, both[:, 1]]

    @cached_property
    def prior_weights(self) -> FloatArray:
        """1 where the prior is standard normal, 0 where it is uniform."""
        located = [self.candidates[i].parameters[j].located for i, j in self.parameters]
        return np.r_[np.ones(self.constants), 1.0 - np.array(located, dtype=float)]

    def features(self, z: FloatArray, left_out: bool = False) -> list[Feature]:
        """All features that are seen, or those that are left out."""
        return [f for f in self.features_of_all(z) if self.sees(f) != left_out]

    @property
    def in_wide_valleys(self) -> bool:
        """Whether it sees frequencies and densities alone."""
        return self.discrepancy > 0.0

    def sees(self, feature: Feature) -> bool:
        """Whether the residuals contain it; wide valleys are sought with frequencies alone."""
        if self.in_wide_valleys and feature.kind not in ("frequency", "density"):
            return False
        return feature.group not in self.left_out

    def residuals(self, z: FloatArray) -> FloatArray:
        """Of the features that are seen, without the prior."""
        return np.array([f.residual for f in self.features(z)])
