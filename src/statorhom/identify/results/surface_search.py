"""A search by response surface as results.json tells it, and what its reader must know first."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.errors import IdentificationError
from statorhom.identify.residuals.sensitivity import mode_name
from statorhom.identify.surface.confidence_band import CONFIDENCE, confidence_band
from statorhom.identify.surface.search import SurfaceSearch
from statorhom.model.convergence import ModeKey
from statorhom.results.schema import (
    BandSummary,
    ModeResult,
    SurfaceRound,
    SurfaceSummary,
    VerifiedMode,
)
from statorhom.study.response_surface import SurfaceKeys

NO_PARTNER = "no partner"


def surface_summary(search: SurfaceSearch, keys: SurfaceKeys, modes: Sequence[ModeResult]) -> SurfaceSummary:
    """Summary of a search whose result was verified.

    Parameters
    ----------
    search : what was found.
    keys : of the study.
    modes : of the stage, with the frequencies of the full model at the result.
    """
    gate = search.gate
    band, remark = _band([m for m in modes if m.role == "fitted"])
    return SurfaceSummary(
        design=keys.design,
        surface=gate.surfaces.description,
        rounds=tuple(
            SurfaceRound(points=r.points, largest_error_percent=_percent(r.largest)) for r in gate.rounds
        ),
        check_points=gate.checks,
        limit_percent=keys.largest_error_percent,
        passed=gate.passed,
        errors_percent={_name(key): _percent(e) for key, e in gate.rounds[-1].errors.items()},
        full_solves=search.solves,
        objectives=tuple(_name(key) for key in search.names),
        front_percent=tuple(tuple(float(v) for v in row) for row in search.front.objectives),
        at_limits=search.at_limits,
        band=band,
        band_remark=remark,
    )


def surface_warnings(search: SurfaceSearch, keys: SurfaceKeys, stage: str) -> list[str]:
    """What the reader must know first."""
    found = []
    last = search.gate.rounds[-1]
    if not search.gate.passed:
        found.append(
            f"stage {stage!r}: the response surface misses modes that it was not fitted to by up to "
            f"{_percent(last.largest):.1f} %, more than {keys.largest_error_percent:g} %, with {last.points} points; "
            "what was found was polished on the model itself, but other optima may be missed: narrow the ranges "
            '(identify.prior), use surface = "gaussian_process" or raise most_points'
        )
    if search.at_limits:
        found.append(
            f"stage {stage!r}: the response surface has its best point at the end of the range of "
            f"{', '.join(search.at_limits)}; widen the range (identify.prior)"
        )
    return found


def _band(fitted: Sequence[ModeResult]) -> tuple[BandSummary | None, str | None]:
    paired = [
        (m.measured_hz, m.simulated_hz, m)
        for m in fitted
        if m.measured_hz is not None and m.simulated_hz is not None
    ]
    paired.sort(key=lambda found: found[0])
    try:
        band = confidence_band(np.array([measured for measured, _, _ in paired]))
    except IdentificationError as error:
        return None, str(error)
    inside = band.holds(np.array([verified for _, verified, _ in paired]))
    modes = tuple(
        VerifiedMode(
            number=i + 1,
            mode=NO_PARTNER if m.order is None else f"({m.order}, {m.axial})",
            measured_hz=measured,
            low_hz=float(band.limits_hz[i, 0]),
            high_hz=float(band.limits_hz[i, 1]),
            verified_hz=verified,
            inside=bool(inside[i]),
        )
        for i, (measured, verified, m) in enumerate(paired)
    )
    return BandSummary(degree=band.degree, r_squared=band.r_squared, confidence=CONFIDENCE, modes=modes), None


def _name(key: ModeKey | None) -> str:
    return NO_PARTNER if key is None else mode_name(key)


def _percent(part: float) -> float:
    """In per cent; where nothing could be compared, all of it is wrong."""
    return 100.0 * min(float(part), 1.0)
