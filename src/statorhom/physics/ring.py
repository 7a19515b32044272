"""The core of a ring, a stator's or a tube's, as effects see it: where on it something may be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from statorhom.study.coupon_file import TubeFile
from statorhom.study.regions import core_region
from statorhom.study.study import StudyFiles


@dataclass(frozen=True)
class Ring:
    """A core that spans z = 0 … length.

    Parameters
    ----------
    region : its name (`core_region`).
    length, outer_radius, yoke : lengths (m); the yoke is what runs around without a gap: all of a tube's wall.
    slots : that are cut into it; a tube has none.
    """

    region: str
    length: float
    outer_radius: float
    yoke: float
    slots: int

    @property
    def slot_radius(self) -> float:
        """Radius at which the yoke begins (m)."""
        return self.outer_radius - self.yoke


def ring_of(files: StudyFiles) -> Ring:
    """The core of the stator or tube that a study is of.

    Raises
    ------
    InputFileError
        If it is of another body.
    """
    if isinstance(files.drawing, TubeFile):
        t = files.drawing.tube
        length, outer, yoke = (
            t.length_mm,
            t.outer_diameter_mm,
            (t.outer_diameter_mm - t.inner_diameter_mm) / 2,
        )
        slots = 0
    else:
        core = files.geometry.core
        length, outer, yoke = core.length_mm, core.outer_diameter_mm, core.yoke_thickness_mm
        slots = files.geometry.slots.count
    return Ring(core_region(files.study.regions(0)), length / 1e3, outer / 2e3, yoke / 1e3, slots)


def tube_sizes(files: StudyFiles) -> Mapping[str, tuple[float, float]]:
    """Key of a tube's dimension → the number as it stands in the file, and what of it a wrong one scales (mm).

    That is the wall of a diameter, which says how thick it is, negative where more of it makes the wall thinner. Other
    bodies have none.
    """
    if not isinstance(files.drawing, TubeFile):
        return {}
    t = files.drawing.tube
    wall = t.outer_diameter_mm - t.inner_diameter_mm
    return {
        "outer_diameter_mm": (t.outer_diameter_mm, wall),
        "inner_diameter_mm": (t.inner_diameter_mm, -min(wall, t.inner_diameter_mm / 3)),
        "length_mm": (t.length_mm, t.length_mm),
    }
