"""What a measured shape tells of broken symmetry: its angle and the other orders in it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.errors import IdentificationError
from statorhom.modes.amplitude_noise import amplitude_sd
from statorhom.modes.antinode import Antinode, antinode
from statorhom.modes.measured_shape import MeasuredShape
from statorhom.modes.order_spectrum import order_spectrum
from statorhom.modes.phase import phase_collinearity, real_phase

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class ShapeFeatures:
    """Features of one mode's radial motion.

    The shape is turned to be real, signed so that it is positive at the antinode in the plane that moves
    most, and divided by the root mean square of the dominant order's amplitude over the planes.

    Attributes
    ----------
    order : int
        Dominant circumferential order r.
    antinode : Antinode or None
        None for r = 0 and where only one phase is seen.
    phase_rad : float
        Phase by which the shape was turned back.
    phase_collinearity : float
        1 for a standing, 0 for a travelling wave.
    sideband_cosine, sideband_sine : ndarray, shape (2, orders)
        Amplitudes of cos r'θ and sin r'θ of every order r'. Row 0: the same in all planes (even);
        row 1: proportional to the height over the middle of the planes, its value in the outermost plane
        (odd). Column r belongs to the mode itself. NaN in row 1 with a single plane.
    sideband_sd : ndarray, shape (2, orders, 2)
        Their standard deviations, cosine first; NaN for orders that the points did not resolve.
    """

    order: int
    antinode: Antinode | None
    phase_rad: float
    phase_collinearity: float
    sideband_cosine: FloatArray
    sideband_sine: FloatArray
    sideband_sd: FloatArray

    def __post_init__(self) -> None:
        for array in (self.sideband_cosine, self.sideband_sine, self.sideband_sd):
            array.setflags(write=False)


def shape_features(shape: MeasuredShape) -> ShapeFeatures:
    """Angle and sidebands of a measured shape.

    Raises
    ------
    IdentificationError
        When the points do not tell the dominant order.
    """
    spectrum = order_spectrum(shape.radial, shape.angles_rad)
    if spectrum.lookalikes:
        raise IdentificationError(
            f"the points cannot tell order {spectrum.dominant_order} from {spectrum.lookalikes[0]}: "
            "a shape without an order has no sidebands"
        )
    order = spectrum.dominant_order
    spread = amplitude_sd(shape, spectrum)
    place = None if order == 0 or spectrum.grid.halved(order) else antinode(spectrum, order, spread)
    amplitudes = np.stack([spectrum.cosine, spectrum.sine], axis=-1)
    psi = real_phase(amplitudes[:, order])
    turned = (amplitudes * np.exp(-1j * psi)).real
    scale = _signed_size(turned[:, order], 0.0 if place is None else order * place.angle_rad)
    parts, parts_sd = _even_odd(turned / scale, spread / (np.sqrt(2) * abs(scale)), shape.z_m)
    return ShapeFeatures(
        order, place, psi, phase_collinearity(shape.radial), parts[..., 0], parts[..., 1], parts_sd
    )


def _signed_size(pairs: FloatArray, angle: float) -> float:
    """Root mean square over the planes, with the sign of the largest at the antinode."""
    at_antinode = np.nan_to_num(pairs @ np.array([np.cos(angle), np.sin(angle)]))
    sign = -1.0 if at_antinode[np.argmax(np.abs(at_antinode))] < 0 else 1.0
    return float(sign * np.sqrt(np.nanmean(np.sum(pairs**2, axis=1))))


def _even_odd(pairs: FloatArray, sd: FloatArray, z_m: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mean and slope over the planes, (planes, orders, 2) → values and deviations (2, orders, 2)."""
    used = np.isfinite(pairs[:, :, 0]).any(axis=1)
    half = np.ptp(z_m[used]) / 2
    height = (z_m[used] - z_m[used].min()) / half - 1 if half > 0 else np.zeros(int(used.sum()))
    basis = np.column_stack([np.ones_like(height), height])[:, : 1 + (half > 0)]
    inverse = np.linalg.pinv(basis)
    values, deviations = (np.full((2, *pairs.shape[1:]), np.nan) for _ in range(2))
    values[: len(inverse)] = np.tensordot(inverse, np.nan_to_num(pairs[used]), axes=1)
    deviations[: len(inverse)] = np.sqrt(np.tensordot(inverse**2, sd[used] ** 2, axes=1))
    return values, deviations
