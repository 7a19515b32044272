"""What each fabrication step consists of: patches of the section, extruded between axial positions."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import TypeVar

from statorhom.errors import GeometryError
from statorhom.geometry.columns import FRAME, SHIELD, columns_of
from statorhom.geometry.dimensions import StatorDimensions
from statorhom.geometry.frame import Frame, Shields
from statorhom.geometry.section import Patch, Section

_Table = TypeVar("_Table", float, Frame, Shields)

# what every step adds to the ones before it
STEP_REGIONS = {
    "stack": ("lamination",),
    "wound": ("winding",),
    "impregnated": ("winding",),
    "framed": ("frame",),
    "machine": ("machine",),
}


@dataclass(frozen=True)
class Span:
    """Axial interval of a part (m).

    Parameters
    ----------
    low, high : its ends.
    division : name of the number of cells along it, of which it takes a `share`.
    """

    low: float
    high: float
    division: str
    share: float = 1.0

    @property
    def toward_ends(self) -> bool:
        """Whether cells may shrink towards both ends, because the core ends there."""
        return self.division == "core" and self.share == 1.0


@dataclass(frozen=True)
class Part:
    """Patches of one region, extruded over consecutive spans."""

    region: str
    patches: tuple[Patch, ...]
    spans: tuple[Span, ...]


def regions_of(kinds: tuple[str, ...]) -> frozenset[str]:
    """Regions present after the given fabrication steps."""
    return frozenset(region for kind in kinds for region in STEP_REGIONS[kind])


def parts_of(section: Section, d: StatorDimensions, regions: frozenset[str], where: str) -> tuple[Part, ...]:
    """Parts of a step; `section` is the extended one.

    Raises
    ------
    GeometryError
        If a region needs a table that the geometry file lacks.
    """
    frame = _needed(d.frame, "frame", where) if "frame" in regions else None
    parts = [Part("lamination", _core_patches(section, "lamination"), _core_spans(d, frame))]
    if "winding" in regions:
        parts += _winding(section, d, frame, where)
    if frame is not None:
        parts.append(Part("frame", columns_of(section, FRAME), _frame_spans(d, frame)))
    if "machine" in regions:
        shields = _needed(d.shields, "machine", where)
        if frame is None:
            raise GeometryError(
                f"{where}: the complete machine's end shields sit on the frame; add a framed stage before"
            )
        parts += _shields(section, frame, shields)
    return tuple(parts)


def _needed(table: _Table | None, name: str, where: str) -> _Table:
    if table is None:
        raise GeometryError(
            f"{where}: a stage with a {name} needs the table [{name}] with its dimensions; add it, "
            f"or leave the stage without tests so that only its mass counts"
        )
    return table


def _core_patches(section: Section, region: str) -> tuple[Patch, ...]:
    return tuple(patch for patch in section.patches if patch.core == region)


def _core_spans(d: StatorDimensions, frame: Frame | None) -> tuple[Span, ...]:
    """The core's length, cut where the frame ends on it."""
    ends = () if frame is None else (frame.z_low, frame.z_high)
    cuts = sorted({0.0, d.length, *(z for z in ends if 0.0 < z < d.length)})
    return tuple(Span(a, b, "core", (b - a) / d.length) for a, b in itertools.pairwise(cuts))


def _winding(section: Section, d: StatorDimensions, frame: Frame | None, where: str) -> list[Part]:
    slots = _core_patches(section, "winding")
    if not slots:
        raise GeometryError(f'{where}: slots.shape = "none" has no slots for a winding; choose a slot shape')
    overhang = _needed(d.overhang, "winding", where)
    ring = tuple(patch for patch in section.patches if patch.overhang)
    low = Span(-overhang, 0.0, "overhang")
    high = Span(d.length, d.length + overhang, "overhang")
    return [
        Part("winding", slots, _core_spans(d, frame)),
        Part("overhang", ring, (low,)),
        Part("overhang", ring, (high,)),
    ]


def _frame_spans(d: StatorDimensions, frame: Frame) -> tuple[Span, ...]:
    """Where the frame lies on the core it has the core's cells."""
    on_core = tuple(s for s in _core_spans(d, frame) if frame.z_low <= s.low and s.high <= frame.z_high)
    below = (Span(frame.z_low, 0.0, "frame_end"),) if frame.z_low < 0.0 else ()
    above = (Span(d.length, frame.z_high, "frame_end"),) if frame.z_high > d.length else ()
    return below + on_core + above


def _shields(section: Section, frame: Frame, shields: Shields) -> list[Part]:
    patches = columns_of(section, FRAME) + columns_of(section, SHIELD)
    low = Span(frame.z_low - shields.thickness, frame.z_low, "shield_axial")
    high = Span(frame.z_high, frame.z_high + shields.thickness, "shield_axial")
    return [Part("machine", patches, (span,)) for span in (low, high)]
