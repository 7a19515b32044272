"""Plates and beams seen from above: where on them something may be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from statorhom.physics.parameter import EffectParameter
from statorhom.study.coupon_file import BeamFile, PlateFile
from statorhom.study.study import StudyFiles

ALONG = 9  # places along the longer side from which an effect is sought
FEWEST = 3


@dataclass(frozen=True)
class Plan:
    """A body that spans 0 … length along x and 0 … width along y.

    Parameters
    ----------
    length, width, height : (m).
    typed : key of the geometry file → number as it stands there.
    """

    length: float
    width: float
    height: float
    typed: Mapping[str, float]

    def places(self, *, half: bool = False) -> tuple[EffectParameter, EffectParameter]:
        """x and y of a place, uniform over the body; `half`: x over the nearer half of the length alone."""
        longest = max(self.length, self.width)
        x = _place("x_m", self.length * (0.5 if half else 1.0), longest)
        return x, _place("y_m", self.width, longest)

    def on_top(self, values: Mapping[str, float]) -> tuple[float, float, float]:
        """A place on the upper face."""
        return values["x_m"], values["y_m"], self.height

    def both_sides(self, values: Mapping[str, float]) -> tuple[tuple[float, float, float], ...]:
        """The same and its mirror image about the middle of the length."""
        x, y, z = self.on_top(values)
        return (x, y, z), (self.length - x, y, z)


def plan_of(files: StudyFiles) -> Plan | None:
    """The plan of a plate or a beam; None of other bodies."""
    match files.drawing:
        case PlateFile(plate=p):
            typed = {"length_mm": p.length_mm, "width_mm": p.width_mm, "thickness_mm": p.thickness_mm}
        case BeamFile(beam=b):
            typed = {"length_mm": b.length_mm, "width_mm": b.width_mm, "height_mm": b.height_mm}
        case _:
            return None
    length, width, height = (value / 1e3 for value in typed.values())
    return Plan(length, width, height, typed)


def places_on(files: StudyFiles, *, half: bool = False) -> tuple[EffectParameter, ...]:
    """x and y of a place on the body that a study is of; none on bodies without a plan."""
    plan = plan_of(files)
    return () if plan is None else plan.places(half=half)


def _place(name: str, side: float, longest: float) -> EffectParameter:
    count = max(FEWEST, round(ALONG * side / longest))
    starts = tuple(((np.arange(count) + 0.5) / count * side).tolist())
    return EffectParameter(name, 0.0, side, 0.0, side, "place", starts)
