"""One constant's 90 % interval against what is typical, as a strip that fits a table's row."""

from __future__ import annotations

import math
from dataclasses import dataclass

from statorhom.report.document import Picture
from statorhom.report.figures.canvas import DATA, FAINT, FAINT_INK, GRID, INK, PRIOR

WIDTH_MM = 62.0
_HEIGHT_MM = 7.2
_SIDE = 2.5  # mm kept free beside the axis
_LINE = 3.0  # mm from the top to the middle of the bars
_ROOM = 1.12  # factor kept free beyond the outermost value
_MOST_MARKS = 6
# figures per decade, from many to few
_MARKS = ((1, 1.2, 1.4, 1.6, 1.8, 2, 2.5, 3, 4, 5, 6, 8), (1, 1.5, 2, 3, 4, 5, 7), (1, 2, 5), (1, 3), (1,))


@dataclass(frozen=True)
class Axis:
    """A strip's axis: its ends, whether it is logarithmic, and the marks with their labels."""

    low: float
    high: float
    log: bool
    marks: tuple[tuple[float, str], ...]

    def position(self, value: float) -> float:
        """Place of a value (mm), held inside the strip."""
        low, high = self._scale(self.low), self._scale(self.high)
        part = (self._scale(max(value, self.low)) - low) / (high - low)
        return _SIDE + (WIDTH_MM - 2 * _SIDE) * min(max(part, 0.0), 1.0)

    def _scale(self, value: float) -> float:
        return math.log10(value) if self.log else value


_RATIO_AXIS = Axis(0.0, 0.5, False, tuple((i / 10, f"{i / 10:.1f}" if i else "0") for i in range(6)))


def modulus_axis(*values_pa: float) -> Axis:
    """Logarithmic axis in GPa that holds all given moduli."""
    known = [value for value in values_pa if value > 0 and math.isfinite(value)] or [1e9]
    low, high = min(known) / _ROOM, max(known) * _ROOM
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    for digits in _MARKS:
        marks = [d * 10.0**k for k in decades for d in digits if low <= d * 10.0**k <= high]
        if len(marks) <= _MOST_MARKS:
            break
    marks = marks or [math.sqrt(low * high)]
    step = math.ceil(len(marks) / _MOST_MARKS)
    return Axis(low, high, True, tuple((mark, f"{mark / 1e9:.3g}") for mark in marks[::step]))


def interval_bar(
    constant: str,
    value: float,
    interval: tuple[float, float],
    typical: tuple[float, float] | None,
    status: str,
) -> Picture:
    """SVG strip: the typical range as a grey band, the interval as a line, the value as a dot.

    Parameters
    ----------
    constant : name of the constant: moduli (…_pa) stand on a logarithmic axis, others on a linear one.
    value : float
    interval : its 90 % interval.
    typical : the range of most such parts, where one is known.
    status : "identified" is drawn in full colour, "prior_dominated" and "fixed" in grey and hollow.
    """
    modulus = constant.endswith("_pa")
    axis = modulus_axis(value, *interval, *(typical or ())) if modulus else _RATIO_AXIS
    parts = [_mark(axis, at, label) for at, label in axis.marks]
    if typical is not None:
        parts.insert(0, _band(axis, *typical))
    colour = DATA if status == "identified" else FAINT_INK
    low, high = (axis.position(end) for end in interval)
    if status != "fixed":
        ends = f"M{low:.2f} {_LINE - 0.9}v1.8M{high:.2f} {_LINE - 0.9}v1.8"
        stroke = f'stroke="{colour}" stroke-width="0.55"'
        parts.append(f'<path d="M{low:.2f} {_LINE}H{high:.2f}{ends}" {stroke} fill="none"/>')
    fill = colour if status == "identified" else "#ffffff"
    parts.append(
        f'<circle cx="{axis.position(value):.2f}" cy="{_LINE}" r="1" fill="{fill}" '
        f'stroke="{colour}" stroke-width="0.45"/>'
    )
    return Picture(_svg(parts), "svg", WIDTH_MM, "interval of the constant on an axis, typical range in grey")


def _band(axis: Axis, low: float, high: float) -> str:
    start, end = axis.position(low), axis.position(high)
    size = f'width="{end - start:.2f}" height="3.4" rx="0.5"'
    return f'<rect x="{start:.2f}" y="{_LINE - 1.7}" {size} fill="{PRIOR}"/>'


def _mark(axis: Axis, at: float, label: str) -> str:
    x = axis.position(at)
    text = (
        f'<text x="{x:.2f}" y="{_HEIGHT_MM - 0.1}" font-size="2.1" font-family="DejaVu Sans Mono, monospace" '
        f'text-anchor="middle" fill="{INK}" fill-opacity="0.75">{label}</text>'
    )
    return f'<path d="M{x:.2f} 0.6V{_HEIGHT_MM - 2.2}" stroke="{GRID}" stroke-width="0.25"/>{text}'


def _svg(parts: list[str]) -> bytes:
    base = f'<path d="M{_SIDE} {_LINE}H{WIDTH_MM - _SIDE}" stroke="{FAINT}" stroke-width="0.2"/>'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH_MM}mm" height="{_HEIGHT_MM}mm" '
        f'viewBox="0 0 {WIDTH_MM} {_HEIGHT_MM}">{base}{"".join(parts)}</svg>'
    ).encode()
