"""Where the mismatch is, as rows of diagnosis-details.json: error maps, angles and what tells them apart."""

from __future__ import annotations

import numpy as np

from statorhom.diagnose.fits.explanations import Explanation
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.located.angular_map import angles_of
from statorhom.diagnose.located.error_map import error_maps
from statorhom.diagnose.located.opposite import equivalent_angles, told_apart
from statorhom.physics.library import library
from statorhom.physics.ring import ring_of
from statorhom.results.diagnosis import AngleRow, MachineRow, MapRow, OppositeRow
from statorhom.study.study import StudyFiles


def machine_row(files: StudyFiles) -> MachineRow:
    """What pictures and their words need of the geometry file."""
    ring = ring_of(files)
    return MachineRow(
        kind=files.drawing.kind,
        length_mm=1e3 * ring.length,
        outer_diameter_mm=2e3 * ring.outer_radius,
        slots=ring.slots,
    )


def angle_rows(base: Refit, best: Explanation) -> tuple[AngleRow, ...]:
    """The angular map; empty where no angles were measured."""
    return tuple(AngleRow(angle_deg=a, weight=w) for a, w in angles_of(base, best))


def map_rows(base: Refit) -> tuple[MapRow, ...]:
    """The error maps of all tests with shapes."""
    return tuple(
        MapRow(
            stage=m.stage,
            test=m.test,
            angles_deg=tuple(round(float(a), 3) for a in np.rad2deg(m.angles_rad)),
            z_mm=tuple(round(1e3 * float(z), 3) for z in m.z_m),
            regions={
                r: tuple(tuple(round(float(v), 6) for v in row) for row in part)
                for r, part in m.regions.items()
            },
            error=m.error,
            modes=tuple(dict.fromkeys((k[0], k[1]) for k in m.modes)),
        )
        for m in error_maps(base)
    )


def opposite_rows(best: Explanation) -> tuple[OppositeRow, ...]:
    """What the shapes say of the angles that splits leave open."""
    found = []
    for number, candidate in enumerate(best.candidates):
        angles = equivalent_angles(best, number)
        if len(angles) < 2:
            continue
        told = told_apart(best, number, angles)
        ratio = told.likelihood_ratio
        found.append(
            OppositeRow(
                effect=candidate.effect,
                kept_deg=_degrees(told.angles_rad),
                excluded_deg=_degrees(told.excluded_rad),
                mean_log_ratio=None if ratio is None else ratio[0],
                standard_error=None if ratio is None else ratio[1],
            )
        )
    return tuple(found)


def summaries(effects: tuple[str, ...], files: StudyFiles) -> dict[str, str]:
    """A sentence on every effect that the page mentions."""
    return {name: library()[name].words(files).summary for name in effects if name in library()}


def _degrees(angles_rad: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(round(float(np.rad2deg(a)), 3) for a in angles_rad)
