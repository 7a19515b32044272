"""A wing of sandwich skins on spars and ribs: a closed box whose panels are plane."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from statorhom.errors import GeometryError
from statorhom.geometry.wing_lattice import WingLattice, wing_lattice
from statorhom.study.frozen_map import FrozenMap

STEEPEST_DEG = 60.0


@dataclass(frozen=True)
class SkinLayer:
    """Plies of one cloth that lie on each other.

    Parameters
    ----------
    region : its material.
    thickness : m.
    angle : of the cloth's axis 1 from the span towards the trailing edge (rad).
    """

    region: str
    thickness: float
    angle: float


@dataclass(frozen=True)
class PlanForm:
    """Half a wing seen from above, and its height.

    Parameters
    ----------
    half_span : m.
    root_chord, tip_chord : m; sections between them are alike.
    sweep : of the leading edge backwards (rad).
    stations : leading edge, front spar, rear spar, trailing edge as parts of the chord, from 0 to 1.
    heights : of the section there, as parts of the chord.
    """

    half_span: float
    root_chord: float
    tip_chord: float
    sweep: float
    stations: tuple[float, ...]
    heights: tuple[float, ...]

    def chord(self, y: np.ndarray | float) -> np.ndarray:
        """Chord at a distance from the middle (m)."""
        return np.asarray(
            self.root_chord + (self.tip_chord - self.root_chord) * np.asarray(y) / self.half_span
        )

    def height(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Height of the section (m); linear between the stations, so that the panels are plane."""
        chord = self.chord(y)
        return np.asarray(chord * np.interp((x - self.leading_edge(y)) / chord, self.stations, self.heights))

    def panel_slopes(self, panel: int) -> tuple[float, float]:
        """∂z/∂x and ∂z/∂y of the upper face between a station and the next."""
        (s, t), (h, k) = self.stations[panel : panel + 2], self.heights[panel : panel + 2]
        along = (k - h) / (t - s)
        taper = (self.tip_chord - self.root_chord) / self.half_span
        return along / 2, ((h - along * s) * taper - along * math.tan(self.sweep)) / 2

    def leading_edge(self, y: np.ndarray | float) -> np.ndarray:
        """x of the leading edge (m)."""
        return np.asarray(np.asarray(y) * math.tan(self.sweep))


@dataclass(frozen=True)
class Lump:
    """A point mass on the upper skin.

    Parameters
    ----------
    name : for messages.
    mass : kg, of one.
    x, y : m; unless y is 0 there is one each side.
    """

    name: str
    mass: float
    x: float
    y: float

    @property
    def copies(self) -> int:
        """How many the whole wing has."""
        return 2 if self.y > 0.0 else 1


@dataclass(frozen=True)
class WingGeometry:
    """A wing, symmetric about y = 0: x backwards, y to the right, z up.

    Parameters
    ----------
    plan : plan form.
    skin : layers from the mould inwards, alike on both sides.
    ribs : y of the ribs between the middle and the tip, where one stands always (m).
    web : thickness of spars and ribs (m).
    web_region : their material.
    cage : width (along the span) and thickness of the walls of the payload cage between the spars (m), or None.
    cage_region : its material.
    source : the geometry file, for messages.
    lumps : point masses.
    densities : material → kg/m³, as far as they are known; the weight gives the one that is not.
    """

    plan: PlanForm
    skin: tuple[SkinLayer, ...]
    ribs: tuple[float, ...]
    web: float
    web_region: str
    cage: tuple[float, float] | None
    cage_region: str
    source: str
    lumps: tuple[Lump, ...] = ()
    densities: Mapping[str, float] = FrozenMap({})

    def __post_init__(self) -> None:
        p = self.plan
        if not abs(p.sweep) <= math.radians(STEEPEST_DEG):
            raise self._error("sweep_deg", f"must lie in -{STEEPEST_DEG:g} … {STEEPEST_DEG:g}")
        if p.stations[0] != 0.0 or p.stations[-1] != 1.0 or any(np.diff(p.stations) <= 0.0):
            raise self._error(
                "spars_percent", "must rise from the leading edge (0) to the trailing edge (100)"
            )
        skin = sum(layer.thickness for layer in self.skin)
        if min(p.heights) * p.tip_chord <= 2.0 * skin:
            raise self._error(
                "heights_percent", f"leave no room between two skins of {1e3 * skin:.3g} mm at the tip"
            )
        cage = 0.0 if self.cage is None else self.cage[0] / 2 + self.cage[1]
        walls = (cage, *self.ribs, p.half_span)
        if any(np.diff(walls) <= 2 * self.web):
            raise self._error("ribs_mm", "must rise from the payload cage to the tip, with room between them")
        for lump in self.lumps:
            if not self._carries(lump):
                raise self._error(f"lumps[{lump.name}]", f"lies off the wing at its y_mm = {1e3 * lump.y:g}")

    def _error(self, key: str, problem: str) -> GeometryError:
        return GeometryError(f"{self.source}: wing.{key}: {problem}; correct the number")

    def _carries(self, lump: Lump) -> bool:
        nose = float(self.plan.leading_edge(lump.y))
        return lump.y <= self.plan.half_span and nose <= lump.x <= nose + float(self.plan.chord(lump.y))

    @property
    def lump_mass(self) -> float:
        """Of all lumps on both sides (kg)."""
        return sum(lump.copies * lump.mass for lump in self.lumps)

    @property
    def edge(self) -> float:
        """Thickness of the walls that close the section (m): all cloth of the skin's own first material."""
        return sum(layer.thickness for layer in self.skin if layer.region == self.skin[0].region)

    def step(self, kinds: tuple[str, ...]) -> WingGeometry:  # noqa: ARG002
        """What is tested; a wing has no steps of fabrication."""
        return self

    @property
    def regions(self) -> tuple[str, ...]:
        """Its materials, the skin's first."""
        names = [layer.region for layer in self.skin] + [self.web_region]
        return tuple(dict.fromkeys(names if self.cage is None else [*names, self.cage_region]))

    @cached_property
    def lattice(self) -> WingLattice:
        """The coarsest division into cells."""
        return wing_lattice(self, 1.0)

    def exact_volumes(self) -> Mapping[str, float]:
        """Volume of every region, both halves together (m³); all cells have plane faces or nearly so."""
        found = self.lattice.volumes()
        return {region: 2.0 * found[i] for i, region in enumerate(self.regions)}
