"""A stator's geometry: dimensions, cross-section and the parts of each fabrication step."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from statorhom.geometry.columns import extended_section
from statorhom.geometry.dimensions import StatorDimensions, stator_dimensions
from statorhom.geometry.parts import Part, parts_of, regions_of
from statorhom.geometry.section import Section
from statorhom.geometry.slots.open_slot import parallel_slot, parallel_tooth
from statorhom.geometry.slots.plain_ring import plain_ring
from statorhom.geometry.slots.round_bottom import round_bottom
from statorhom.geometry.slots.semi_closed import semi_closed
from statorhom.study import geometry_file as keys
from statorhom.study.message import one_line


@dataclass(frozen=True)
class StatorGeometry:
    """Checked geometry of one machine.

    Parameters
    ----------
    dimensions : lengths in metres.
    section : half a slot pitch of core and overhang.
    source : the geometry file, for messages.
    """

    dimensions: StatorDimensions
    section: Section
    source: str

    def step(self, kinds: tuple[str, ...]) -> StepGeometry:
        """Geometry after the given fabrication steps, in their order.

        Raises
        ------
        GeometryError
            If a step needs a table that the geometry file lacks.
        """
        regions = regions_of(kinds)
        section = extended_section(self.section, self.dimensions, regions)
        parts = parts_of(section, self.dimensions, regions, self.source)
        return StepGeometry(self.dimensions, section, parts, self.source)


@dataclass(frozen=True)
class StepGeometry:
    """Geometry of the object as it stands after some fabrication step.

    Parameters
    ----------
    dimensions : lengths in metres.
    section : half a slot pitch, with frame and end shields where the step has them.
    parts : what the step consists of.
    source : the geometry file, for messages.
    """

    dimensions: StatorDimensions
    section: Section
    parts: tuple[Part, ...]
    source: str

    @property
    def regions(self) -> tuple[str, ...]:
        """Names of the regions, in the order in which they were added."""
        return tuple(dict.fromkeys(part.region for part in self.parts))

    def exact_volumes(self) -> Mapping[str, float]:
        """Volume of each region of the whole stator (m³), exact."""
        volumes: dict[str, float] = dict.fromkeys(self.regions, 0.0)
        for part in self.parts:
            area = sum(self.section.area(patch) for patch in part.patches)
            height = sum(span.high - span.low for span in part.spans)
            volumes[part.region] += 2 * self.dimensions.slots * area * height
        return volumes


def stator_geometry(file: keys.GeometryFile, path: Path) -> StatorGeometry:
    """Build the geometry that a file describes.

    Raises
    ------
    GeometryError
        If it is impossible; the message names the two keys that contradict each other.
    """
    where = one_line(str(path))
    dimensions = stator_dimensions(file, where)
    return StatorGeometry(dimensions, _section(dimensions, file.slots, where), where)


def _section(d: StatorDimensions, slots: keys.SlotKeys, where: str) -> Section:
    match slots:
        case keys.ParallelToothSlots():
            return parallel_tooth(d, slots.tooth_width_mm, where)
        case keys.SemiClosedSlots():
            return semi_closed(d, slots, where)
        case keys.RoundBottomSlots():
            return round_bottom(d, slots.tooth_width_mm, where)
        case keys.ParallelSlots():
            return parallel_slot(d, slots.slot_width_mm, where)
        case _:
            return plain_ring(d)
