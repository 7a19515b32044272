"""Where points lie on a plan form: along the span, and between the leading and the trailing edge."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.errors import IdentificationError

FloatArray = npt.NDArray[np.float64]

_FEWEST_POINTS = 4
_LINE = 0.02  # of the span: points that lie closer to a line tell no torsion
_PER_STATION = 5  # points that an estimate of both edges rests on
_MOST_STATIONS = 15
_ROUNDING = 1e-6


@dataclass(frozen=True)
class PlanForm:
    """Points of a plate, beam or wing in its own coordinates.

    Attributes
    ----------
    axes : array, shape (3, 3)
        Unit vectors of span, chord and normal in rows.
    along : array, shape (points,)
        Position along the span, −1 … 1 from end to end.
    across : array, shape (points,)
        Position between the edges at the point's own station, −1 … 1; 0 where all points lie on a line.
    is_line : bool
        Whether the points lie on a line.
    """

    axes: FloatArray
    along: FloatArray
    across: FloatArray
    is_line: bool

    def __post_init__(self) -> None:
        for array in (self.axes, self.along, self.across):
            array.setflags(write=False)


def plan_form(points: npt.ArrayLike, axes: npt.ArrayLike | None = None) -> PlanForm:
    """Find span, chord and normal of points on a body that is flat or slender.

    Parameters
    ----------
    points : array_like, shape (points, 3)
        Positions, in any unit of length.
    axes : array_like, shape (3, 3), optional
        Directions of span, chord and normal in rows; by default the principal axes of the points, the span
        the longest. Give them where the span is not the longest side, or the points lie on a line.

    Raises
    ------
    IdentificationError
        When there are fewer than four points, or they are all in one place.
    """
    positions = np.asarray(points, dtype=float)
    if positions.ndim != 2 or positions.shape[1] != 3 or len(positions) < _FEWEST_POINTS:
        raise IdentificationError("a shape needs the positions of four points at least to be named")
    centred = positions - positions.mean(axis=0)
    frame = _principal(centred) if axes is None else _unit_rows(axes)
    span, chord, _ = frame @ centred.T
    length = float(np.ptp(span))
    if length <= 0.0:
        raise IdentificationError("all points of the shape lie at one station of the span")
    along = 2 * (span - span.min()) / length - 1
    if np.ptp(chord) < _LINE * length:
        return PlanForm(frame, along, np.zeros_like(along), True)
    low, high = _edges(along, chord)
    width = np.maximum(high - low, _LINE * length)
    across = np.clip((2 * chord - low - high) / width, -1.0, 1.0)
    return PlanForm(frame, along, across, False)


def _principal(centred: FloatArray) -> FloatArray:
    axes = np.linalg.svd(centred, full_matrices=True)[2]
    # signs that do not depend on the points' scatter: largest component positive, right-handed
    for i in range(2):
        axes[i] *= np.sign(axes[i, np.argmax(np.abs(axes[i]))])
    axes[2] = np.cross(axes[0], axes[1])
    return np.asarray(axes)


def _unit_rows(axes: npt.ArrayLike) -> FloatArray:
    rows = np.asarray(axes, dtype=float)
    if rows.shape != (3, 3) or not np.isfinite(rows).all() or abs(np.linalg.det(rows)) < 1e-9:
        raise IdentificationError("axes of a plan form are three independent directions: span, chord, normal")
    unit: FloatArray = rows / np.linalg.norm(rows, axis=1, keepdims=True)
    return unit


def _edges(along: FloatArray, chord: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Leading and trailing edge at every point's station, through the outermost points of strips of the span."""
    count = int(np.clip(len(along) // _PER_STATION, 1, _MOST_STATIONS))
    # points of one station stay together where rounding would part them
    strips = np.clip(((along + 1) / 2 * count + _ROUNDING).astype(int), 0, count - 1)
    members = [np.flatnonzero(strips == strip) for strip in np.unique(strips)]
    widths = [float(np.ptp(chord[strip])) for strip in members]
    # a strip that has points on one edge alone tells nothing of the other
    full = [strip for strip, width in zip(members, widths, strict=True) if width > 0.5 * np.median(widths)]
    if len(full) < 2:
        return np.full_like(chord, chord.min()), np.full_like(chord, chord.max())
    low = np.array([strip[np.argmin(chord[strip])] for strip in full])
    high = np.array([strip[np.argmax(chord[strip])] for strip in full])
    return _through(along, along[low], chord[low]), _through(along, along[high], chord[high])


def _through(at: FloatArray, stations: FloatArray, edge: FloatArray) -> FloatArray:
    """Straight between the edge's points, and on beyond the outer ones."""
    order = np.argsort(stations)
    stations, edge = stations[order], edge[order]
    inner = np.interp(at, stations, edge)
    for outside, first, second in ((at < stations[0], 0, 1), (at > stations[-1], -1, -2)):
        slope = (edge[second] - edge[first]) / (stations[second] - stations[first])
        inner = np.where(outside, edge[first] + slope * (at - stations[first]), inner)
    return inner
