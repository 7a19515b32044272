"""Plates, beams and wings seen from above: where on them something may be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from statorhom.geometry.wing import PlanForm
from statorhom.geometry.wing_of_file import wing_of_file
from statorhom.physics.parameter import EffectParameter
from statorhom.study.coupon_file import BeamFile, PlateFile
from statorhom.study.message import one_line
from statorhom.study.study import StudyFiles
from statorhom.study.wing_file import WingFile

ALONG = 9  # places along the longer side from which an effect is sought
FEWEST = 3
Place = tuple[float, float, float]


class Plan(Protocol):
    """A body's upper face. A place on it is told by two parameters of an effect."""

    def places(self, *, half: bool = False) -> tuple[EffectParameter, EffectParameter]:
        """The two parameters; `half`: on one side of the plane of symmetry across the longer side alone."""

    def on_top(self, values: Mapping[str, float]) -> Place:
        """x, y, z (m) of a place; z only tells the upper face."""

    def both_sides(self, values: Mapping[str, float]) -> tuple[Place, Place]:
        """The same and its mirror image about the middle of the longer side."""

    def opposite(self, values: Mapping[str, float]) -> dict[str, float]:
        """An effect's parameters with its place at that mirror image."""

    def opposite_point(self, x: float, y: float) -> tuple[float, float]:
        """Mirror image of a point (m)."""

    @property
    def mirrored(self) -> tuple[str, ...]:
        """Parameters whose mirror image about the middle of their range is one of the body too."""

    @property
    def lengths(self) -> tuple[float, float]:
        """Lengths of the body along x and y (m)."""

    @property
    def outline(self) -> tuple[tuple[float, float], ...]:
        """Corners (m)."""

    @property
    def typed(self) -> Mapping[str, float]:
        """Dimensions that may be wrong, by the key of the geometry file, as they stand there."""


@dataclass(frozen=True)
class BlockPlan:
    """A plate or beam that spans 0 … length along x and 0 … width along y.

    Parameters
    ----------
    length, width, height : (m).
    typed : key of the geometry file → number as it stands there.
    """

    length: float
    width: float
    height: float
    typed: Mapping[str, float]

    mirrored = ("x_m", "y_m")

    def places(self, *, half: bool = False) -> tuple[EffectParameter, EffectParameter]:
        """x and y."""
        longest = max(self.length, self.width)
        x = _place("x_m", 0.0, self.length * (0.5 if half else 1.0), longest)
        return x, _place("y_m", 0.0, self.width, longest)

    def on_top(self, values: Mapping[str, float]) -> Place:
        """The place itself."""
        return values["x_m"], values["y_m"], self.height

    def both_sides(self, values: Mapping[str, float]) -> tuple[Place, Place]:
        """x and length - x."""
        return self.on_top(values), self.on_top(self.opposite(values))

    def opposite(self, values: Mapping[str, float]) -> dict[str, float]:
        """At length - x."""
        return {**values, "x_m": self.length - values["x_m"]}

    def opposite_point(self, x: float, y: float) -> tuple[float, float]:
        """At length - x."""
        return self.length - x, y

    @property
    def lengths(self) -> tuple[float, float]:
        """Length and width."""
        return self.length, self.width

    @property
    def outline(self) -> tuple[tuple[float, float], ...]:
        """Four corners."""
        return (0.0, 0.0), (self.length, 0.0), (self.length, self.width), (0.0, self.width)


@dataclass(frozen=True)
class WingPlan:
    """A wing: a place is told by its part of the chord, from the leading edge, and by y."""

    form: PlanForm

    mirrored = ("y_m",)

    @property
    def typed(self) -> Mapping[str, float]:
        """None: a changed wing is another mesh."""
        return {}

    def places(self, *, half: bool = False) -> tuple[EffectParameter, EffectParameter]:
        """Part of the chord, and y to the right."""
        b = self.form.half_span
        chord = EffectParameter("chord_share", 0.0, 1.0, 0.0, 1.0, "place", (0.1, 0.3, 0.5, 0.7, 0.9))
        return chord, _place("y_m", 0.0 if half else -b, b, 2 * b)

    def on_top(self, values: Mapping[str, float]) -> Place:
        """On the upper skin."""
        y = values["y_m"]
        edge, chord = float(self.form.leading_edge(abs(y))), float(self.form.chord(abs(y)))
        return edge + values["chord_share"] * chord, y, self.form.half_span

    def both_sides(self, values: Mapping[str, float]) -> tuple[Place, Place]:
        """y and -y."""
        return self.on_top(values), self.on_top(self.opposite(values))

    def opposite(self, values: Mapping[str, float]) -> dict[str, float]:
        """At -y."""
        return {**values, "y_m": -values["y_m"]}

    def opposite_point(self, x: float, y: float) -> tuple[float, float]:
        """At -y."""
        return x, -y

    @property
    def lengths(self) -> tuple[float, float]:
        """Chord at the middle, and span."""
        return self.form.root_chord, 2 * self.form.half_span

    @property
    def outline(self) -> tuple[tuple[float, float], ...]:
        """Leading edges from left to right, then the trailing edges back."""
        b = self.form.half_span
        edge, tip = float(self.form.leading_edge(b)), self.form.tip_chord
        return (
            (edge, -b),
            (0.0, 0.0),
            (edge, b),
            (edge + tip, b),
            (self.form.root_chord, 0.0),
            (edge + tip, -b),
        )


def plan_of(files: StudyFiles) -> Plan | None:
    """The plan of a plate, a beam or a wing; None of other bodies."""
    match files.drawing:
        case PlateFile(plate=p):
            typed = {"length_mm": p.length_mm, "width_mm": p.width_mm, "thickness_mm": p.thickness_mm}
        case BeamFile(beam=b):
            typed = {"length_mm": b.length_mm, "width_mm": b.width_mm, "height_mm": b.height_mm}
        case WingFile(wing=w):
            return WingPlan(wing_of_file(w, one_line(str(files.geometry_path))).plan)
        case _:
            return None
    length, width, height = (value / 1e3 for value in typed.values())
    return BlockPlan(length, width, height, typed)


def places_on(files: StudyFiles, *, half: bool = False) -> tuple[EffectParameter, ...]:
    """Parameters of a place on the body that a study is of; none on bodies without a plan."""
    plan = plan_of(files)
    return () if plan is None else plan.places(half=half)


def _place(name: str, low: float, high: float, longest: float) -> EffectParameter:
    count = max(FEWEST, round(ALONG * (high - low) / longest))
    starts = tuple((low + (np.arange(count) + 0.5) / count * (high - low)).tolist())
    return EffectParameter(name, low, high, low, high, "place", starts)
