"""What can be concealed says of itself: where it can sit, its parameters, and what it makes of a case."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from statorhom.conceal.truth import Case, TrueStage, TrueTest


@dataclass(frozen=True)
class Drawn:
    """A parameter that is drawn where it is not given.

    Parameters
    ----------
    name : with its unit, as formats.md names it.
    weak, strong : ends of its range; the strong one is felt more where the parameter is a strength.
    scale : how it is drawn between them.
    is_strength : whether `--strength` decides it.
    """

    name: str
    weak: float
    strong: float
    scale: Literal["log", "linear", "whole"] = "linear"
    is_strength: bool = False

    def at(self, share: float) -> float:
        """The value at a share of the way from weak to strong."""
        if self.scale == "log":
            return float(self.weak ** (1 - share) * self.strong**share)
        value = self.weak + share * (self.strong - self.weak)
        return float(round(value)) if self.scale == "whole" else float(value)


ANGLE = Drawn("angle_deg", 0.0, 360.0)


@dataclass(frozen=True)
class Place:
    """The stage and the test in which an effect sits, by their numbers."""

    case: Case
    stage: int
    test: int

    @property
    def true_stage(self) -> TrueStage:
        """The stage."""
        return self.case.stages[self.stage]

    @property
    def true_test(self) -> TrueTest:
        """The test."""
        return self.true_stage.tests[self.test]


@dataclass(frozen=True)
class HiddenEffect:
    """Something to conceal.

    Parameters
    ----------
    name : as in formats.md for those of the library.
    parameters : of a place, to be drawn.
    apply : the case with the effect at its place.
    fits : whether a place can have it.
    in_library : whether a diagnosis can name it.
    """

    name: str
    parameters: Callable[[Place], tuple[Drawn, ...]]
    apply: Callable[[Place, Mapping[str, float], np.random.Generator], Case]
    fits: Callable[[Place], bool]
    in_library: bool = True


def is_free(place: Place) -> bool:
    """Every free test."""
    return place.true_test.declared is None


def is_wound(place: Place) -> bool:
    """Free tests of a winding step."""
    return is_free(place) and place.true_stage.keys.kind in ("wound", "impregnated")
