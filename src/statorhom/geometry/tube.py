"""Tubes: rings without slots, whose modes have the names of a stator's."""

from __future__ import annotations

from dataclasses import dataclass

from statorhom.errors import GeometryError
from statorhom.geometry.dimensions import StatorDimensions
from statorhom.geometry.parts import Part, Span
from statorhom.geometry.section import Section
from statorhom.geometry.slots.plain_ring import plain_ring
from statorhom.geometry.stator import StepGeometry
from statorhom.study.coupon_file import TubeKeys

REGION = "tube"
SECTORS = 36  # equal parts that the mesh is copied from: orders up to 18


@dataclass(frozen=True)
class TubeGeometry:
    """Checked geometry of a tube that spans z = 0 … length.

    Parameters
    ----------
    dimensions : lengths in metres; the tube is the core of a stator without slots.
    section : half a sector.
    source : the geometry file, for messages.
    """

    dimensions: StatorDimensions
    section: Section
    source: str

    def step(self, kinds: tuple[str, ...]) -> StepGeometry:  # noqa: ARG002
        """What is tested; a tube has no steps of fabrication."""
        wall = Part(REGION, self.section.patches, (Span(0.0, self.dimensions.length, "core"),))
        return StepGeometry(self.dimensions, self.section, (wall,), self.source)


def tube_geometry(keys: TubeKeys, where: str) -> TubeGeometry:
    """Build a tube.

    Raises
    ------
    GeometryError
        If it has no wall.
    """
    inner, outer = keys.inner_diameter_mm, keys.outer_diameter_mm
    if inner >= outer:
        raise GeometryError(
            f"{where}: tube.inner_diameter_mm = {inner:g} must be smaller than tube.outer_diameter_mm = {outer:g}"
        )
    dimensions = StatorDimensions(
        slots=SECTORS,
        bore_radius=inner / 2e3,
        slot_radius=inner / 2e3,
        outer_radius=outer / 2e3,
        length=keys.length_mm / 1e3,
        overhang=None,
        frame=None,
        shields=None,
    )
    return TubeGeometry(dimensions, plain_ring(dimensions), where)
