"""Standard deviations of the order amplitudes of a measured shape."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from statorhom.modes.measured_shape import MeasuredShape
from statorhom.modes.naming import order_noise
from statorhom.modes.order_spectrum import OrderSpectrum

FloatArray = npt.NDArray[np.float64]


def point_sd(shape: MeasuredShape, spectrum: OrderSpectrum) -> FloatArray:
    """Standard deviation of the radial motion at every point, shape (planes, angles); NaN where missing.

    Where the measurement does not tell it, the noise is what the orders leave unexplained, or, where all
    points are needed for the orders, what the median order shows: few orders are real motion.
    """
    present = np.isfinite(shape.radial)
    known = np.isfinite(shape.sd[0])
    points = int(present.sum())
    median = order_noise(spectrum, spectrum.dominant_order) * np.sqrt(points / max(len(present), 1)) / 2
    fitted = 2 * np.count_nonzero(np.nan_to_num(np.abs(spectrum.cosine) + np.abs(spectrum.sine)))
    mean_square = float(np.nanmean(np.abs(np.where(present, shape.radial, np.nan)) ** 2))
    spare = max(points - int(fitted), 0)
    residual = np.sqrt(spectrum.unexplained_share * mean_square * points / spare) if spare else 0.0
    return np.where(present, np.where(known, shape.sd[0], max(float(median), float(residual))), np.nan)


def amplitude_sd(shape: MeasuredShape, spectrum: OrderSpectrum) -> FloatArray:
    """Standard deviation of every complex order amplitude, shape (planes, orders, 2); NaN where not fitted.

    Linear propagation through the least squares that gave the amplitudes, cosine first.
    """
    columns = spectrum.grid.columns(shape.angles_rad)
    spread = point_sd(shape, spectrum)
    fitted = (np.abs(spectrum.cosine) + np.abs(spectrum.sine)) > 0
    deviations = np.full((*spectrum.cosine.shape, 2), np.nan)
    for plane, orders in enumerate(fitted):
        chosen, points = np.flatnonzero(orders), np.isfinite(spread[plane])
        if not chosen.size:
            continue
        flat = columns[chosen][:, points].transpose(1, 0, 2).reshape(int(points.sum()), -1)
        inverse = np.linalg.pinv(flat, rcond=1e-3)
        deviations[plane, chosen] = np.linalg.norm(inverse * spread[plane, points], axis=1).reshape(-1, 2)
    return deviations
