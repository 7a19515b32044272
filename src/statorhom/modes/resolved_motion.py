"""Radial, tangential and axial motion of one place from the sensors that sat there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.stats import chi2

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_LARGEST_TILT = 0.1  # sine of the angle by which a sensor may miss the direction that it is to show


@dataclass(frozen=True)
class ResolvedMotion:
    """Motion of one place.

    Attributes
    ----------
    motion : ndarray of complex, shape (3,)
        Radial, tangential, axial; NaN where the sensors do not span that direction.
    sd : ndarray, shape (3,)
        Standard deviation of the complex values (of |error|, root mean square).
    misfit : float
        Largest difference between a sensor and the motion; 0 where nothing was repeated.
    p_repeats : float
        Probability of repeats that differ this much by chance; 1 where the standard deviation is not
        known or nothing was repeated.
    """

    motion: ComplexArray
    sd: FloatArray
    misfit: float
    p_repeats: float


def resolve_motion(directions: FloatArray, values: ComplexArray, sd: FloatArray) -> ResolvedMotion:
    """Weighted least squares in the space that the sensors span.

    Sensors in one direction are averaged, two in a plane are resolved by projection, and a direction that
    they do not span stays unknown.

    Parameters
    ----------
    directions : ndarray, shape (sensors, 3)
        (radial, tangential, axial) components of the sensors' unit vectors.
    values : ndarray of complex, shape (sensors,)
        What they measured; NaN is left out.
    sd : ndarray, shape (sensors,)
        Standard deviations; NaN where unknown: all weights are then equal.
    """
    present = np.isfinite(values)
    directions, values, sd = directions[present], values[present], sd[present]
    motion, motion_sd = np.full(3, np.nan, dtype=complex), np.full(3, np.nan)
    if not values.size:
        return ResolvedMotion(motion, motion_sd, 0.0, 1.0)
    known = bool(np.all(np.isfinite(sd) & (sd > 0)))
    _, singular, right = np.linalg.svd(directions)
    basis = right[: int(np.sum(singular > _LARGEST_TILT * singular[0]))].T
    white = 1.0 / sd if known else np.ones(values.size)
    columns = white[:, None] * (directions @ basis)
    inverse = np.linalg.pinv(columns)
    along = inverse @ (white * values)
    spanned = np.linalg.norm(np.eye(3) - basis @ basis.T, axis=1) <= _LARGEST_TILT
    motion[spanned] = (basis @ along)[spanned]
    if known:
        motion_sd[spanned] = np.linalg.norm(basis @ inverse, axis=1)[spanned]
    misfit = values - directions @ basis @ along
    freedom = 2 * (values.size - basis.shape[1])
    p = float(chi2.sf(2 * np.sum(np.abs(white * misfit) ** 2), freedom)) if known and freedom else 1.0
    return ResolvedMotion(motion, motion_sd, float(np.abs(misfit).max()) if freedom else 0.0, p)
