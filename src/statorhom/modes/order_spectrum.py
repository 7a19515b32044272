"""Spatial DFT of the radial motion along the circumference, one axial plane after the other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.errors import IdentificationError
from statorhom.modes.circumferential_grid import CircumferentialGrid, different_angles, find_grid
from statorhom.modes.order_fit import fit_orders, lookalikes

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
BoolArray = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class OrderSpectrum:
    """Circumferential orders of one mode shape: u(θ) = Σ_r (cosine_r cos rθ + sine_r sin rθ) per plane.

    Attributes
    ----------
    cosine, sine : ndarray of complex, shape (planes, highest_order + 1)
        Amplitudes in the unit of the shape; column r belongs to order r. NaN in planes with too few
        points. At half the number of angles the points see one phase only: a lower bound.
    shares : ndarray, shape (highest_order + 1,)
        Each order's part of the mean square over all planes.
    unexplained_share : float
        Part of the mean square that no order up to `highest_order` explains; the shares and it add to 1.
    lookalikes : tuple of int
        Orders that the points that are present can hardly tell from the dominant one; empty on a full grid.
    grid : CircumferentialGrid
        The grid the points lie on.
    """

    cosine: ComplexArray
    sine: ComplexArray
    shares: FloatArray
    unexplained_share: float
    lookalikes: tuple[int, ...]
    grid: CircumferentialGrid

    @property
    def highest_order(self) -> int:
        """The highest order that the points resolve; anything above it appears as a lower one."""
        return int(self.shares.size) - 1

    @property
    def dominant_order(self) -> int:
        """The order with the largest share (the lower one of two equal ones)."""
        return int(np.argmax(self.shares))

    def share(self, order: int) -> float:
        """Share of one order.

        Raises
        ------
        IdentificationError
            When the points cannot resolve the order: its share would be that of its alias.
        """
        self._check(order)
        return float(self.shares[order])

    def aliases(self, order: int) -> tuple[int, ...]:
        """The two lowest other orders that look the same as `order` at these angles.

        On N equidistant angles r, N − r, N + r, 2N − r, … have the same values but for their phase;
        uneven angles have no such exact aliases, and the result is empty.
        """
        self._check(order)
        if not self.grid.equidistant:
            return ()
        count = self.grid.count
        return tuple(
            sorted({count - order, count + order, 2 * count - order, 2 * count + order} - {order})[:2]
        )

    def signed_amplitudes(self, order: int) -> FloatArray:
        """Amplitude of one order per plane, with a sign: how a standing wave runs along the axis.

        The planes' (cosine, sine) pairs are projected on their common direction (the leading singular
        vector), then turned by the one phase that makes them as real as they can be. The sign is free;
        the largest amplitude is positive.

        Returns
        -------
        ndarray, shape (planes,)
            NaN in planes with too few points.
        """
        self._check(order)
        pairs = np.column_stack([self.cosine[:, order], self.sine[:, order]])
        used = np.isfinite(pairs).all(axis=1)
        left, singular, _ = np.linalg.svd(pairs[used], full_matrices=False)
        # of unit length until the end: squares of shapes in small units are nothing
        unit = left[:, 0]
        along = (unit * np.exp(-0.5j * np.angle(np.sum(unit**2)))).real * singular[0]
        amplitudes = np.full(used.size, np.nan)
        amplitudes[used] = along * np.sign(along[np.argmax(np.abs(along))])
        return amplitudes

    def _check(self, order: int) -> None:
        if not 0 <= order <= self.highest_order:
            raise IdentificationError(
                f"order {order} cannot be told at {self.grid.count} angles, which show orders up to "
                f"{self.highest_order}: measure at {2 * abs(order) + 1} or more equidistant angles"
            )


def order_spectrum(radial: npt.ArrayLike, angles_rad: npt.ArrayLike) -> OrderSpectrum:
    """Decompose the radial motion into circumferential orders by least squares, plane by plane.

    On a full equidistant grid this is the DFT. Where points are missing (NaN) or the angles are uneven,
    the strongest orders are fitted and weak ones left out, so that noise is not amplified more than tenfold.
    Angles may be repeated.

    Parameters
    ----------
    radial : array_like, shape (planes, angles) or (angles,)
        Radial motion, complex as measured or real as simulated, in any unit; NaN where it is missing.
    angles_rad : array_like, shape (angles,)
        Angles of the points (rad).

    Raises
    ------
    IdentificationError
        When the arrays do not fit, fewer than three angles remain, or nothing moves.
    """
    values, angles = _checked(radial, angles_rad)
    grid = find_grid(angles)
    scale = float(np.nanmax(np.abs(values), initial=0.0))
    if scale == 0.0:
        raise IdentificationError("the mode shape has no radial motion: its orders cannot be told")
    columns, scaled = grid.columns(angles), values / scale
    fit = fit_orders(scaled, columns, _rich_planes(values, angles))
    powers, unexplained = _powers(fit.amplitudes, grid), float(np.nansum(fit.residual))
    alike = lookalikes(fit, columns, np.isfinite(scaled), int(np.argmax(powers)))
    amplitudes = _unphased(fit.amplitudes, grid) * scale
    total = float(powers.sum()) + unexplained
    if total == 0.0:
        raise IdentificationError(
            "no plane of the mode shape has the points that an order needs: measure more"
        )
    shares = powers / total
    for array in (amplitudes, shares):
        array.setflags(write=False)
    return OrderSpectrum(amplitudes[..., 0], amplitudes[..., 1], shares, unexplained / total, alike, grid)


def _checked(radial: npt.ArrayLike, angles_rad: npt.ArrayLike) -> tuple[ComplexArray, FloatArray]:
    values = np.atleast_2d(np.asarray(radial, dtype=complex))
    angles = np.asarray(angles_rad, dtype=float)
    if values.ndim != 2 or angles.shape != values.shape[1:]:
        raise IdentificationError(
            f"a mode shape of shape {values.shape} needs as many angles as columns, got {angles.shape}"
        )
    if not np.isfinite(angles).all():
        raise IdentificationError("an angle of the mode shape's points is not a number")
    values = np.where(np.isfinite(values), values, np.nan)
    present = np.isfinite(values).any(axis=0)
    return values[:, present], angles[present]


def _rich_planes(values: ComplexArray, angles: FloatArray) -> BoolArray:
    """Planes with at least half as many different angles as the best one."""
    if np.isfinite(values).all():
        return np.ones(len(values), dtype=bool)
    counts = np.array([different_angles(angles[np.isfinite(plane)]) for plane in values])
    return 2 * counts >= counts.max()


def _powers(amplitudes: ComplexArray, grid: CircumferentialGrid) -> FloatArray:
    """Mean square of each order over the circumference, summed over the planes."""
    power = np.nansum(np.abs(amplitudes) ** 2, axis=(0, 2))
    squared_cosine = [order for order in range(1, power.size) if not grid.halved(order)]
    power[squared_cosine] /= 2.0  # mean square of cos rθ
    return power


def _unphased(amplitudes: ComplexArray, grid: CircumferentialGrid) -> ComplexArray:
    """Amplitudes of cos rθ and sin rθ also for the order of which the grid shows one phase."""
    turned = amplitudes.copy()
    if grid.halved(grid.highest_order):
        phase = grid.highest_order * grid.offset_rad
        turned[:, -1] = amplitudes[:, -1, :1] * np.array([np.cos(phase), np.sin(phase)])
    return turned
