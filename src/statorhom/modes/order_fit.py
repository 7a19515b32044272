"""Least-squares amplitudes of circumferential orders where points may be missing."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
BoolArray = npt.NDArray[np.bool_]
IntArray = npt.NDArray[np.int_]

# Noise at the points is amplified by at most this factor; an order that would need more is left out.
_LARGEST_CONDITION = 10.0
_LEAST_GAIN = 1e-24  # of the sum of squares: below it there are only rounding errors left
_ROUNDING = 1e-9  # of products of columns
_LEAST_ALIKE = 0.8  # of an order's mean square, explained by another one that is then as likely


@dataclass(frozen=True)
class OrderFit:
    """Amplitudes of the orders' columns.

    Attributes
    ----------
    amplitudes : ndarray of complex, shape (planes, orders, 2)
        Zero for orders that were left out; NaN in planes whose points do not even give the strongest order.
    residual : ndarray, shape (planes,)
        Mean square that stays unexplained; NaN in the same planes.
    """

    amplitudes: ComplexArray
    residual: FloatArray


def fit_orders(values: ComplexArray, columns: FloatArray, rich: BoolArray) -> OrderFit:
    """Fit all orders at once where the points allow it, else the strongest ones.

    Parameters
    ----------
    values : ndarray of complex, shape (planes, angles)
        NaN where a point is missing.
    columns : ndarray, shape (orders, angles, 2)
        Values of each order's two functions at the angles; a second one that is zero does not count.
    rich : ndarray of bool, shape (planes,)
        Planes with points enough to choose the orders by; the others follow them as far as they can.
    """
    every, present = list(range(len(columns))), np.isfinite(values)
    # complete planes tell all orders at once; to find the strongest ones first takes far longer
    complete = present.all() and _resolves(columns, every, present[:1])
    orders = every if complete else _strongest_orders(values[rich], columns)
    fit = OrderFit(
        np.full((len(values), len(columns), 2), np.nan, dtype=complex), np.full(len(values), np.nan)
    )
    for mask, planes in _by_points(present):
        known = next((n for n in range(len(orders), 0, -1) if _resolves(columns, orders[:n], mask[None])), 0)
        if known:
            part = _fit(values[planes], columns, orders[:known])
            fit.amplitudes[planes], fit.residual[planes] = part.amplitudes, part.residual
    return fit


def _by_points(present: BoolArray) -> Iterator[tuple[BoolArray, IntArray]]:
    """Masks of points, and the numbers of the planes that have just these: what is solved once for all of them."""
    masks, of = np.unique(present, axis=0, return_inverse=True)
    for number, mask in enumerate(masks):
        yield mask, np.flatnonzero(of == number)


def _strongest_orders(values: ComplexArray, columns: FloatArray) -> list[int]:
    """Orders that the points resolve together, the strongest first.

    With missing points the orders are no longer orthogonal. Orthogonal matching pursuit (Pati, Rezaiifar &
    Krishnaprasad 1993) then takes, over all planes together, the order that explains most of what is left,
    as long as the columns stay well conditioned: a mode shape consists of few orders.
    """
    present = np.isfinite(values)
    masks = np.unique(present, axis=0)
    gains = _gains(np.where(present, values, 0.0), columns, present)
    every: list[int] = np.argsort(-gains, kind="stable").tolist()
    if _resolves(columns, every, masks):
        return every
    least = _LEAST_GAIN * float(np.sum(np.abs(values[present]) ** 2))
    chosen: list[int] = []
    while (order := _next_order(gains, chosen, columns, masks, least)) is not None:
        chosen.append(order)
        rest = np.where(present, values - _shape(_fit(values, columns, chosen), columns), 0.0)
        gains = _gains(rest, columns, present)
    return chosen


def _next_order(
    gains: FloatArray, chosen: list[int], columns: FloatArray, masks: BoolArray, least: float
) -> int | None:
    for order in np.argsort(-gains, kind="stable").tolist():
        if gains[order] <= least:
            return None
        if order not in chosen and _resolves(columns, [*chosen, order], masks):
            return int(order)
    return None


def lookalikes(fit: OrderFit, columns: FloatArray, present: BoolArray, order: int) -> tuple[int, ...]:
    """Other orders that would explain nearly all that `order` explains at the points that are present."""
    if np.all(present) and _orthogonal(columns):
        return ()
    part = np.einsum("pk,jk->pj", np.nan_to_num(fit.amplitudes[:, order]), columns[order]) * present
    explained = _gains(part, columns, present)
    alike = explained >= _LEAST_ALIKE * explained[order]
    return tuple(other for other in np.flatnonzero(alike).tolist() if other != order)


def _orthogonal(columns: FloatArray) -> bool:
    """Whether no order shares anything with another one at all of the points."""
    flat = _flat(columns, list(range(len(columns))))
    gram = flat.T @ flat
    return float(np.abs(gram - np.diag(np.diag(gram))).max()) < _ROUNDING * float(gram.max())


def _shape(fit: OrderFit, columns: FloatArray) -> ComplexArray:
    return np.einsum("prk,rjk->pj", fit.amplitudes, columns)


def _gains(values: ComplexArray, columns: FloatArray, present: BoolArray) -> FloatArray:
    """Sum of squares that each order alone explains over all planes, shape (orders,)."""
    # planes of the same points share their Gram matrices
    masks, plane = np.unique(present, axis=0, return_inverse=True)
    gram = np.einsum("mj,rjk,rjl->mrkl", masks.astype(float), columns, columns)
    inverse = np.linalg.pinv(gram, rcond=_LARGEST_CONDITION**-2, hermitian=True)[plane]
    projected = np.einsum("rjk,pj->prk", columns, values)
    return np.einsum("prk,prkl,prl->r", projected.conj(), inverse, projected).real


def _flat(columns: FloatArray, orders: list[int]) -> FloatArray:
    """Columns of some orders side by side, shape (angles, 2 * orders)."""
    return columns[orders].transpose(1, 0, 2).reshape(columns.shape[1], -1)


def _resolves(columns: FloatArray, orders: list[int], masks: BoolArray) -> bool:
    """Whether the points of every mask tell these orders apart without amplifying noise."""
    flat = _flat(columns, orders)
    flat = flat[:, flat.any(axis=0)]
    if (masks.sum(axis=1) < flat.shape[1]).any():
        return False
    return all(np.linalg.cond(flat[mask]) <= _LARGEST_CONDITION for mask in masks)


def _fit(values: ComplexArray, columns: FloatArray, orders: list[int]) -> OrderFit:
    amplitudes = np.zeros((len(values), len(columns), 2), dtype=complex)
    residual = np.empty(len(values))
    flat = _flat(columns, orders)
    for mask, planes in _by_points(np.isfinite(values)):
        seen = values[np.ix_(planes, mask)].T
        solution = _least_squares(flat[mask], seen)
        residual[planes] = np.mean(np.abs(flat[mask] @ solution - seen) ** 2, axis=0)
        amplitudes[np.ix_(planes, np.array(orders))] = solution.T.reshape(len(planes), -1, 2)
    return OrderFit(amplitudes, residual)


def _least_squares(flat: FloatArray, values: ComplexArray) -> ComplexArray:
    """Complex coefficients (columns, k) of real columns: real and imaginary part side by side, in real arithmetic."""
    both = np.linalg.lstsq(flat, np.hstack([values.real, values.imag]), rcond=None)[0]
    real, imaginary = np.hsplit(both, 2)
    return np.asarray(real + 1j * imaginary)
