"""Where the radial motion of one circumferential order is largest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.errors import IdentificationError
from statorhom.modes.order_spectrum import OrderSpectrum

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Antinode:
    """Angular position of a mode of order r > 0.

    Attributes
    ----------
    order : int
        Circumferential order r.
    angle_rad : float
        Angle of the largest radial motion, 0 ≤ angle < π/r: it repeats every π/r with alternating sign.
    sd_rad : float
        Its standard deviation (rad).
    standing_share : float
        Part of the order's motion that this one standing wave explains over all planes and phases; the
        rest travels, or stands at another angle in another plane.
    """

    order: int
    angle_rad: float
    sd_rad: float
    standing_share: float


def antinode(spectrum: OrderSpectrum, order: int, amplitude_sd: FloatArray) -> Antinode:
    """Find the antinode of one order.

    The planes' (cosine, sine) pairs, turned by one common phase, are all multiples of
    (cos rα, sin rα) for a mode u = a(z) cos r(θ − α): α is their principal direction.

    Parameters
    ----------
    spectrum : OrderSpectrum
    order : int
        r > 0, of which the points see both phases.
    amplitude_sd : ndarray, shape (planes, orders, 2)
        Standard deviations of the complex amplitudes.

    Raises
    ------
    IdentificationError
        For order 0, or half the number of angles, where there is no angle to tell.
    """
    spectrum.share(order)  # raises where the order cannot be told
    if order == 0 or spectrum.grid.halved(order):
        raise IdentificationError(f"order {order} has no angle at {spectrum.grid.count} angles")
    pairs = np.column_stack([spectrum.cosine[:, order], spectrum.sine[:, order]])
    used = np.isfinite(pairs).all(axis=1)
    turned = pairs[used] * np.exp(-0.5j * np.angle(np.sum(pairs[used] ** 2)))
    gram = turned.real.T @ turned.real
    along = np.linalg.eigh(gram)[1][:, -1]
    amplitude = turned.real @ along
    strength = float(np.sum(amplitude**2))
    # only noise across the direction, and in phase with the motion, turns it
    across = np.array([-along[1], along[0]])
    variance = (amplitude_sd[used, order] ** 2 / 2) @ across**2
    sd = float(np.sqrt(np.sum(amplitude**2 * variance))) / (order * strength)
    angle = float(np.arctan2(along[1], along[0])) / order % (np.pi / order)
    return Antinode(order, angle, sd, strength / float(np.sum(np.abs(pairs[used]) ** 2)))
