"""Order spectrum of a mode shape: each order's share, and its amplitude in every plane along the axis."""

from __future__ import annotations

from collections.abc import Iterator

import matplotlib as mpl
import numpy as np
from matplotlib.colors import to_hex

from statorhom.report.figures.canvas import DIVERGING, FAINT, FAINT_INK, GRID, INK, SIMULATED

WIDTH_MM = 54.0
_LEFT, _RIGHT = 10.0, 1.0  # mm beside the columns
_BARS, _MAP = (3.0, 15.0), (18.5, 46.5)  # mm from the top: first and last line of the two parts
_HEIGHT_MM = 54.0
_LETTERS = 'font-family="DejaVu Sans, Segoe UI, Helvetica, Arial, sans-serif"'
_LEAST_ORDERS = 7
_SHOWN_SHARE = 0.005
_LABELLED_PERCENT = 1.0
_MOST_ROW_LABELS = 6
_SATURATION = 0.43  # keeps the two darkest ends of the colours apart from black


def real_amplitudes(spectrum: np.ndarray) -> np.ndarray:
    """Signed amplitudes (planes, orders): each order turned by the phase that makes it as real as can be."""
    phase = np.exp(-0.5j * np.angle(np.sum(spectrum.astype(complex) ** 2, axis=0)))
    return np.asarray((spectrum * phase).real)


def order_shares(spectrum: np.ndarray) -> np.ndarray:
    """Part of each order in the mean square of the radial motion (orders,)."""
    power = np.sum(np.abs(spectrum) ** 2, axis=0)
    power = power * np.where(np.arange(len(power)) == 0, 1.0, 0.5)  # mean squares of 1 and of cos rθ
    return np.asarray(power / max(float(power.sum()), 1e-300))


def shown_orders(spectra: list[np.ndarray]) -> int:
    """Number of orders that a step's spectra need."""
    highest = [int(np.flatnonzero(order_shares(s) > _SHOWN_SHARE).max(initial=0)) for s in spectra]
    available = max((s.shape[1] for s in spectra), default=0)
    return min(max(_LEAST_ORDERS, *(h + 2 for h in highest), 0), available)


def spectrum_map(spectrum: np.ndarray, planes_mm: np.ndarray, orders: int) -> bytes:
    """SVG of one mode: bars of the shares above, a map of orders against planes below."""
    amplitudes, ascending = real_amplitudes(spectrum)[:, :orders], np.argsort(planes_mm)
    parts = [
        *_bars(100 * order_shares(spectrum)[:orders]),
        *_map(amplitudes[ascending], planes_mm[ascending]),
    ]
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH_MM}mm" height="{_HEIGHT_MM}mm" '
        f'viewBox="0 0 {WIDTH_MM} {_HEIGHT_MM}" {_LETTERS}>{"".join(parts)}</svg>'
    ).encode()


def _bars(percent: np.ndarray) -> Iterator[str]:
    top, bottom = _BARS
    width = _column_width(len(percent))
    for level in (0, 50, 100):
        y = bottom - (bottom - top) * level / 100
        colour = GRID if level else FAINT
        yield f'<path d="M{_LEFT} {y:.2f}H{WIDTH_MM - _RIGHT}" stroke="{colour}" stroke-width="0.2"/>'
        yield _letters(_LEFT - 1, y + 0.8, f"{level}", "end")
    yield _sideways(2.6, (top + bottom) / 2, "share in %")
    for r, share in enumerate(percent):
        x, height = _LEFT + r * width, (bottom - top) * share / 100
        yield (
            f'<rect x="{x + 0.15 * width:.2f}" y="{bottom - height:.2f}" width="{0.7 * width:.2f}" '
            f'height="{height:.2f}" fill="{SIMULATED}"/>'
        )
        if share >= _LABELLED_PERCENT:
            yield _letters(x + width / 2, bottom - height - 0.6, f"{share:.0f}", "middle")


def _map(amplitudes: np.ndarray, planes_mm: np.ndarray) -> Iterator[str]:
    top, bottom = _MAP
    rows, columns = amplitudes.shape
    width, height = _column_width(columns), (bottom - top) / rows
    largest = max(float(np.abs(amplitudes).max(initial=0.0)), 1e-300)
    colours = mpl.colormaps[DIVERGING](0.5 + _SATURATION * amplitudes / largest)
    labelled = range(0, rows, -(-rows // _MOST_ROW_LABELS))
    for row in range(rows):
        y = bottom - (row + 1) * height
        for column in range(columns):
            yield (
                f'<rect x="{_LEFT + column * width:.2f}" y="{y:.2f}" width="{width:.2f}" '
                f'height="{height:.2f}" fill="{to_hex(colours[row, column])}" '
                f'stroke="#ffffff" stroke-width="0.25"/>'
            )
        if row in labelled:
            yield _letters(_LEFT - 1, y + height / 2 + 0.8, f"{planes_mm[row]:.0f}", "end")
    for column in range(columns):
        yield _letters(_LEFT + (column + 0.5) * width, bottom + 3, f"{column}", "middle")
    yield _letters((_LEFT + WIDTH_MM - _RIGHT) / 2, bottom + 6.6, "circumferential order r", "middle", 2.6)
    yield _sideways(2.6, (top + bottom) / 2, "plane at z in mm")


def _column_width(columns: int) -> float:
    return (WIDTH_MM - _LEFT - _RIGHT) / max(columns, 1)


def _letters(x: float, y: float, words: str, anchor: str, size: float = 2.35) -> str:
    return (
        f'<text x="{x:.2f}" y="{y:.2f}" font-size="{size}" text-anchor="{anchor}" fill="{INK}">{words}</text>'
    )


def _sideways(x: float, y: float, words: str) -> str:
    return (
        f'<text transform="translate({x:.2f} {y:.2f}) rotate(-90)" font-size="2.6" text-anchor="middle" '
        f'fill="{FAINT_INK}">{words}</text>'
    )
